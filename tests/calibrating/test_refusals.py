"""What setting an axis up refuses, and the reason it gives: with each, nothing comes of it."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.calibrating.readings import Doubt, measure, turned


def at_the_low_end(sitting: Any) -> Any:
    sitting.say("r", "y", "l", *["l"] * 18)
    return sitting


def test_an_antenna_that_turned_the_wrong_way(sit: Any) -> None:
    sitting = sit()
    assert "swap azimuth_cw and azimuth_ccw" in sitting.say("r", "n")
    assert sitting.guide.ended
    assert sitting.guide.result is None


def test_both_relays_drive_one_direction(sit: Any) -> None:
    sitting = sit()
    sitting.say("r", "y")
    # What should turn it back turns it on.
    sitting.world.inject("azimuth-motor-reversed")
    sitting.wait(0.2)
    assert "the same way" in sitting.say("l")
    assert sitting.guide.ended
    assert sitting.guide.result is None


def test_a_motor_that_does_not_run(sit: Any) -> None:
    sitting = sit()
    sitting.world.inject("azimuth-motor-stalled")
    assert "stands still" in sitting.say("r")
    assert sitting.guide.prompt.startswith("Press r")


def test_a_pot_that_does_not_turn(sit: Any) -> None:
    sitting = sit()
    sitting.world.inject("azimuth-pot-stuck")
    sitting.say("r", "r")
    assert "is the pot on its shaft?" in sitting.text
    assert sitting.guide.prompt.startswith("Press r")


def test_the_wrong_way_does_not_count(sit: Any) -> None:
    sitting = sit()
    sitting.say("l", "l")
    assert sitting.guide.prompt.startswith("Press r")


def test_an_answer_without_a_turn(sit: Any) -> None:
    sitting = sit()
    assert "Turn it first" in sitting.say("y")


def test_ends_too_close(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "0", "r")
    assert "too close to be two ends" in sitting.say("", "450")
    assert "too close, or swapped" in sitting.say("", "5")
    assert sitting.guide.prompt.startswith("At the high end")


def test_ends_swapped(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "450")
    sitting.drive("r", 6)
    assert "too close, or swapped" in sitting.say("", "0")


def test_the_high_end_where_the_low_one_should_be(sit: Any) -> None:
    sitting = sit()
    sitting.say("r", "y", "l", "", "0")
    sitting.drive("l", 18)
    assert "the direction check saw the reading rise" in sitting.say("", "450")


def test_an_angle_that_is_none(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    assert "-360 to 720" in sitting.say("", "999")
    assert "A number of degrees" in sitting.say("y")
    sitting.say("n")
    assert sitting.guide.prompt.startswith("At the low end")


@pytest.mark.parametrize(
    ("angle", "reason"),
    [("500", "not between the ends"), ("-2", "in the table already"), ("430", "Taken")],
)
def test_a_point_between_that_is_not(sit: Any, angle: str, reason: str) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "-2", *["r"] * 40)
    sitting.say("", "452", "l", "l")
    assert reason in sitting.say("", angle)


def test_not_monotonic(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "-2", *["r"] * 40)
    sitting.say("", "452", *["l"] * 10)
    sitting.say("", "330", *["l"] * 10)
    assert "not monotonic" in sitting.say("", "380")


def test_limits_beyond_the_ends(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "0", *["r"] * 40)
    sitting.say("", "450", "f", "-5", "460")
    assert "the limits must lie within 0 to 450" in sitting.text
    assert sitting.guide.prompt.startswith("Lowest angle")


@pytest.mark.parametrize("answer", ["n"])
def test_a_person_who_does_not_want_it(sit: Any, answer: str) -> None:
    sitting = at_the_low_end(sit())
    sitting.say("", "0", *["r"] * 40)
    sitting.say("", "450", "f", "", "", answer)
    assert sitting.guide.ended
    assert sitting.guide.result is None


# --- readings


def test_a_noisy_reading(sit: Any) -> None:
    sitting = at_the_low_end(sit("[sim.azimuth]\npot_noise_deg = 2.2\n"))
    assert "a noisy reading" in sitting.say("")
    assert sitting.guide.prompt.startswith("At the low end")


def test_a_spark_on_the_wire(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.now("")
    sitting.wait(1.0)
    sitting.world.inject("azimuth-pot-jumps")
    assert "a noisy reading" in sitting.say()


def test_an_antenna_that_is_pushed(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.now("")
    sitting.wait(1.0)
    sitting.world.inject("azimuth-wind-turns")
    assert "moved by +0.0" in sitting.say()


def test_a_key_while_it_reads(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.now("")
    sitting.wait(0.5)
    sitting.now("r")
    sitting.wait(1.0)
    assert "not while it is being read" in sitting.text
    assert not sitting.moving()


@pytest.mark.parametrize("fault", ["azimuth-pot-open", "azimuth-pot-shorted", "adc-gone"])
def test_a_sensor_that_is_not_there(sit: Any, fault: str) -> None:
    sitting = at_the_low_end(sit())
    sitting.world.inject(fault)
    sitting.wait(1.0)
    assert "FAULT azimuth" in sitting.text
    starts = sitting.world.relay_starts
    assert "Refused: azimuth" in sitting.say("")
    sitting.say("r", "r")
    assert sitting.world.relay_starts == starts


def test_after_the_wire_is_mended_it_goes_on(sit: Any) -> None:
    sitting = at_the_low_end(sit())
    sitting.world.inject("azimuth-pot-open")
    sitting.wait(1.0)
    sitting.world.clear("azimuth-pot-open")
    sitting.say("r", "", "10")
    assert sitting.guide.prompt.startswith("At the high end")


@pytest.mark.parametrize(
    ("readings", "reason"),
    [
        ([0.5] * 39 + [0.01], "outside lowest_reading 0.02"),
        ([0.99] * 40, "outside lowest_reading"),
        ([0.5 + 0.01 * (at % 2) for at in range(40)], "noisy"),
        ([0.5 + 0.0001 * at for at in range(40)], r"moved by \+0.0020"),
    ],
)
def test_readings_that_are_not_believed(readings: list[float], reason: str) -> None:
    with pytest.raises(Doubt, match=reason):
        measure(readings, 0.02, 0.98)


def test_a_turn_that_slips_back() -> None:
    there = [0.5 + 0.001 * at for at in range(60)]
    slipped = [0.53 + 0.001 * at for at in range(30)]
    assert turned([0.5] * 10, there).doubt() == ""
    assert "went back by 0.0" in turned([0.5] * 10, there + slipped).doubt()
