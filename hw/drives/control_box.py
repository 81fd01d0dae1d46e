"""One control box that follows a knob, with a digital potentiometer in place of the knob: one axis.

Knows the chip's steps, and a model of the box: it turns at one speed, and stays still while the error is within its
dead band. Does not know the rotor's real angle: the chip and the box cannot be read, so the angle here is the
model's. Knows no lease, no thread and no other axis.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.chips.mcp41010 import STEPS, Mcp41010
from hw.drives.scale import CommandScale
from hw.ports import HardwareError


@dataclass(frozen=True, slots=True)
class BoxSpec:
    """One axis. `steps` are pairs of an angle on the rotor's scale and the wiper's step there, 0 to 256."""

    steps: tuple[tuple[float, float], ...] = ((0.0, 0.0), (360.0, 256.0))
    start_deg: float = 0.0
    """The model's angle when the program starts."""
    speed_dps: float = 6.0
    dead_band_deg: float = 2.0


class ControlBox:
    """`name` opens each error. Raises HardwareError for a wrong table of steps, or a start outside it."""

    def __init__(self, name: str, chip: Mcp41010, spec: BoxSpec, now_s: float) -> None:
        self.scale = CommandScale(name, spec.steps)
        self.scale.check(spec.start_deg)
        if self.scale.values[0] < 0 or self.scale.values[1] > STEPS:
            raise HardwareError(f"{name}: the calibration table has steps outside 0 to {STEPS}")
        self.angle_deg = spec.start_deg
        """The model's angle, in degrees on the rotor's own scale."""
        self.until_s: float | None = None
        """When the present command expires; None: there is no command."""
        self._chip = chip
        self._spec = spec
        self._step: int | None = None
        """The last step sent to the chip; None: the chip may be at any step."""
        self._now_s = now_s

    @property
    def resolution_deg(self) -> float:
        """One step of the chip, in degrees on the rotor's scale: 1.41° where 256 steps are 360°."""
        low, high = self.scale.values
        return (self.scale.high_deg - self.scale.low_deg) / (high - low)

    def advance(self, now_s: float, powered: bool) -> None:
        """Move the model on to `now_s`: at one speed, until the error is within the dead band."""
        past_s, self._now_s = max(0.0, now_s - self._now_s), now_s
        if not powered or self._step is None:
            return
        error_deg = self.scale.angle_deg(self._step) - self.angle_deg
        turned_deg = min(max(0.0, abs(error_deg) - self._spec.dead_band_deg), self._spec.speed_dps * past_s)
        self.angle_deg += turned_deg if error_deg > 0 else -turned_deg

    def order(self, angle_deg: float) -> None:
        """Send the nearest step, unless the chip has it. Raises HardwareError: outside the table, or the bus fails."""
        step = min(round(self.scale.value(angle_deg)), STEPS - 1)
        if step != self._step:
            self._chip.write(step)
            self._step = step  # after the write, so that a failed step is sent again

    def order_here(self) -> None:
        """Send the step of the model's angle, also if it was the last one: without supply the chip forgets its step."""
        self._step = None
        self.order(self.scale.within(self.angle_deg))

    def hold(self) -> None:
        """Send the model's own angle: the error is then within the dead band, and the box stops."""
        if self._step is not None:
            self.order(self.scale.within(self.angle_deg))
        self.until_s = None

    def repeat(self) -> None:
        """Send the last step again. Raises HardwareError."""
        if self._step is not None:
            self._chip.write(self._step)
