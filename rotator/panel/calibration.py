"""The calibration that begins when the box is switched on with the panel's calibrate switch closed, step by step.

First the knobs, turned to their maximum, are read for their full scale. Then each step of the mode switch starts the
next stage: home the azimuth, home the elevation, end. Knows the stages. Does not know switches.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from hw.ports import Axis
from rotator.exchange.orders import Home

LEAST_FULL_SCALE = 0.25
"""A knob that reads less than this share of its supply has not been turned to its maximum."""
BEGINNING = (
    "calibrating: step the mode switch to home the azimuth, once more for the elevation, once more to end it; "
    "then open the calibrate switch"
)


class Stage(Enum):
    KNOBS = "knobs"
    AZIMUTH = "azimuth"
    ELEVATION = "elevation"
    DONE = "done"


_NEXT = {Stage.KNOBS: Stage.AZIMUTH, Stage.AZIMUTH: Stage.ELEVATION}


class PanelCalibration:
    def __init__(self) -> None:
        self.stage = Stage.KNOBS
        self._measured: set[Axis] = set()

    def full_scales(self, readings: Mapping[Axis, float | None]) -> tuple[dict[Axis, float], tuple[str, ...]]:
        """The full scale of each knob, once, as soon as it can be read; and notes for the log."""
        found: dict[Axis, float] = {}
        notes: list[str] = []
        for axis, reading in readings.items():
            if self.stage is not Stage.KNOBS or reading is None or axis in self._measured:
                continue
            self._measured.add(axis)
            if reading < LEAST_FULL_SCALE:
                notes.append(f"calibrating: the {axis.value} knob reads {reading:.3f}: not its maximum, ignored")
            else:
                found[axis] = reading
                notes.append(f"calibrating: the {axis.value} knob's full scale is {reading:.3f}")
        return found, tuple(notes)

    def step(self) -> Home | None:
        """The operator has turned the mode switch. Returns the next axis to home; None: the calibration is done."""
        self.stage = _NEXT.get(self.stage, Stage.DONE)
        return None if self.stage is Stage.DONE else Home(Axis(self.stage.value))
