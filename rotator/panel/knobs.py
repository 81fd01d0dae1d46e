"""The two knobs of a front panel: the angles that they order, what is said of a broken wire, and their calibration.

Knows which knob has been turned and not yet ordered, and the stages of the calibration. Does not know the modes: the
caller says when a knob may aim.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from hw.ports import Axis
from rotator.exchange.orders import Aim, Home, Order, Remark
from rotator.exchange.status import AxisStatus, Status
from rotator.panel.inputs import Knob, KnobWiring

KNOB_OPEN = "a wire is broken, it moves nothing (rotator help knob-open-or-shorted)"


class Knobs:
    """`full_scales` come from an earlier calibration; an axis without one is not calibrated."""

    def __init__(self, wiring: KnobWiring, full_scales: Mapping[Axis, float]) -> None:
        self._wiring = wiring
        self._knobs = {axis: Knob(wiring, full_scales.get(axis)) for axis in Axis}
        self._remarked: set[Axis] = set()
        """The knobs whose broken wire was reported."""
        self._turned: dict[Axis, float | None] = {}
        """For each turned knob whose angle is not ordered yet: the place where it rested before."""

    def see(self, now_s: float, readings: Mapping[Axis, float | None]) -> set[Axis]:
        """The knobs that turn now."""
        return {axis for axis, knob in self._knobs.items() if knob.see(now_s, readings[axis])}

    def calibrate(self, found: Mapping[Axis, float]) -> dict[Axis, float] | None:
        """Take new full scales. Returns those of all knobs, to be saved; None: nothing new."""
        for axis, full_scale in found.items():
            self._knobs[axis] = Knob(self._wiring, full_scale)
        return {axis: knob.full_scale for axis, knob in self._knobs.items()} if found else None

    def share(self, axis: Axis) -> float | None:
        """Where the knob stands, as a share of its scale; None: not known."""
        return self._knobs[axis].share

    def is_turned(self, axis: Axis) -> bool:
        """Whether the operator has turned it, and its angle is not ordered yet."""
        return axis in self._turned

    def orders(self, now_s: float, turned: set[Axis], status: Status, *, may_aim: bool) -> list[Order]:
        """One order for the knobs that rest at a new place, after all knobs rest. An axis without a new place keeps its
        target. A knob turns only its own axis, also when the antenna is over the top. `turned`: by `see`.
        """
        if not may_aim:
            self._turned = {}
            return []
        began = {axis: self._knobs[axis].rest for axis in turned} | self._turned
        self._turned = {axis: rest for axis, rest in began.items() if self._knobs[axis].share is not None}
        if not self._turned or not all(self._knobs[axis].still(now_s) for axis in self._turned):
            return []
        rests = {axis: self._knobs[axis].rest for axis in self._turned}
        angles_deg = {
            axis: _angle_deg(status.axis(axis), rest)
            for axis, rest in rests.items()
            if rest is not None and rest != self._turned[axis]
        }
        self._turned = {}
        if not angles_deg:
            return []
        return [Aim(angles_deg.get(Axis.AZIMUTH), angles_deg.get(Axis.ELEVATION), place=True)]

    def remarks(self) -> list[Order]:
        """Remarks about a knob's broken wire: one when it begins, one when it ends."""
        broken = {axis for axis, knob in self._knobs.items() if knob.trouble}
        remarks: list[Order] = [
            Remark(axis, f"the panel's {axis.value} knob {self._knobs[axis].trouble}: {KNOB_OPEN}", "KNOB OPEN")
            for axis in Axis
            if axis in broken - self._remarked
        ]
        remarks += [Remark(axis) for axis in Axis if axis in self._remarked - broken]
        self._remarked = broken
        return remarks


def _angle_deg(axis: AxisStatus, share: float) -> float:
    return axis.min_deg + share * (axis.max_deg - axis.min_deg)


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
    """What begins when the box is switched on with the panel's calibrate switch closed, step by step.

    First the knobs, turned to their maximum, are read for their full scale. Then each step of the mode switch starts
    the next stage: home the azimuth, home the elevation, end.
    """

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
