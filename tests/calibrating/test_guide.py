"""The walk through setting an axis up, on the simulated rotor, the real drivers and the real control loop."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis

TO_LOW, TO_HIGH = 18, 40
"""Presses from 200° to the stop at -2°, and from there to the one at 452°."""


def directions(sitting: Any, plus: str = "r", minus: str = "l") -> None:
    sitting.say(plus, "y", minus)


def both_ends(sitting: Any) -> None:
    directions(sitting)
    sitting.drive("l", TO_LOW)
    sitting.say("", "-2")
    sitting.drive("r", TO_HIGH)
    sitting.say("", "452")


def test_from_the_first_press_to_the_table(sit: Any) -> None:
    sitting = sit()
    both_ends(sitting)
    sitting.say("f", "", "", "y")
    done = sitting.guide.result
    assert sitting.guide.ended
    assert (done.axis, done.min_deg, done.max_deg) == (Axis.AZIMUTH, 0.0, 450.0)
    assert done.points == (pytest.approx((0.046, -2.0), abs=3e-4), pytest.approx((0.954, 452.0), abs=3e-4))
    assert not sitting.moving()


def test_elevation_has_its_own_keys(sit: Any) -> None:
    sitting = sit("[elevation]\nmax_deg = 90\n", Axis.ELEVATION)
    assert "u or the arrows up and down" in sitting.text
    directions(sitting, "u", "d")
    sitting.drive("d", 16)
    sitting.say("", "-2")
    sitting.drive("u", 24)
    sitting.say("", "92", "f", "0", "90", "y")
    assert sitting.guide.result.points == (pytest.approx((0.03, -2.0), abs=1e-3), pytest.approx((0.97, 92.0), abs=1e-3))
    assert (sitting.guide.result.min_deg, sitting.guide.result.max_deg) == (0.0, 90.0)


def test_points_between_straighten_a_bowed_pot(sit: Any) -> None:
    sitting = sit("[sim.azimuth]\npot_bow_deg = 8\npot_noise_deg = 0.05\n")
    both_ends(sitting)
    for _ in range(3):
        sitting.drive("l", 9)
        sitting.say("", f"{sitting.shaft_deg():.2f}")
    table = sitting.say("f")
    assert len([line for line in table.splitlines() if line.count("°") == 3]) == 5
    assert "-8." in table
    sitting.say("", "", "y")
    raws = [raw for raw, _ in sitting.guide.result.points]
    assert len(raws) == 5
    assert raws == sorted(raws)


def test_a_pot_wired_the_other_way_round_is_as_good(sit: Any) -> None:
    sitting = sit()
    sitting.world.inject("azimuth-pot-reversed")
    sitting.wait(0.5)
    assert "The reading falls with it: good" in sitting.say("r", "y")
    sitting.say("l")
    sitting.drive("l", TO_LOW)
    sitting.say("", "-2")
    sitting.drive("r", TO_HIGH)
    sitting.say("", "452", "f", "", "", "y")
    assert [raw for raw, _ in sitting.guide.result.points] == pytest.approx([0.954, 0.046], abs=3e-4)


def test_it_tells_the_margin_to_a_broken_wire_in_readings_degrees_and_volts(sit: Any) -> None:
    sitting = sit()
    both_ends(sitting)
    table = sitting.say("f")
    assert "0.0260 (13°, 0.086 V) above lowest_reading (0.02)" in table
    assert "That is little" not in table


def test_a_narrow_margin_is_said(sit: Any) -> None:
    sitting = sit("[azimuth]\nlowest_reading = 0.04\n")
    both_ends(sitting)
    assert "That is little" in sitting.say("f")


# --- moving


def test_a_press_turns_it_two_seconds_at_most(sit: Any) -> None:
    sitting = sit()
    sitting.now("r 60")
    sitting.wait(1.9)
    assert sitting.moving()
    sitting.wait(0.3)
    assert not sitting.moving()
    sitting.wait(5.0)
    assert not sitting.moving()


def test_a_held_key_is_one_turn(sit: Any) -> None:
    sitting = sit()
    for _ in range(60):
        sitting.now("r 0.7")
        sitting.wait(0.1)
    sitting.wait(3.0)
    assert sitting.world.relay_starts == 1
    assert sitting.shaft_deg() == pytest.approx(200 + 6.7 * 6, abs=2.0)


@pytest.mark.parametrize("word", ["s", "stop"])
def test_stop_stops_at_once(sit: Any, word: str) -> None:
    sitting = sit()
    sitting.now("r")
    sitting.wait(0.5)
    sitting.now(word)
    sitting.wait(0.05)
    assert not sitting.moving()


@pytest.mark.parametrize("stage", [["r", "y", "l"], ["r"]], ids=["at the low end", "before y or n"])
def test_leaving_stops_and_saves_nothing(sit: Any, stage: list[str]) -> None:
    sitting = sit()
    sitting.say(*stage)
    sitting.now("l")
    sitting.wait(0.3)
    sitting.now("q")
    sitting.wait(0.1)
    assert sitting.guide.ended
    assert sitting.guide.result is None
    assert not sitting.moving()
    assert "nothing is saved" in sitting.text


def test_the_other_axis_is_not_turned(sit: Any) -> None:
    sitting = sit()
    assert "This is the azimuth" in sitting.say("u")
    assert sitting.world.relay_starts == 0


def test_while_it_asks_nothing_turns(sit: Any) -> None:
    sitting = sit()
    sitting.say("r")
    starts = sitting.world.relay_starts
    assert "First answer" in sitting.say("r")
    assert sitting.world.relay_starts == starts


def test_at_a_stop_it_says_so(sit: Any) -> None:
    sitting = sit()
    directions(sitting)
    assert "at its stop" in sitting.drive("l", TO_LOW)


@pytest.mark.parametrize("word", ["what", "r x", "12 13", "yes please", "é"])
def test_words_that_mean_nothing_do_nothing(sit: Any, word: str) -> None:
    sitting = sit()
    assert "means nothing here" in sitting.say(word)
    assert sitting.world.relay_starts == 0
    assert not sitting.guide.ended
