"""Four motor relays and their brakes, and the rules that no caller can bypass: the only code that closes a relay.

Knows that opposite relays are never on together, that a reversal waits for its dead time, that every command expires,
and that a motor and its brake never work against each other. Does not know angles or targets, nor how long the motors'
supply stays on. Safe to call from any thread.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress

from hw.drives.brake import BRAKES, NEVER_READY_S, Brake, BrakeTimes
from hw.drives.leases import LONGEST_LEASE_S, wait_until
from hw.drives.motor_supply import MASTER, MotorSupply
from hw.drives.switched_motor import SwitchedMotor
from hw.ports import Axis, Direction, HardwareError, LeaseWatch, OutputLines

RELAYS: dict[tuple[Axis, Direction], str] = {
    (Axis.AZIMUTH, Direction.PLUS): "azimuth_cw",
    (Axis.AZIMUTH, Direction.MINUS): "azimuth_ccw",
    (Axis.ELEVATION, Direction.PLUS): "elevation_up",
    (Axis.ELEVATION, Direction.MINUS): "elevation_down",
}


class RelayBank:
    """Drives two motors through four output lines, and through a master relay if one is wired.

    `clock` gives seconds; `until_s` of a command is on the same clock. `dead_time_s`: the pause before a reversal.
    `one_at_a_time`: never feed both motors together, for a small transformer; the second one gets OFF and the caller
    asks again. `watch` learns of each lease before a relay closes. `axes`: those whose relays are wired; `brakes`:
    those that have one.
    """

    def __init__(
        self,
        lines: OutputLines,
        clock: Callable[[], float],
        *,
        dead_time_s: float,
        master: bool = False,
        one_at_a_time: bool = False,
        watch: LeaseWatch | None = None,
        axes: Collection[Axis] = tuple(Axis),
        brakes: Mapping[Axis, BrakeTimes] | None = None,
    ) -> None:
        self._lines = lines
        self._watch = watch
        self._renewed = False
        self._clock = clock
        self._dead_time_s = dead_time_s
        self._one_at_a_time = one_at_a_time
        self._supply = MotorSupply(lines, wired=master)
        self._motors = {axis: SwitchedMotor() for axis in axes}
        self._brakes = {axis: Brake(times) for axis, times in (brakes or {}).items()}
        self._lock = threading.Condition()
        self._due_s: float | None = None

    def drive(self, axis: Axis, direction: Direction, until_s: float) -> Direction:
        """Run `axis` in this direction until `until_s` at the latest; OFF stops it now. Returns the direction now on.

        During the dead time of a reversal, and until its brake is off, it returns OFF, and the caller asks again.
        Raises HardwareError.
        """
        with self._lock:
            now_s = self._clock()
            motor = self._motors[axis]
            try:
                if direction is Direction.OFF or until_s <= now_s or self._supply.barred:
                    self._open(axis, now_s)
                else:
                    self._run(axis, direction, now_s)
                    motor.until_s = min(until_s, now_s + LONGEST_LEASE_S)
            finally:
                self._plan(now_s)
            return motor.on

    def feed(self, axis: Axis, until_s: float) -> None:
        """Open the relays of `axis`, but keep the motors' supply on until `until_s`. If the motor still turns then, a
        relay did not open. Without a master it only opens the relays. Raises HardwareError.
        """
        with self._lock:
            now_s = self._clock()
            try:
                self._open(axis, now_s)
                if self._supply.wired and not self._supply.barred and until_s > now_s:
                    self._renew()
                    self._supply.feed(min(until_s, now_s + LONGEST_LEASE_S))
            finally:
                self._plan(now_s)

    def unfeed(self, axis: Axis) -> None:
        """Open the relays of `axis`. Switch the motors' supply off, unless the other motor runs or a feed is on.

        The supply comes back with the next motor that runs. Raises HardwareError.
        """
        with self._lock:
            now_s = self._clock()
            try:
                self._open(axis, now_s)
                if self._supply.wired and self._supply.on and self._idle() and now_s >= self._supply.fed_until_s:
                    self._supply.off()
            finally:
                self._plan(now_s)

    def seen_turning(self, axis: Axis) -> None:
        """The antenna turns now: its brake waits until it stands. An axis without a brake ignores it."""
        with self._lock:
            if axis in self._brakes:
                self._brakes[axis].keep_off(self._clock())

    def leave(self, within_s: float) -> None:
        """Switch everything off; the brakes engage within this time, for the program ends. Raises HardwareError."""
        with self._lock:
            self.off()
            now_s = self._clock()
            for brake in self._brakes.values():
                brake.due_s = min(brake.due_s, now_s + within_s)
            self._plan(now_s)

    @property
    def released(self) -> bool:
        """Whether a brake is off."""
        with self._lock:
            return any(brake.released for brake in self._brakes.values())

    @property
    def supplied(self) -> bool:
        """Whether the master is on; True if no master is wired."""
        with self._lock:
            return self._supply.on

    def cut(self) -> bool:
        """Switch everything off, and the motors' supply too, until `restore`: the answer to a welded relay.

        False: no relay for the supply is wired. Raises HardwareError.
        """
        with self._lock:
            if not self._supply.wired:
                return False
            self._supply.barred = True
            self.off()
            return True

    def restore(self) -> None:
        """Allow the motors' supply again. It is switched on with the next motor."""
        with self._lock:
            self._supply.barred = False

    def off(self) -> None:
        """Switch all motors off now; each brake engages when it is due. From any thread. Raises HardwareError."""
        with self._lock:
            now_s = self._clock()
            everything = {line: False for (axis, _), line in RELAYS.items() if axis in self._motors}
            if self._supply.wired:
                everything[MASTER] = False
            self._lines.set(everything)
            self._supply.note_off()
            for axis in self._motors:
                self._note_stop(axis, now_s)
            self._plan(now_s)

    def due_s(self) -> float | None:
        """When `enforce` is due; None: no relay is on, and no brake is off."""
        with self._lock:
            return self._due_s

    def enforce(self, now_s: float) -> None:
        """Open every relay whose command has expired, and engage every brake that is due. The guard's only task.

        If one line cannot be switched, the bank still switches the others, and opens the master. Raises the first
        HardwareError after that.
        """
        failures: list[HardwareError] = []
        with self._lock:
            for axis, motor in self._motors.items():
                if motor.runs and motor.until_s <= now_s:
                    try:
                        self._open(axis, now_s)
                    except HardwareError as failure:
                        failures.append(failure)
            for axis, brake in self._brakes.items():
                if brake.released and brake.due_s <= now_s and not self._motors[axis].runs:
                    try:
                        self._lines.set({BRAKES[axis]: False})
                        brake.released_s = None
                        self._tell_brakes()
                    except HardwareError as failure:
                        failures.append(failure)
            if failures or (self._supply.lingered(now_s) and self._idle()):
                try:
                    self._supply.off()
                except HardwareError as failure:
                    failures.append(failure)
            self._plan(now_s)
        if failures:
            raise failures[0]

    def wait_until_due(self, patience_s: float) -> None:
        """For the guard's thread: sleep until `enforce` is due, a command came, or `patience_s` seconds have passed.

        The check and the sleep are one step under the lock, so that a command given in between is not missed.
        """
        with self._lock:
            wait_until(self._lock, self._due_s, self._clock, patience_s)

    def driven(self) -> dict[Axis, Direction]:
        """The present direction of each motor; OFF: both relays are open."""
        with self._lock:
            return {axis: motor.on for axis, motor in self._motors.items()}

    def _run(self, axis: Axis, direction: Direction, now_s: float) -> None:
        motor = self._motors[axis]
        if motor.on not in (Direction.OFF, direction):
            self._open(axis, now_s)
        # The watch learns of the lease before the relay closes: a closed relay is always watched.
        if not motor.runs and self._may_start(motor, direction, now_s) and self._unbraked(axis, now_s):
            self._renew()
            self._close(axis, direction, now_s)
        elif motor.on is direction:
            self._renew()

    def _may_start(self, motor: SwitchedMotor, direction: Direction, now_s: float) -> bool:
        another_runs = any(other.runs for other in self._motors.values() if other is not motor)
        if self._one_at_a_time and another_runs:
            return False
        return motor.may_turn(direction, now_s, self._dead_time_s)

    def _unbraked(self, axis: Axis, now_s: float) -> bool:
        """Whether the motor may start against no brake. If it may not yet, the brake is on its way off."""
        brake = self._brakes.get(axis)
        if brake is None:
            return True
        if not brake.released:
            # A line that fails may have switched: the guard switches it off, and the motor does not start.
            brake.released_s = NEVER_READY_S
            self._tell_brakes()
            self._lines.set({BRAKES[axis]: True})
            brake.released_s = now_s
        brake.keep_off(now_s)
        return brake.ready(now_s)

    def _tell_brakes(self) -> None:
        """Tell the watch which brakes are off: if the program dies, these engage later than the relays open."""
        if self._watch:
            self._watch.unbraked([BRAKES[axis] for axis, brake in self._brakes.items() if brake.released])

    def _close(self, axis: Axis, direction: Direction, now_s: float) -> None:
        levels = {RELAYS[axis, Direction(-direction)]: False, RELAYS[axis, direction]: True}
        levels |= self._supply.for_a_motor(now_s)
        # A line that fails may have switched: the relay counts as closed until it is opened.
        motor = self._motors[axis]
        motor.note_start(direction)
        try:
            self._lines.set(levels)
        except HardwareError:
            with suppress(HardwareError):  # the guard tries again: its lease is over
                self._open(axis, now_s)
            raise

    def _open(self, axis: Axis, now_s: float) -> None:
        motor = self._motors[axis]
        if not motor.runs:
            return
        self._lines.set({RELAYS[axis, Direction.PLUS]: False, RELAYS[axis, Direction.MINUS]: False})
        self._note_stop(axis, now_s)
        self._supply.linger(now_s)

    def _note_stop(self, axis: Axis, now_s: float) -> None:
        if self._motors[axis].runs and axis in self._brakes:
            self._brakes[axis].note_stop(now_s)
        self._motors[axis].note_stop(now_s)

    def _renew(self) -> None:
        if self._watch:
            self._watch.renew()
            self._renewed = True

    def _idle(self) -> bool:
        return not any(motor.runs for motor in self._motors.values())

    def _plan(self, now_s: float) -> None:
        """Set the next moment for `enforce`. Wake the guard if that moment is sooner than before, or there is none."""
        leases_s = [motor.until_s for motor in self._motors.values() if motor.runs]
        if self._supply.fed_until_s > now_s:
            leases_s.append(self._supply.fed_until_s)
        if self._watch and self._renewed and not leases_s:
            # Tell the watch of each end. If it hears nothing during a lease, it takes the program for hung.
            self._watch.rest()
            self._renewed = False
        moments_s = [*leases_s]
        if self._idle() and self._supply.until_s is not None:
            moments_s.append(self._supply.until_s)
        engage = (axis for axis, brake in self._brakes.items() if brake.released and not self._motors[axis].runs)
        moments_s += [self._brakes[axis].due_s for axis in engage]
        due_s = min(moments_s, default=None)
        news = due_s is None or self._due_s is None or due_s < self._due_s
        self._due_s = due_s
        if news:
            self._lock.notify_all()
