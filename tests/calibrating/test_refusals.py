"""What setting an axis up refuses, and the reason it gives: with each, nothing comes of it."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.calibrating.readings import NotTrusted, measure, movement


def at_the_low_end(run: Any) -> Any:
    run.say("r", "y", "l", *["l"] * 5)
    return run


def test_an_antenna_that_turned_the_wrong_way(calibration: Any) -> None:
    run = calibration()
    assert "swap azimuth_cw and azimuth_ccw" in run.say("r", "n")
    assert run.guide.ended
    assert run.guide.result is None


def test_both_relays_drive_one_direction(calibration: Any) -> None:
    run = calibration()
    run.say("r", "y")
    # What should turn it back turns it on.
    run.world.inject("azimuth-motor-reversed")
    run.wait(0.2)
    assert "the same way" in run.say("l")
    assert run.guide.ended
    assert run.guide.result is None


def test_a_motor_that_does_not_run(calibration: Any) -> None:
    run = calibration()
    run.world.inject("azimuth-motor-stalled")
    assert "stands still" in run.say("r")
    assert run.guide.prompt.startswith("Press r")


def test_a_pot_that_does_not_turn(calibration: Any) -> None:
    run = calibration()
    run.world.inject("azimuth-pot-stuck")
    run.say("r", "r")
    assert "is the pot on its shaft?" in run.text
    assert run.guide.prompt.startswith("Press r")


def test_the_wrong_way_does_not_count(calibration: Any) -> None:
    run = calibration()
    run.say("l", "l")
    assert run.guide.prompt.startswith("Press r")


def test_an_answer_without_a_turn(calibration: Any) -> None:
    run = calibration()
    assert "Turn it first" in run.say("y")


def test_ends_too_close(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.say("", "0", "r")
    assert "too close to be two ends" in run.say("", "450")
    assert "too close, or swapped" in run.say("", "5")
    assert run.guide.prompt.startswith("At the high end")


def test_ends_swapped(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    assert "the file has 0° for this end" in run.say("", "450", "y")
    run.drive("r", 6)
    assert "too close, or swapped" in run.say("", "0")


def test_the_high_end_where_the_low_one_should_be(calibration: Any) -> None:
    run = calibration()
    run.say("r", "y", "l", "", "0")
    run.drive("l", 18)
    assert "the direction check saw the reading rise" in run.say("", "450")


def test_an_angle_that_is_none(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    assert "-360 to 720" in run.say("", "999")
    assert "Type one number of degrees, for example 438.5 or -2, and press Enter. Enter alone takes 0;" in run.say("y")
    run.say("n")
    assert run.guide.prompt.startswith("At the low end")


@pytest.mark.parametrize(
    ("angle", "reason"),
    [("500", "not between the ends"), ("-2", "in the table already"), ("332", "Taken")],
)
def test_a_point_between_that_is_not(swift: Any, angle: str, reason: str) -> None:
    run = at_the_low_end(swift())
    run.say("", "-2", *["r"] * 9)
    run.say("", "452", "l", "l")
    assert reason in run.say("", angle)


def test_not_monotonic(swift: Any) -> None:
    run = at_the_low_end(swift())
    run.say("", "-2", *["r"] * 9)
    run.say("", "452", *["l"] * 2)
    run.say("", "330", *["l"] * 2)
    assert "not monotonic" in run.say("", "380")


def test_limits_beyond_the_ends(swift: Any) -> None:
    run = at_the_low_end(swift())
    run.say("", "0", *["r"] * 9)
    run.say("", "450", "f", "-5", "460")
    assert "the limits must lie within 0 to 450" in run.text
    assert run.guide.prompt.startswith("Lowest angle")


@pytest.mark.parametrize("answer", ["n"])
def test_an_operator_who_does_not_want_it(swift: Any, answer: str) -> None:
    run = at_the_low_end(swift())
    run.say("", "0", *["r"] * 9)
    run.say("", "450", "f", "", "", answer)
    assert run.guide.ended
    assert run.guide.result is None


# --- keys that a person tries


def test_help_says_what_each_question_takes_and_all_keys(calibration: Any) -> None:
    run = calibration()
    for way, accepted in (
        ([], "Turn it first: r is clockwise, l is counter-clockwise."),
        (["r"], "Type y for yes or n for no."),
        (["y", "l"], "Drive there with r (clockwise) and l (counter-clockwise); then Enter reads it."),
        ([""], "Enter alone takes 0; n or b: one step back."),
    ):
        run.say(*way)
        prompt = run.guide.prompt
        said = run.say("?")
        assert f"{accepted} All keys" in said.replace(" b takes the last point back.", "")
        assert "? helps; q leaves, and nothing is saved." in said
        assert run.guide.prompt == prompt


def test_back_before_there_is_anything_says_so(calibration: Any) -> None:
    run = calibration()
    assert "nothing to take back here. Turn it first" in run.say("b")
    assert "nothing to take back here. Type y" in run.say("r", "b")
    assert "no point to take back" in run.say("y", "l", "b")


def test_back_at_the_angle_goes_back_to_the_end_and_yes_reads_it(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.say("", "b")
    assert run.guide.prompt.startswith("At the low end")
    assert "It reads 0." in run.say("y")


def test_back_at_the_highest_angle_asks_for_the_lowest_again(swift: Any) -> None:
    run = at_the_low_end(swift())
    run.say("", "0", *["r"] * 9)
    run.say("", "450", "f", "", "b")
    assert run.guide.prompt.startswith("Lowest angle")


def test_an_entry_that_means_nothing_says_what_is_accepted(calibration: Any) -> None:
    run = calibration()
    assert "'é' means nothing here. Turn it first: r is clockwise" in run.say("é")


# --- readings


def test_a_noisy_reading(calibration: Any) -> None:
    run = at_the_low_end(calibration("[sim.azimuth]\npot_noise_deg = 2.2\n"))
    assert "a noisy reading" in run.say("")
    assert run.guide.prompt.startswith("At the low end")


def test_a_spark_on_the_wire(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.now("")
    run.wait(1.0)
    run.world.inject("azimuth-pot-jumps")
    assert "a noisy reading" in run.say()


def test_an_antenna_that_is_pushed(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.now("")
    run.wait(1.0)
    run.world.inject("azimuth-wind-turns")
    assert "moved by +0.0" in run.say()


def test_a_key_while_it_reads(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.now("")
    run.wait(0.5)
    run.now("r")
    run.wait(1.0)
    assert "not while it is being read" in run.text
    assert not run.moving()


@pytest.mark.parametrize("fault", ["azimuth-pot-open", "azimuth-pot-shorted", "adc-gone"])
def test_a_sensor_that_is_not_there(calibration: Any, fault: str) -> None:
    run = at_the_low_end(calibration())
    run.world.inject(fault)
    run.wait(1.0)
    # At a stop the relay could not be seen to open, and now the sensor is blind: it may still be closed.
    assert "FAULT CUT MOTOR POWER! azimuth: " in run.text
    starts = run.world.relay_starts
    assert "Refused: CUT MOTOR POWER! azimuth: " in run.say("")
    run.say("r", "r")
    assert run.world.relay_starts == starts


def test_after_the_wire_is_mended_it_goes_on(calibration: Any) -> None:
    run = at_the_low_end(calibration())
    run.world.inject("azimuth-pot-open")
    run.wait(1.0)
    run.world.clear("azimuth-pot-open")
    run.say("r", "", "10")
    assert run.guide.prompt.startswith("At the high end")


@pytest.mark.parametrize(
    ("readings", "reason"),
    [
        ([0.5] * 39 + [0.01], "outside lowest_reading 0.02"),
        ([0.99] * 40, "outside lowest_reading"),
        ([0.5 + 0.01 * (at % 2) for at in range(40)], "noisy"),
        ([0.5 + 0.0001 * at for at in range(40)], r"moved by \+0.0020"),
    ],
)
def test_readings_that_are_not_trusted(readings: list[float], reason: str) -> None:
    with pytest.raises(NotTrusted, match=reason):
        measure(readings, 0.02, 0.98)


def test_a_turn_that_slips_back() -> None:
    there = [0.5 + 0.001 * at for at in range(60)]
    slipped = [0.53 + 0.001 * at for at in range(30)]
    assert movement([0.5] * 10, there).objection() == ""
    assert "went back by 0.0" in movement([0.5] * 10, there + slipped).objection()
