"""One control box that follows a knob, with a digital potentiometer in place of the knob: one axis.

Knows the chip's steps, and a model of the box: it turns at one speed, and stays still while the error is within its
dead band. The wiper leads by that band less the coast, so that the rotor rests at the ordered angle. Does not know the
real angle unless a pot is read: `box_model` says how far the model may be wrong. Knows no lease, thread or other axis.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.chips.mcp41010 import STEPS, Mcp41010
from hw.drives.box_model import BoxModel, Obedience, RestLead
from hw.drives.scale import CommandScale
from hw.ports import HardwareError

LEAST_TURN_BACK_DEG = 1.0
"""Degrees: a target that goes back by less does not reverse the motor. Whole degrees of many programs flicker."""


@dataclass(frozen=True, slots=True)
class BoxSpec:
    """One axis. `steps` are pairs of an angle on the rotor's scale and the wiper's step there, 0 to 256."""

    steps: tuple[tuple[float, float], ...]
    start_deg: float
    """The model's angle when the program starts."""
    start_known: bool = False
    """Whether the rotor surely stands there: in a simulation from the beginning."""
    speed_dps: float = 6.0
    dead_band_deg: float = 2.0
    coast_deg: float = 1.0
    """How far the motor turns on after the box has switched it off."""
    range_deg: tuple[float, float] | None = None
    """The axis's own limits, beyond which the wiper never leads; None: the ends of the table."""


class ControlBox:
    """`name` opens each error. Raises HardwareError for a wrong table of steps, or a start outside it."""

    def __init__(self, name: str, chip: Mcp41010, spec: BoxSpec, now_s: float) -> None:
        self.scale = CommandScale(name, spec.steps)
        self.scale.check(spec.start_deg)
        if self.scale.values[0] < 0 or self.scale.values[1] > STEPS:
            raise HardwareError(f"{name}: the calibration table has steps outside 0 to {STEPS}")
        ends_deg = self.scale.low_deg, self.scale.high_deg
        self.model = BoxModel(spec.start_deg, *ends_deg, spec.speed_dps, spec.dead_band_deg)
        if spec.start_known:
            self.model.found(spec.start_deg)
        self.lead = RestLead(spec.dead_band_deg, spec.coast_deg)
        self.until_s: float | None = None
        """When the present command expires; None: there is no command."""
        self.deaf = False
        """A stop of the other axis cut the supply during its command. It ignores aims until it is stopped."""
        self._obedience = Obedience()
        self._chip = chip
        self._range_deg = spec.range_deg or ends_deg
        self._way = 0
        """The direction in which the wiper leads: that of the last move, -1 or 1; 0 before the first one."""
        self._held = False
        """The box was held, and not ordered since."""
        self._measured = False
        """The box was measured since its last order. Then no later measurement corrects a hold."""
        self._step: int | None = None
        """The last step sent to the chip; None: the chip may be at any step."""
        self._now_s = now_s

    @property
    def angle_deg(self) -> float:
        """The model's angle, in degrees on the rotor's own scale."""
        return self.model.angle_deg

    @property
    def resolution_deg(self) -> float:
        """One step of the chip, in degrees on the rotor's scale: 1.41° where 256 steps are 360°."""
        low, high = self.scale.values
        return (self.scale.high_deg - self.scale.low_deg) / (high - low)

    @property
    def known(self) -> bool:
        """Whether the model's angle is right within the dead band. A stop by the wiper needs that."""
        return self.model.known

    def advance(self, now_s: float, powered: bool) -> None:
        """Advance the model to `now_s`."""
        past_s, self._now_s = max(0.0, now_s - self._now_s), now_s
        if powered and self._step is not None:
            self.model.advance(self.scale.angle_deg(self._step), self.lead.deg(-1), self.lead.deg(1), past_s)

    def found(self, angle_deg: float, now_s: float) -> None:
        """The rotor was measured at `angle_deg`: the model continues from there, and at rest the lead is learnt."""
        if not self._measured:
            self._measured, self._held = True, False
        self.model.found(angle_deg)
        self.lead.seen(angle_deg, now_s)

    def astray_deg(self, angle_deg: float) -> float:
        """How far it has turned away from its step, or past it. `angle_deg`: measured now."""
        return 0.0 if self._step is None else self._obedience.astray_deg(angle_deg, self.scale.angle_deg(self._step))

    def order(self, angle_deg: float) -> None:
        """Go to the angle: the wiper leads in the direction of the move, within the axis's limits.

        Raises HardwareError: outside the table, or the bus fails.
        """
        self.scale.check(angle_deg)
        self._held = self._measured = False
        self._way = self.model.way(angle_deg, self._way, max(self.resolution_deg, LEAST_TURN_BACK_DEG))
        low_deg, high_deg = self._range_deg
        lead_deg = angle_deg + self._way * self.lead.deg(self._way)
        wiper_deg = min(max(lead_deg, min(low_deg, angle_deg)), max(high_deg, angle_deg))
        self._send(wiper_deg)
        assert self._step is not None
        self.lead.ordered(self.scale.angle_deg(self._step), self._way, self._now_s)

    def order_here(self) -> None:
        """Send the step of the model's angle, even if it was sent before: a chip without supply forgets its step."""
        self._step = None
        self._stay()

    def hold(self) -> None:
        """Send the model's own angle: the error is then within the dead band, and the box stops.

        A box that is already held keeps its step. Otherwise, if a measured angle and the box's own pot disagree, each
        hold would turn it on by that difference.
        """
        if self._step is not None and not self._held:
            self._stay()
            self._held = True
        self.end()

    def end(self) -> None:
        """End the command."""
        self.until_s, self.deaf = None, False

    def unfed(self) -> None:
        """The box's supply was cut."""
        self.end()
        self._obedience.forget()

    def repeat(self) -> None:
        """Send the last step again. Raises HardwareError."""
        if self._step is not None:
            self._chip.write(self._step)

    def _stay(self) -> None:
        self.lead.forget()
        self._send(self.scale.nearest_deg(self.angle_deg))

    def _send(self, wiper_deg: float) -> None:
        """Send the nearest step, unless the chip already has it."""
        step = min(round(self.scale.value(wiper_deg)), STEPS - 1)
        if step != self._step:
            self._chip.write(step)
            self._step = step  # after the write, so that a failed step is sent again
