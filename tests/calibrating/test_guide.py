"""The walk through setting an axis up, on the simulated rotor, the real drivers and the real control loop."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis

TO_LOW, TO_HIGH, BACK = 2, 9, 2
"""Presses of the swift motor from 30° to the stop at -2°, from there to the one at 452°, and some way back."""
SLOWLY_TO_LOW = 5


def directions(run: Any, plus: str = "r", minus: str = "l") -> None:
    run.say(plus, "y", minus)


def both_ends(run: Any) -> None:
    directions(run)
    run.drive("l", TO_LOW)
    run.say("", "-2")
    run.drive("r", TO_HIGH)
    run.say("", "452")


def test_from_the_first_press_to_the_table(swift: Any) -> None:
    run = swift()
    both_ends(run)
    run.say("f", "", "", "y")
    done = run.guide.result
    assert run.guide.ended
    assert (done.axis, done.min_deg, done.max_deg) == (Axis.AZIMUTH, 0.0, 450.0)
    assert done.points == (pytest.approx((0.046, -2.0), abs=3e-4), pytest.approx((0.954, 452.0), abs=3e-4))
    assert not run.moving()


def test_elevation_has_its_own_keys(calibration: Any) -> None:
    run = calibration("[elevation]\nmax_deg = 90\n", Axis.ELEVATION)
    assert "u or the arrows up and down" in run.text
    directions(run, "u", "d")
    run.drive("d", 5)
    run.say("", "-2")
    run.drive("u", 24)
    run.say("", "92", "f", "0", "90", "y")
    assert run.guide.result.points == (pytest.approx((0.03, -2.0), abs=1e-3), pytest.approx((0.97, 92.0), abs=1e-3))
    assert (run.guide.result.min_deg, run.guide.result.max_deg) == (0.0, 90.0)


def test_points_between_straighten_a_bowed_pot(swift: Any) -> None:
    run = swift(sim="pot_bow_deg = 8\npot_noise_deg = 0.05\n")
    both_ends(run)
    for _ in range(3):
        run.drive("l", BACK)
        run.say("", f"{run.shaft_deg():.2f}")
    table = run.say("f")
    assert len([line for line in table.splitlines() if line.count("°") == 3]) == 5
    assert "-8." in table
    run.say("", "", "y")
    raws = [raw for raw, _ in run.guide.result.points]
    assert len(raws) == 5
    assert raws == sorted(raws)


def test_a_pot_wired_the_other_way_round_is_as_good(swift: Any) -> None:
    run = swift()
    run.world.inject("azimuth-pot-reversed")
    run.wait(0.5)
    assert "The reading falls with it: good" in run.say("r", "y")
    run.say("l")
    run.drive("l", TO_LOW)
    run.say("", "-2")
    run.drive("r", TO_HIGH)
    run.say("", "452", "f", "", "", "y")
    assert [raw for raw, _ in run.guide.result.points] == pytest.approx([0.954, 0.046], abs=3e-4)


@pytest.mark.parametrize(
    ("lowest", "margin"),
    [
        ("", "0.0260 (13°, 0.086 V) below highest_reading (0.98)"),
        ("[azimuth]\nlowest_reading = 0.04\n", "That is little: some drift would be taken for a broken wire."),
    ],
)
def test_it_tells_the_margin_to_a_broken_wire(swift: Any, lowest: str, margin: str) -> None:
    run = swift(lowest)
    both_ends(run)
    table = run.say("f")
    assert margin in table
    assert ("That is little" in table) is bool(lowest)


# --- slips


def test_a_missing_digit_is_asked_about(swift: Any) -> None:
    run = swift()
    directions(run)
    run.drive("l", TO_LOW)
    run.say("", "-2")
    run.drive("r", TO_HIGH)
    assert "45° is 405° off: the file has 450° for this end." in run.say("", "45")
    assert run.guide.prompt == "Is 45° right? y or n:"
    run.say("n", "", "452")
    run.drive("l", BACK)
    assert "off: the other points lie on another line." in run.say("", f"{run.shaft_deg() - 100:.0f}")
    run.say("n", "f", "", "", "y")
    assert [angle_deg for _, angle_deg in run.guide.result.points] == [-2.0, 452.0]


def test_a_point_is_taken_back_and_then_the_ends(swift: Any) -> None:
    run = swift()
    both_ends(run)
    run.drive("l", BACK)
    run.say("", f"{run.shaft_deg():.1f}")
    assert "Taken back" in run.say("b")
    assert "Taken back: 452°." in run.say("b")
    assert run.guide.prompt.startswith("At the high end")
    assert "Taken back: -2°." in run.say("b")
    assert "There is no point to take back." in run.say("b")
    run.drive("l", TO_HIGH)
    run.say("", "-1")
    run.drive("r", TO_HIGH)
    run.say("", "451", "f", "", "", "y")
    assert [angle_deg for _, angle_deg in run.guide.result.points] == [-1.0, 451.0]


# --- moving


def test_a_press_turns_it_two_seconds_at_most(calibration: Any) -> None:
    run = calibration()
    run.now("r 60")
    run.wait(1.9)
    assert run.moving()
    run.wait(0.3)
    assert not run.moving()
    run.wait(5.0)
    assert not run.moving()


def test_a_held_key_is_one_turn(calibration: Any) -> None:
    run = calibration()
    for _ in range(60):
        run.now("r 0.7")
        run.wait(0.1)
    run.wait(3.0)
    assert run.world.relay_starts == 1
    assert run.shaft_deg() == pytest.approx(30 + 6.7 * 6, abs=2.0)


@pytest.mark.parametrize("word", ["s", "stop"])
def test_stop_stops_at_once(calibration: Any, word: str) -> None:
    run = calibration()
    run.now("r")
    run.wait(0.5)
    run.now(word)
    run.wait(0.05)
    assert not run.moving()


@pytest.mark.parametrize("stage", [["r", "y", "l"], ["r"]], ids=["at the low end", "before y or n"])
def test_leaving_stops_and_saves_nothing(calibration: Any, stage: list[str]) -> None:
    run = calibration()
    run.say(*stage)
    run.now("l")
    run.wait(0.3)
    run.now("q")
    run.wait(0.1)
    assert run.guide.ended
    assert run.guide.result is None
    assert not run.moving()
    assert "nothing is saved" in run.text


def test_the_other_axis_is_not_turned(calibration: Any) -> None:
    run = calibration()
    assert "This is the azimuth" in run.say("u")
    assert run.world.relay_starts == 0


def test_while_it_asks_nothing_turns(calibration: Any) -> None:
    run = calibration()
    run.say("r")
    starts = run.world.relay_starts
    assert "It turns again after your answer. Type y for yes or n for no." in run.say("r")
    assert run.world.relay_starts == starts


# --- the relays


def test_a_relay_in_doubt_at_a_stop_is_noted_and_it_turns_back(calibration: Any) -> None:
    run = calibration()
    directions(run)
    run.drive("l", SLOWLY_TO_LOW)
    assert "the box could not see the relay counter-clockwise open" in run.text
    stop_deg = run.shaft_deg()
    run.drive("r", 2)
    assert run.shaft_deg() > stop_deg + 15.0
    assert "FAULT" not in run.text


def test_a_relay_found_closed_keeps_its_opposite_open(calibration: Any) -> None:
    run = calibration()
    run.say("r", "y", "l")
    run.now("l")
    run.wait(1.0)
    run.world.inject("azimuth-relay-welded-ccw")
    run.wait(6.0)
    assert "azimuth: relay welded" in run.text
    starts = run.world.relay_starts
    for _ in range(3):
        run.now("r")
        run.wait(8.0)
    assert run.world.relay_starts == starts


def test_a_press_that_waits_for_the_first_look_is_as_long_as_any(calibration: Any) -> None:
    counted = '[rotor]\ntype = "relay-pulse"\n[azimuth]\nmax_deg = 360\n'
    early, late = (calibration(counted, start_deg=(90.0, 30.0)) for _ in range(2))
    late.wait(10.0)
    for run in (early, late):
        run.say("r")
        run.wait(3.0)
    assert early.shaft_deg() > 90.0 + 8.0
    assert early.shaft_deg() == pytest.approx(late.shaft_deg(), abs=1.0)


def test_stop_ends_a_press_that_waits(calibration: Any) -> None:
    run = calibration('[rotor]\ntype = "relay-pulse"\n[azimuth]\nmax_deg = 360\n', start_deg=(90.0, 30.0))
    run.now("r")
    run.wait(0.2)
    run.now("s")
    run.wait(10.0)
    assert run.world.relay_starts == 0
