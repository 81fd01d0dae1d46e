"""A rotor of two control boxes that follow a knob, each knob replaced by a digital potentiometer: a positioned drive.

Knows leases, the boxes' supply, and when a chip needs its step again. Does not know how one box behaves:
`hw.drives.control_box` does. The angle is modelled; `found` corrects the model if the rotor's own pot is measured.

After a start the angle is only assumed. Then no step of the chip stops the box: it would turn on to the model's
angle. So a stop then opens the relay of the supply.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress

from hw.chips.mcp41010 import Mcp41010
from hw.drives.box_supply import BoxSupply
from hw.drives.control_box import BoxSpec, ControlBox
from hw.drives.leases import LONGEST_LEASE_S, do_all, wait_until
from hw.drives.positioned import DriveAngle
from hw.ports import AngleSource, Axis, HardwareError, OutputLines

LOST_STEP_DEG, ASTRAY_DEG = 2.5, 4.0
"""Degrees away from its step, or past it: from the first on a box gets its step again, from the second on its supply
is cut."""
REFRESH_S = 1.0
"""Seconds until the steps are sent again: a dip of its supply erases a chip's step without a report."""


class DigipotDrive:
    """Safe to call from any thread. `clock` gives seconds; `until_s` of an aim is on the same clock.

    `enable`: the line of the supply's relay, if one is wired. The relay closes when both chips have a step.
    Raises HardwareError for a wrong table of steps.
    """

    angle_source = AngleSource.MODELLED

    def __init__(
        self,
        azimuth: tuple[Mcp41010, BoxSpec] | None,
        elevation: tuple[Mcp41010, BoxSpec] | None,
        clock: Callable[[], float],
        *,
        enable: OutputLines | None = None,
    ) -> None:
        self._clock = clock
        self._started_s = clock()
        self._supply = BoxSupply(enable)
        self._astray_deg: dict[Axis, float] = {}
        """How far each axis had turned away from its step, or past it, when its supply was cut for that."""
        self._unseen: set[Axis] = set()
        """The axes whose sensor has not reported a place yet."""
        self._refresh_s = 0.0
        boxes = {Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation}
        self._boxes = {axis: ControlBox(f"{axis.value} box", *box, clock()) for axis, box in boxes.items() if box}
        self._changed = threading.Condition(threading.RLock())

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        """As the port says, in whole steps. `rate_dps` has no effect, because orders come more often than steps change.

        Refuses an angle outside the axis's table of steps, and moves nothing then.
        """
        with self._changed:
            now_s = self._advance()
            box = self._boxes[axis]
            if until_s <= now_s:
                self._stop(box)
                return
            box.scale.check(angle_deg)
            if box.deaf or self._supply.barred or self._waits_for_sensor():
                return
            box.order(angle_deg)
            box.until_s = min(until_s, now_s + LONGEST_LEASE_S)
            self._changed.notify_all()
            self._feed(box, now_s)

    def hold(self, axis: Axis) -> None:
        """Stop that box. If only a cut supply stops it, the other stops too, until its own hold or this axis's aim."""
        with self._changed:
            self._advance()
            self._stop(self._boxes[axis])

    def off(self) -> None:
        """Stop both boxes, the second also if the chip of the first does not answer. Raises HardwareError."""
        with self._changed:
            self._advance()
            if self._supply.on and self._supply.wired and not all(box.known for box in self._boxes.values()):
                self._cut()
                return
            do_all([box.hold for box in self._boxes.values()])

    def release(self) -> None:
        """Switch the boxes' supply off; the next aim switches it on. Raises HardwareError: no relay is wired for it."""
        with self._changed:
            if not self._supply.wired:
                raise HardwareError("the control boxes cannot be released: no relay is wired to their supply")
            self._advance()
            self._cut()

    def cut(self) -> bool:
        """Switch the boxes' supply off until `restore`. False: no relay is wired for it. Raises HardwareError."""
        with self._changed:
            if not self._supply.wired:
                return False
            self._advance()
            self._supply.barred = True
            self._cut()
            return True

    def restore(self) -> None:
        """Allow the supply again: the next aim switches it on."""
        with self._changed:
            self._supply.barred = False
            self._astray_deg.clear()

    def due_s(self) -> float | None:
        with self._changed:
            moments = [box.until_s for box in self._boxes.values() if box.until_s is not None]
            return min([*moments, self._refresh_s] if self._supply.on else moments, default=None)

    def enforce(self, now_s: float) -> None:
        """Hold each box whose command has expired. Send the steps again when due, also if a chip does not answer.

        Raises HardwareError.
        """
        with self._changed:
            self._advance()
            expired = [box for box in self._boxes.values() if box.until_s is not None and box.until_s <= now_s]
            if any(self._only_a_cut_stops(box) for box in expired):
                self._cut()
            due = [box.hold for box in expired]
            if self._supply.on and now_s >= self._refresh_s:
                self._refresh_s = now_s + REFRESH_S
                due += [box.repeat for box in self._boxes.values()]
            do_all(due)

    def wait_until_due(self, patience_s: float) -> None:
        """For the guard's thread: sleep until `enforce` is due, an order came, or `patience_s` seconds have passed."""
        with self._changed:
            wait_until(self._changed, self.due_s(), self._clock, patience_s)

    # --- state

    def sensor(self, axis: Axis) -> DriveAngle:
        return DriveAngle(self, axis)

    def angle_deg(self, axis: Axis) -> float:
        """The model's angle, in degrees on the rotor's own scale."""
        with self._changed:
            self._advance()
            return self._boxes[axis].angle_deg

    def measured(self, axis: Axis) -> None:
        """A sensor will report the place of this axis by `found`. Until then the boxes get no supply: a box with supply
        turns to its chip's step, and only the sensor shows which step means its place."""
        with self._changed:
            self._unseen.add(axis)

    def unseen_s(self) -> float:
        """Seconds since the start without supply because a sensor has not reported a place. 0: all have."""
        with self._changed:
            return self._clock() - self._started_s if self._waits_for_sensor() else 0.0

    def found(self, axis: Axis, angle_deg: float) -> None:
        """The rotor was measured at `angle_deg` now; the model goes on from there.

        A box that turns away from its step, or past it, has lost the step or its wire. It gets the step again, and if
        that does not help its supply is cut until `restore`.
        """
        with self._changed:
            self._unseen.discard(axis)
            box = self._boxes[axis]
            box.found(angle_deg, self._advance())
            if not self._supply.on:
                return
            astray_deg = box.astray_deg(angle_deg)
            if astray_deg > LOST_STEP_DEG:
                box.repeat()
            if astray_deg > ASTRAY_DEG and self.cut():
                self._astray_deg[axis] = astray_deg

    @property
    def barred(self) -> bool:
        """The supply stays off until `restore`, even if aims come."""
        return self._supply.barred

    def astray_deg(self, axis: Axis) -> float:
        """How far it had turned away from its step, or past it, when its supply was cut for that; 0: not cut."""
        with self._changed:
            return self._astray_deg.get(axis, 0.0)

    def position_known(self, axis: Axis) -> bool:
        """Whether the model's angle must be right: the time for a full travel is over, or the rotor was measured."""
        with self._changed:
            self._advance()
            return self._boxes[axis].known

    def resolution_deg(self, axis: Axis) -> float:
        """One step of the chip, in degrees on the rotor's scale."""
        return self._boxes[axis].resolution_deg

    def _waits_for_sensor(self) -> bool:
        """Whether a sensor has not reported yet and the supply can be withheld, because its relay is wired."""
        return bool(self._unseen) and self._supply.wired

    def _advance(self) -> float:
        now_s = self._clock()
        for box in self._boxes.values():
            box.advance(now_s, self._supply.on)
        return now_s

    def _feed(self, ordered: ControlBox, now_s: float) -> None:
        """Switch the boxes' supply on. The chip of `ordered` has its step; the other gets the step of its box's angle.

        Without the relay the other chip is not touched: its box already has supply, and stands at its step.
        """
        if self._supply.on:
            return
        for box in self._boxes.values():
            box.deaf = False
            if box is ordered:
                box.repeat()  # without its own supply the chip may have forgotten the step
            elif self._supply.wired:
                box.order_here()
        self._refresh_s = now_s + REFRESH_S
        try:
            self._supply.switch_on()
        except HardwareError:
            with suppress(HardwareError):
                self._cut()
            raise

    def _stop(self, box: ControlBox) -> None:
        if self._only_a_cut_stops(box):
            others = [other for other in self._boxes.values() if other is not box and other.until_s is not None]
            self._cut()
            for other in others:
                other.deaf = True
        box.hold()

    def _only_a_cut_stops(self, box: ControlBox) -> bool:
        """Whether its own command may be turning it from an unknown angle, and the relay of the supply is wired."""
        return box.until_s is not None and not box.known and self._supply.on and self._supply.wired

    def _cut(self) -> None:
        self._supply.switch_off()
        for box in self._boxes.values():
            box.unfed()
