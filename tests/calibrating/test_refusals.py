"""What setting an axis up refuses, and the reason it gives: with each, nothing comes of it."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.calibrating.readings import DEGREES, SHARES, NotTrusted, ReadingUnit, measure, movement
from tests.tables import every_row


def at_the_low_end(run: Any) -> Any:
    run.say("r", "y", "l", *["l"] * 5)
    return run


LOW = ("r", "y", "l", *"lllll")
"""The direction check, and on to the low end."""
SWIFT = "[sim.azimuth]\nspeed_dps = 30\n"
HIGH = (*LOW, "", "-2", *"rrrrrrrrr", "", "452")
"""Both ends, of the swift motor."""


@pytest.mark.long
@pytest.mark.parametrize(
    ("before", "line", "says", "asks"),
    [
        ((), "y", "Turn it first", "Press r"),
        ((), "é", "'é' means nothing here. Turn it first: r is clockwise", "Press r"),
        ((), "b", "nothing to take back here. Turn it first", "Press r"),
        (("l",), "l", "", "Press r"),
        (("r",), "b", "nothing to take back here. Type y", "Did the antenna turn"),
        (("r",), "n", "swap azimuth_cw and azimuth_ccw", ""),
        (LOW, "b", "no point to take back", "At the low end"),
        ((*LOW, ""), "b", "", "At the low end"),
        ((*LOW, "", "b"), "y", "It reads 0.", "Which angle is that"),
        ((*LOW, ""), "999", "-360 to 720", "Which angle is that"),
        ((*LOW, ""), "y", "Type one number of degrees, for example 438.5 or -2, and press Enter. Enter alone takes 0;",
         "Which angle is that"),
        ((*LOW, ""), "450", "the file has 0° for this end", "Is 450° right?"),
        ((*LOW, "", "0", "r", ""), "450", "too close to be two ends", "At the high end"),
        ((*LOW, "", "0", "r", ""), "5", "too close, or swapped", "At the high end"),
        ((*LOW, "", "450", "y", *"rrrrrr", ""), "0", "too close, or swapped", ""),
        (("r", "y", "l", "", "0", *"l" * 18, ""), "450", "the direction check saw the reading rise", "At the high end"),
    ],
)  # fmt: skip
def test_an_answer_that_cannot_be_taken(
    calibration: Any, before: tuple[str, ...], line: str, says: str, asks: str
) -> None:
    run = calibration()
    run.say(*before)
    said = run.say(line)
    assert says in said
    assert run.guide.prompt.startswith(asks) or not asks
    assert run.guide.result is None


@pytest.mark.long
@pytest.mark.parametrize(
    ("lines", "says", "asks"),
    [
        ((*HIGH, "l", "l", "", "500"), "not between the ends", ""),
        ((*HIGH, "l", "l", "", "-2"), "in the table already", ""),
        ((*HIGH, "l", "l", "", "332"), "Taken", "Another point?"),
        ((*HIGH, "l", "l", "", "330", "l", "l", "", "380"), "not monotonic", ""),
        ((*HIGH, "f", "-5", "460"), "the limits must lie within -2 to 452", "Lowest angle"),
        ((*HIGH, "f", "", "b"), "", "Lowest angle"),
        ((*HIGH, "f", "", "", "n"), "Nothing is saved.", ""),
    ],
)
def test_points_and_limits_that_cannot_be(calibration: Any, lines: tuple[str, ...], says: str, asks: str) -> None:
    run = calibration(SWIFT)
    run.say(*lines)
    assert says in run.text
    assert run.guide.prompt.startswith(asks) or not asks
    assert run.guide.result is None


@pytest.mark.parametrize(
    ("fault", "presses", "says"),
    [("azimuth-motor-stalled", "r", "stands still"), ("azimuth-pot-stuck", "rr", "is the pot on its shaft?")],
)
def test_a_turn_that_the_sensor_does_not_see(calibration: Any, fault: str, presses: str, says: str) -> None:
    run = calibration()
    run.world.inject(fault)
    assert says in run.say(*presses)
    assert run.guide.prompt.startswith("Press r")


def test_both_relays_drive_one_direction(calibration: Any) -> None:
    run = calibration()
    run.say("r", "y")
    # What should turn it back turns it on.
    run.world.inject("azimuth-motor-reversed")
    run.wait(0.2)
    assert "the same way" in run.say("l")
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


# --- readings


@pytest.mark.parametrize(
    ("sim", "fault", "says"),
    [
        ("", "azimuth-pot-jumps", "a noisy reading"),
        ("", "azimuth-wind-turns", "moved by +0.0"),
    ],
)
def test_a_reading_that_is_not_trusted(calibration: Any, sim: str, fault: str, says: str) -> None:
    run = at_the_low_end(calibration(sim))
    run.now("")
    run.wait(1.0)
    if fault:
        run.world.inject(fault)
    run.say()
    assert says in run.text
    assert run.guide.prompt.startswith("At the low end")


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


@every_row(
    ("readings", "unit", "reason"),
    [
        ([0.5] * 39 + [0.01], SHARES, "outside lowest_reading 0.02"),
        ([0.99] * 40, SHARES, "outside lowest_reading"),
        ([0.5 + 0.01 * (at % 2) for at in range(40)], SHARES, "noisy"),
        ([0.5 + 0.0001 * at for at in range(40)], SHARES, r"moved by \+0.0020"),
        ([10.0 + 6.0 * (at % 2) for at in range(40)], DEGREES, "noisy reading: 10.0° to 16.0°"),
        ([10.0 + 0.05 * at for at in range(40)], DEGREES, r"moved by \+1.0°"),
    ],
)
def test_readings_that_are_not_trusted(readings: list[float], unit: ReadingUnit, reason: str) -> None:
    least, most = (0.02, 0.98) if unit is SHARES else (-1000.0, 1000.0)
    with pytest.raises(NotTrusted, match=reason):
        measure(readings, least, most, unit)


def test_a_turn_that_slips_back() -> None:
    there = [0.5 + 0.001 * at for at in range(60)]
    slipped = [0.53 + 0.001 * at for at in range(30)]
    assert movement([0.5] * 10, there).objection() == ""
    assert "went back by 0.0" in movement([0.5] * 10, there + slipped).objection()
