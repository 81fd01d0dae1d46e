"""The file with the measured speed and coast of each motor.

Knows the file's form, and which change is large enough for a write. Does not know how a motor is measured.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.status import LearntMotor
from rotator.store.json_file import JsonFile

log = logging.getLogger(__name__)

FORMAT = "rotator state 1"
WORTH_WRITING = 0.05
"""Memory cards wear: a change smaller than this share waits for the end of the program."""
LEAST_COAST_DEG = 0.2
"""A shorter coast is compared as if it were this long: 5 % of a very short coast is only noise."""
FASTEST_DPS = 1000.0
LONGEST_COAST_S = 5.0

Motors = tuple[LearntMotor, LearntMotor]
"""The two directions of one motor: clockwise or up, then counter-clockwise or down."""
MotorSettings = Mapping[str, object]
"""The settings of a motor in the configuration. Figures measured with other settings are not used."""


class LearntFile:
    """Call `load` first, then `note`, then `save` now and then. Failures go to the log, and nothing is raised.

    `begun`: the present settings of each motor.
    """

    def __init__(self, path: Path, begun: Mapping[Axis, MotorSettings]) -> None:
        self._file = JsonFile(path, FORMAT, "what the motors taught")
        self._begun = begun
        self._kept: dict[Axis, Motors] = {}

    def load(self) -> dict[Axis, Motors]:
        """The figures of earlier runs; none without a file, or with a damaged one."""
        nothing: dict[Axis, tuple[object, Motors]] = {}
        known = self._file.load(
            _parse, absent=nothing, damaged=nothing, consequence="ignored, the motors are learnt anew"
        )
        for axis, (begun, _) in known.items():
            if begun != dict(self._begun[axis]):
                log.info("%s: %s has been set up anew since; its motor is learnt anew", self._file.path, axis.value)
        return {axis: motors for axis, (begun, motors) in known.items() if begun == dict(self._begun[axis])}

    def note(self, learnt: Mapping[Axis, Motors]) -> None:
        """The figures with which the box starts. They are written only after a change."""
        self._kept = dict(learnt)

    def save(self, learnt: Mapping[Axis, Motors], *, ending: bool) -> None:
        """Write the measured figures. At the end of the program (`ending`) any change counts; before, a large one."""
        if not any(
            axis not in self._kept or _differs(self._kept[axis], motors, ending=ending)
            for axis, motors in learnt.items()
        ):
            return
        axes = {
            axis.value: {"begun": dict(self._begun[axis]), "plus": asdict(plus), "minus": asdict(minus)}
            for axis, (plus, minus) in learnt.items()
        }
        if self._file.save({"axes": axes}):
            self._kept = dict(learnt)


def _parse(content: dict[str, Any]) -> dict[Axis, tuple[object, Motors]]:
    """The settings under which each axis was learnt, and its figures."""
    tables = {axis: content["axes"][axis.value] for axis in Axis if axis.value in content["axes"]}
    return {axis: (table["begun"], _motors(table)) for axis, table in tables.items()}


def _motors(table: Mapping[str, Any]) -> Motors:
    """The figures of one motor. Raises ValueError, KeyError or TypeError for wrong ones."""
    plus, minus = (LearntMotor(**table[direction]) for direction in ("plus", "minus"))
    for motor in (plus, minus):
        numbers = (motor.speed_dps, motor.coast_deg)
        if not all(isinstance(number, (int, float)) and math.isfinite(number) for number in numbers):
            raise ValueError(f"speed and coast must be numbers, not {motor.speed_dps!r} and {motor.coast_deg!r}")
        if not 0 < motor.speed_dps <= FASTEST_DPS or not 0 <= motor.coast_deg <= LONGEST_COAST_S * motor.speed_dps:
            raise ValueError(f"no motor runs at {motor.speed_dps:g}°/s and coasts {motor.coast_deg:g}°")
    return plus, minus


def _differs(old: Motors, new: Motors, *, ending: bool) -> bool:
    if ending:
        return old != new
    return any(
        abs(b.speed_dps - a.speed_dps) > WORTH_WRITING * a.speed_dps
        or abs(b.coast_deg - a.coast_deg) > WORTH_WRITING * max(a.coast_deg, LEAST_COAST_DEG)
        for a, b in zip(old, new, strict=True)
    )
