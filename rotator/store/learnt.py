"""What the box has learnt of its motors, kept in a small JSON file from one run to the next.

Knows the file's form, when it is worth writing again, and that a damaged or foreign file is as good as none. Knows
nothing of how the learning is done.
"""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.status import LearntMotor
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FORMAT = "rotator state 1"
WORTH_WRITING = 0.05
"""Memory cards wear: a change smaller than this share waits for the end of the program."""
LEAST_COAST_DEG = 0.2
"""Coasts are compared as if they were at least this long: a share of nothing is nothing."""
FASTEST_DPS = 1000.0
LONGEST_COAST_S = 5.0

Motors = tuple[LearntMotor, LearntMotor]
"""The two directions of one motor: clockwise or up, then counter-clockwise or down."""
Begun = Mapping[str, object]
"""What the configuration says of an axis: figures learnt from another beginning are another motor's."""


class LearntFile:
    """The file. `load` it, `note` what the box starts with, `save` now and then; none of them ever raises."""

    def __init__(self, path: Path, begun: Mapping[Axis, Begun]) -> None:
        self._path = path
        self._begun = begun
        self._kept: dict[Axis, Motors] = {}
        self._trouble = ""

    def load(self) -> dict[Axis, Motors]:
        """What is known from earlier runs; nothing where there is no file, or none that can be believed."""
        try:
            text = self._path.read_text(encoding="utf-8")
        except FileNotFoundError:
            return {}
        except (OSError, UnicodeDecodeError) as fault:
            log.warning("%s: cannot be read, the motors are learnt anew: %s", self._path, fault)
            return {}
        try:
            whole = json.loads(text)
            if not isinstance(whole, dict) or whole.get("format") != FORMAT:
                raise ValueError("it is not the box's")
            axes = {axis: whole["axes"][axis.value] for axis in Axis if axis.value in whole["axes"]}
            known = {axis: (table["begun"], _motors(table)) for axis, table in axes.items()}
        except (ValueError, KeyError, TypeError, RecursionError) as fault:
            log.warning("%s: ignored, the motors are learnt anew: %s", self._path, fault or type(fault).__name__)
            return {}
        for axis, (begun, _) in known.items():
            if begun != dict(self._begun[axis]):
                log.info("%s: %s has been set up anew since; its motor is learnt anew", self._path, axis.value)
        return {axis: motors for axis, (begun, motors) in known.items() if begun == dict(self._begun[axis])}

    def note(self, learnt: Mapping[Axis, Motors]) -> None:
        """What the box starts with: no news."""
        self._kept = dict(learnt)

    def save(self, learnt: Mapping[Axis, Motors], *, ending: bool) -> None:
        """Write what has been learnt, if it is worth it: any news at the end, before that only large ones."""
        if not any(
            axis not in self._kept or _differs(self._kept[axis], motors, ending=ending)
            for axis, motors in learnt.items()
        ):
            return
        axes = {
            axis.value: {"begun": dict(self._begun[axis]), "plus": asdict(plus), "minus": asdict(minus)}
            for axis, (plus, minus) in learnt.items()
        }
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self._path, json.dumps({"format": FORMAT, "axes": axes}, indent=1) + "\n")
        except OSError as fault:
            if str(fault) != self._trouble:
                log.error("what the motors taught cannot be kept: %s", fault)
            self._trouble = str(fault)
            return
        self._trouble = ""
        self._kept = dict(learnt)


def _motors(table: Mapping[str, Any]) -> Motors:
    """Raises ValueError, KeyError or TypeError on anything that is no motor."""
    plus, minus = (LearntMotor(**table[way]) for way in ("plus", "minus"))
    for motor in (plus, minus):
        numbers = (motor.speed_dps, motor.coast_deg)
        if not all(isinstance(number, (int, float)) and math.isfinite(number) for number in numbers):
            raise ValueError("a figure is no number")
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
