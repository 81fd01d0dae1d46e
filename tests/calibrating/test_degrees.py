"""Setting up axes whose readings are degrees: every such kind of rotor, on its simulated chips."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis, HardwareError

U100 = '[rotor]\ntype = "relay-pulse"\n[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 90\n'
ISEL = '[rotor]\ntype = "moteus"\n[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 90\n'
SERVOS = '[rotor]\ntype = "servo"\n[servo.azimuth]\nstart_deg = 90\n[elevation]\nmax_deg = 180\n'
BOXES = '[rotor]\ntype = "digipot"\n'
GRAVITY = '[elevation]\nmax_deg = 90\n[elevation.sensor]\nkind = "mpu6050"\n'


def result(run: Any) -> tuple[float, float]:
    done = run.guide.result
    assert run.guide.ended, run.guide.prompt
    assert done is not None, run.text
    assert done.points is None
    return done.min_deg, done.max_deg


def test_two_motors_that_go_to_an_angle(calibration: Any) -> None:
    run = calibration(ISEL, start_deg=(90.0, 30.0))
    assert "3 s" not in run.text
    said = run.say("r", "y", "l", "5", "355", "y")
    assert "The degrees grow and shrink as they should" in said
    assert "[azimuth]: limits 5 to 355, direction checked." in said
    assert result(run) == (5.0, 355.0)


def test_limits_are_where_it_has_been_driven_to(calibration: Any) -> None:
    run = calibration(ISEL, start_deg=(90.0, 30.0))
    run.say("r", "y", "l", "l", "l", "", "r", "r", "r", "r", "", "y")
    low_deg, high_deg = result(run)
    # A press is 2 s at 30°/s, and some way until it stands; beyond the file's 0° it goes as well.
    assert low_deg < 0.0
    assert high_deg == pytest.approx(run.world.antenna()[0], abs=0.1)
    assert high_deg - low_deg > 200.0


def test_a_servo_is_where_it_was_ordered_to(calibration: Any) -> None:
    run = calibration(SERVOS, start_deg=(90.0, 90.0))
    assert "(on a new box 90°), as fast as it can: keep clear. When it stands, press again." in run.text
    # A short press takes the pulses away before the run to 90° is surely over: presses add up.
    assert "stands still at 90.0°" in run.say("r 0.5")
    run.say("r 0.5", "r 0.5", "r 0.3")
    run.say("r 0.5", "y", "l 0.5")
    assert "190° is no angle of this axis: 0 to 180." in run.say("190")
    run.say("10", "170", "y")
    assert result(run) == (10.0, 170.0)


def test_a_box_that_follows_a_digital_pot(calibration: Any) -> None:
    run = calibration(BOXES, start_deg=(90.0, 30.0))
    assert "The box assumes that it stands where it was last (on a new box at 0°)." in run.text
    run.say("r", "y", "l", "3", "357", "y")
    assert result(run) == (3.0, 357.0)


def test_gravity_tells_an_elevation_on_relays(calibration: Any) -> None:
    run = calibration(GRAVITY, Axis.ELEVATION, start_deg=(200.0, 40.0))
    run.say("u", "y", "d", "2")
    run.drive("u", 5)
    run.say("", "y")
    low_deg, high_deg = result(run)
    assert (low_deg, high_deg) == (2.0, pytest.approx(run.world.antenna()[1], abs=1.0))


@pytest.mark.parametrize(
    ("fault", "answer", "words"),
    [("", "n", "swap elevation_up and elevation_down"), ("elevation-motor-reversed", "n", "swap elevation_up")],
)
def test_an_elevation_that_turned_the_wrong_way(calibration: Any, fault: str, answer: str, words: str) -> None:
    run = calibration(GRAVITY, Axis.ELEVATION, start_deg=(200.0, 40.0))
    if fault:
        run.world.inject(fault)
    assert words in run.say("u", answer)
    assert run.guide.ended
    assert run.guide.result is None


def test_a_board_that_lies_the_other_way_round(calibration: Any) -> None:
    run = calibration(GRAVITY, Axis.ELEVATION, start_deg=(200.0, 40.0))
    run.world.inject("elevation-motor-reversed")  # as seen from the board: the reading falls while the relay says up
    assert "forward and up of elevation.sensor" in run.say("u", "y")
    assert run.guide.result is None


@pytest.mark.parametrize(
    ("text", "start_deg", "words"),
    [
        (ISEL, (90.0, 30.0), "change the sign of moteus.azimuth.rev_per_turn"),
        (SERVOS, (90.0, 90.0), "swap the pulse widths in servo.azimuth.pulses_us"),
        (BOXES, (90.0, 30.0), "exchange PA0 and PB0 of the azimuth's chip"),
        (U100, (90.0, 30.0), "swap azimuth_cw and azimuth_ccw in [relays]"),
    ],
)
def test_the_wrong_way_has_another_cure_on_each_rotor(
    calibration: Any, text: str, start_deg: tuple[float, float], words: str
) -> None:
    run = calibration(text, start_deg=start_deg)
    run.say("r", *(["r"] if text is SERVOS else []))
    assert words in run.say("n")
    assert run.guide.result is None


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [("100", "105", "105° is too low, it must be 110° or more"), ("800", "", "800° is no angle of this axis")],
)
def test_limits_that_make_no_sense(calibration: Any, low: str, high: str, words: str) -> None:
    run = calibration(ISEL, start_deg=(90.0, 30.0))
    run.say("r", "y", "l", low)
    if high:
        run.say(high)
    assert words in run.text
    assert not run.guide.ended


def test_a_controller_that_does_not_know_its_angle_is_given_one_first(calibration: Any) -> None:
    run = calibration(ISEL, start_deg=(90.0, 30.0), bad_luck="azimuth-power-cycled")
    assert "The controller does not know where it stands. Look at the antenna." in run.text
    assert "It stands at 90.0°" in run.say("91")
    run.say("r", "y", "l", "0", "360", "y")
    assert result(run) == (0.0, 360.0)


def test_with_offsets_everything_stays_on_the_rotors_own_scale(calibration: Any) -> None:
    text = ISEL.replace("[azimuth]", "[azimuth]\noffset_deg = 30")
    run = calibration(text, start_deg=(90.0, 30.0), bad_luck="azimuth-power-cycled")
    assert "It stands at 90.0°" in run.say("90")
    run.say("r", "y", "l", "", "350", "y")
    assert result(run) == (pytest.approx(run.world.antenna()[0], abs=0.1), 350.0)


# --- a count


def test_a_count_that_has_never_been_homed(calibration: Any, tmp_path: Path) -> None:
    run = calibration(U100, start_deg=(30.0, 10.0), counts=tmp_path / "counts.json")
    run.say("r", "y", "l", "y")
    said = run.say("y")
    assert "It stands at -" in said or "It stands at 0" in said
    assert run.shaft_deg() == pytest.approx(0.0, abs=0.1)
    run.drive("r", 2)
    run.say("", "358", "y")
    low_deg, high_deg = result(run)
    assert low_deg == pytest.approx(run.shaft_deg(), abs=1.0)
    assert high_deg == 358.0
    # The box finds it where it has been left.
    run.station.close()
    assert '"standing": "known"' in (tmp_path / "counts.json").read_text()


def test_a_count_that_knows_may_be_homed_all_the_same(calibration: Any) -> None:
    run = calibration(U100, start_deg=(30.0, 10.0))
    run.say("r", "y", "l", "y")
    assert "It says that it stands at" in run.guide.prompt
    run.say("n", "2", "350", "y")
    assert result(run) == (2.0, 350.0)


def test_homing_is_stopped_by_the_one_who_watches(calibration: Any, tmp_path: Path) -> None:
    run = calibration(U100, start_deg=(100.0, 10.0), counts=tmp_path / "counts.json")
    run.say("r", "y", "l", "y")
    run.now("y")
    run.wait(3.0)
    assert run.moving()
    run.now("s")
    run.wait(0.1)
    assert not run.moving()
    run.say()
    assert run.guide.prompt == "Look for it now? y or n:"
    run.say("n")
    assert "without its end stop it does not know where it stands" in run.text
    assert run.guide.result is None


def test_a_contact_that_died_is_no_end_stop(calibration: Any, tmp_path: Path) -> None:
    run = calibration(U100, start_deg=(100.0, 10.0), counts=tmp_path / "counts.json")
    run.say("r", "y", "l", "y")
    run.world.inject("azimuth-contact-stuck-open")
    said = run.say("y")
    assert "FAULT azimuth: not homed" in said
    assert run.guide.prompt == "Look for it now? y or n:"


def test_back_is_seen_by_eye_too(calibration: Any) -> None:
    run = calibration(U100, start_deg=(100.0, 10.0))
    assert "swap azimuth_cw" in run.say("r", "y", "l", "n")


# --- readings that are not trusted


def test_an_antenna_that_swings(calibration: Any) -> None:
    run = calibration(GRAVITY, Axis.ELEVATION, start_deg=(200.0, 40.0))
    run.say("u", "y", "d")
    run.wait(2.0)
    run.now("")
    run.wait(1.5)
    run.world.inject("elevation-shaken")
    run.wait(1.0)
    assert "Refused: elevation: " in run.text
    assert run.guide.prompt.startswith("Enter: here")


def test_a_rotor_that_is_sent_angles_cannot_be_driven_to_the_ends_of_a_pot(calibration: Any) -> None:
    with pytest.raises(HardwareError, match=r"rotator help calibration by-hand"):
        calibration(BOXES + '[azimuth.sensor]\nkind = "pot"\n')


def test_a_magnet_goes_the_way_of_a_pot_without_volts(calibration: Any) -> None:
    run = calibration(
        "[azimuth]\nmin_deg = 10\nmax_deg = 340\nlowest_reading = -0.01\nhighest_reading = 1.01\n"
        '[azimuth.sensor]\nkind = "as5600"\n'
    )
    run.say("r", "y", "l")
    run.drive("l", 18)
    run.say("", "8")
    run.drive("r", 30)
    table = run.say("", "342", "f")
    assert " V" not in table
    assert "blind" not in run.text
    run.say("", "", "y")
    assert run.guide.result.points == (
        pytest.approx((8 / 360, 8.0), abs=1e-3),
        pytest.approx((0.95, 342.0), abs=1e-3),
    )


def test_what_is_reckoned_by_time_is_watched_and_homed(calibration: Any, tmp_path: Path) -> None:
    run = calibration('[rotor]\ntype = "relay-timed"\n', start_deg=(100.0, 30.0), counts=tmp_path / "counts.json")
    run.say("r", "y", "l", "y")
    assert "It stands at 0" in run.say("n", "y")
    assert run.shaft_deg() == pytest.approx(0.0, abs=0.1)
    run.say("5", "355", "y")
    assert result(run) == (5.0, 355.0)
