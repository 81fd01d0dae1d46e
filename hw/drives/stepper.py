"""A rotor of two steppers on TMC5160 or TMC5130 chips: a positioned drive and two angle sensors.

Knows leases, the line ENN of both chips, and that several threads use the drive. Does not know registers:
`stepper_axis` does.

The safe state is a motor that has stopped by its ramp and holds with its current of rest: without current an antenna
may fall, and steps are lost. ENN goes high only when a person lets go, and by the sentinel when the program has died.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

from hw.buses.spi import SpiBus
from hw.chips.tmc5160 import Tmc5160
from hw.drives.leases import LONGEST_LEASE_S, do_all, wait_until
from hw.drives.positioned import DriveAngle
from hw.drives.stepper_axis import StepperAxis, StepperSpec, Trouble
from hw.ports import AngleSource, Axis, HardwareError, LeaseWatch, OutputLines

ENABLE = "enable"
"""The line ENN of both chips: on feeds the motors."""


class StepperDrive:
    """Safe to call from any thread. `clock` gives seconds; `until_s` of an aim is on the same clock.

    `lines`: the line `ENABLE`; None: it is wired to ground. `watch`: switches it off when the program has died.
    Raises HardwareError for a current that a chip cannot give.
    """

    angle_source = AngleSource.COUNTED

    def __init__(
        self,
        bus: SpiBus,
        specs: Mapping[Axis, StepperSpec],
        clock: Callable[[], float],
        lines: OutputLines | None = None,
        watch: LeaseWatch | None = None,
    ) -> None:
        self._clock = clock
        self._lines = lines
        self._watch = watch
        self._changed = threading.Condition(threading.RLock())
        self._renewed = False
        self._silent: dict[Axis, str] = {}
        self._axes: dict[Axis, StepperAxis] = {}
        for axis, spec in specs.items():
            name = f"{axis.value}: {spec.model.name}"
            try:
                self._axes[axis] = StepperAxis(name, spec, Tmc5160(bus, spec.select, spec.model, name))
            except ValueError as fault:
                raise HardwareError(f"{name}: {fault}") from fault

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        def go(stepper: StepperAxis, now_s: float, until_s: float) -> None:
            stepper.aim(angle_deg, rate_dps, now_s, until_s)

        self._drive(axis, until_s, go)

    def seek(self, axis: Axis, until_s: float) -> None:
        """Go on to its lower end. `homing` says whether it is still on its way. Raises HardwareError."""
        self._drive(axis, until_s, lambda stepper, now_s, until_s: stepper.seek(until_s, now_s))

    def hold(self, axis: Axis) -> None:
        with self._changed:
            if self._axes[axis].under_way:
                self._axes[axis].stop()
            self._note()

    def off(self) -> None:
        with self._changed:
            try:
                do_all([stepper.stop for stepper in self._axes.values() if stepper.under_way])
            finally:
                self._note()

    def release(self) -> None:
        with self._changed:
            try:
                do_all([stepper.let_go for stepper in self._axes.values()])
            finally:
                if self._lines:
                    self._lines.set({ENABLE: False})
                self._note()

    def due_s(self) -> float | None:
        with self._changed:
            return min((stepper.until_s for stepper in self._axes.values() if stepper.under_way), default=None)

    def enforce(self, now_s: float) -> None:
        with self._changed:
            expired = [stepper for stepper in self._axes.values() if stepper.under_way and stepper.until_s <= now_s]
            try:
                do_all([stepper.stop for stepper in expired])
            finally:
                self._note()

    def wait_until_due(self, patience_s: float) -> None:
        """For the guard's thread: sleep until `enforce` is due, or an order came, or for `patience_s` seconds."""
        with self._changed:
            wait_until(self._changed, self.due_s(), self._clock, patience_s)

    # --- how it is

    def sensor(self, axis: Axis) -> DriveAngle:
        return DriveAngle(self, axis)

    def angle_deg(self, axis: Axis) -> float:
        """Asks the chip. Raises HardwareError when it does not answer."""
        with self._changed:
            try:
                self._axes[axis].look()
                self._silent.pop(axis, None)
            except HardwareError as fault:
                self._silent[axis] = str(fault)
                raise
            return self._axes[axis].angle_deg

    def silent(self, axis: Axis) -> str:
        """Why the chip does not answer; empty: it does."""
        return self._silent.get(axis, "")

    def trouble(self, axis: Axis) -> tuple[Trouble, str] | None:
        """What stopped the axis, until it is acknowledged."""
        return self._axes[axis].trouble

    def lost(self, axis: Axis) -> str:
        """Why its place is not known; empty: it is."""
        return self._axes[axis].lost

    def scale(self, axis: Axis) -> int:
        """Counts up each time that the place of the axis was set."""
        return self._axes[axis].scale

    def hot(self, axis: Axis) -> bool:
        """Its chip warns that it will switch its driver off."""
        return self._axes[axis].hot

    def rests_deg(self, axis: Axis) -> float | None:
        """Where it stands without a command; None: it has one, or its ramp still runs."""
        with self._changed:
            return self._axes[axis].angle_deg if self._axes[axis].at_rest else None

    def runs(self, axis: Axis) -> bool:
        """Whether its ramp may still run while its chip counts."""
        return not self._silent.get(axis) and not self.lost(axis) and self.rests_deg(axis) is None

    def stands_at(self, axis: Axis, angle_deg: float) -> bool:
        """Whether it stands there, and there is nothing to do."""
        return self._axes[axis].stands_at(angle_deg)

    # --- on an operator's request, and at the start

    def begin(self, axis: Axis, kept_deg: float | None, lost: str = "", *, sure: bool = False) -> None:
        """Where the axis stood when it was last seen; None: not known, for this reason. `sure`: it stands there now."""
        self._axes[axis].begin(kept_deg, lost, sure=sure)

    def confirm(self, axis: Axis, angle_deg: float) -> None:
        """It stands at this angle. Raises HardwareError: its chip does not answer, or it turns."""
        with self._changed:
            self.hold(axis)
            self.angle_deg(axis)
            if not self._axes[axis].at_rest:
                raise HardwareError(f"{axis.value}: it turns; look where it points when it stands")
            self._axes[axis].place(angle_deg)

    def acknowledge(self, axis: Axis) -> None:
        with self._changed:
            self._axes[axis].acknowledge()

    def _drive(self, axis: Axis, until_s: float, go: Callable[[StepperAxis, float, float], None]) -> None:
        with self._changed:
            now_s = self._clock()
            stepper = self._axes[axis]
            if until_s <= now_s:
                self.hold(axis)
                return
            # The watch learns of it before the motor can turn.
            if self._watch:
                self._watch.renew()
                self._renewed = True
            if self._lines:
                self._lines.set({ENABLE: True})
            try:
                go(stepper, now_s, min(until_s, now_s + LONGEST_LEASE_S))
            except HardwareError as fault:
                if not stepper.trouble:
                    self._silent[axis] = str(fault)
                raise
            finally:
                self._note()

    def _note(self) -> None:
        """After each order: the watch need not wait for a lease where none runs, and the guard plans anew."""
        if self._watch and self._renewed and not any(stepper.under_way for stepper in self._axes.values()):
            self._watch.rest()
            self._renewed = False
        self._changed.notify_all()
