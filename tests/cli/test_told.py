"""What a command tells of a box that goes through these statuses while it looks on, and what it has ordered."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.status import AxisStatus, Status
from tests.cli.scripted import COMMAND, Rotator, counted, pointed

OPEN = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
UNHOMED = Fault(FaultKind.NOT_HOMED, Axis.AZIMUTH, "no pulse came in either direction")


def on_its_way(angle_deg: float, *, moving: bool = True) -> Status:
    return pointed(AxisStatus(0.0, 450.0, angle_deg, target_deg=180.0, tolerance_deg=4.0, moving=moving))


def at(angle_deg: float | None, by: str = COMMAND, *, latched: str = "", storm: bool = False, **axis: Any) -> Status:
    return pointed(AxisStatus(0.0, 450.0, angle_deg, **axis), by, latched=latched, storm=storm)


RESTS = on_its_way(120, moving=False)
"""A relay waits, and the motor with it."""
ABOVE_THE_TREES = Status(
    0.0,
    AxisStatus(0.0, 450.0, 180.0),
    AxisStatus(0.0, 180.0, 14.7, target_deg=15.0, tolerance_deg=4.0),
    controlled_by=COMMAND,
)
LEVEL = replace(ABOVE_THE_TREES, elevation=AxisStatus(0.0, 0.0, 0.0, fitted=False))
"""A rotor without elevation."""
STORM = AxisStatus(0.0, 450.0, 120.0, target_deg=0.0, tolerance_deg=4.0, moving=True)
TURNS = [counted(angle_deg, turns=True) for angle_deg in (20, 10)]
LOST, FOUND = at(None), at(34.7)

Row = tuple[str, list[Status], int, str, str | None]
"""The command, the statuses, its exit code, what it prints, and what it has ordered."""
ROWS: list[Row] = [
    ("point 180 45", [on_its_way(100), *[RESTS] * 9, on_its_way(150), on_its_way(178.2, moving=False)], 0,
     "Arrived: azimuth 178.2° measured, elevation 45.0° measured.\n", "point 180 45"),
    ("point 180 3", [ABOVE_THE_TREES], 0, "Arrived: azimuth 180.0° measured, elevation 14.7° measured.\nIt points no "
     "lower than 15.0° there: its range, [mount] horizon, or a forbidden sector.\n", "point 180 3"),
    ("point 180 45", [on_its_way(100), at(120.0, fault=OPEN, seen=False)], 3, "azimuth 120.0° when last seen, no "
     f"reading now, elevation 45.0° measured.\nrotator: {OPEN}\n", "point 180 45"),
    ("point 180 45", [at(120.0, missing=(Missing.CALIBRATION, Missing.LIMITS))], 1,
     "rotator: azimuth did not move: it needs calibration, limits\n", "point 180 45"),
    ("point 180 45", [on_its_way(100), at(120.0, "", latched="panel")], 1,
     "rotator: point was ended: stopped by the panel; nothing moves until `rotator resume`\n", "point 180 45"),
    ("park", [on_its_way(100), at(0.0, latched="console#1", storm=True)], 0,
     "Arrived: azimuth 0.0° measured, elevation 45.0° measured.\nNothing else moves it until `rotator resume`.\n",
     "park"),
    ("point 180", [LEVEL], 0, "Arrived: azimuth 180.0° measured.\n", "point 180"),
    ("relays-checked elevation", [LEVEL], 1, "rotator: this rotor has no elevation: elevation.fitted = false\n", None),
    ("jog cw 1,5", [counted(20), counted(30, turns=True), counted(32.5)], 0,
     "azimuth 32.5° counted: +12.5° from before.\n", "jog cw 1.5"),
    # The box watches a counted axis stand before it closes the first relay.
    ("jog cw 1.5", [*[counted(20)] * 11, counted(30, turns=True), counted(32.5)], 0,
     "azimuth 32.5° counted: +12.5° from before.\n", "jog cw 1.5"),
    ("confirm azimuth 123,4", [counted(20), counted(20), counted(123.4)], 0,
     "Taken: azimuth 123.4° counted. Before: azimuth 20.0° counted.\n", "confirm azimuth 123.4"),
    ("confirm azimuth 300", [counted(20)], 1,
     "rotator: 300° had no effect: azimuth 20.0° counted\n", "confirm azimuth 300"),
    ("confirm azimuth 20", [counted(0), counted(0), counted(36)], 0, "Taken: azimuth 36.0° counted, the nearest to 20° "
     "that fits its sensor. Before: azimuth 0.0° counted.\n", "confirm azimuth 20"),
    # A moteus after power-on: the person sees 38°, and the encoder knows it better.
    ("confirm azimuth 38", [LOST, LOST, FOUND], 0, "Taken: azimuth 34.7° measured, the nearest to 38° that fits its "
     "sensor. Before: azimuth not known.\n", "confirm azimuth 38"),
    # Between its turns it stands for a moment.
    ("home azimuth --yes", [counted(25), *TURNS, *[counted(0)] * 4, counted(5, turns=True), counted(0)], 0,
     "azimuth 0.0° counted: homed.\n", "home azimuth"),
    ("home azimuth --yes", [counted(25), TURNS[0], counted(20, fault=UNHOMED, missing=(Missing.HOMING,))], 3,
     f"azimuth 20.0° counted, elevation 0.0° counted.\nrotator: {UNHOMED}\n", "home azimuth"),
    ("home azimuth --yes", [counted(25), TURNS[0], counted(20, missing=(Missing.HOMING,))], 1,
     "rotator: azimuth is not homed: it needs homing\n", "home azimuth"),
    ("resume", [pointed(STORM, latched="console#3", storm=True), pointed(STORM)], 0, "The antenna may move again.\nIt "
     "still goes to its park position; `rotator stop` ends that.\n", "resume"),
    ("resume", [at(120.0, fault=OPEN)], 3, f"rotator: the cause is still there:\n         {OPEN}\n", "resume"),
]  # fmt: skip


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}: {row[3][:30]!r}")
def test_what_it_tells_and_orders(scripted: Any, rotator_here: Rotator, config: Path, row: Row) -> None:
    words, statuses, code, told, heard = row
    console = scripted(*statuses)
    done = rotator_here(*words.split(), "--config", config)
    assert (done.returncode, done.stdout + done.stderr) == (code, told)
    assert next(iter(console.heard), None) == heard
