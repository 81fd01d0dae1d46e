"""A rotor of two hobby servos on a PCA9685: a positioned drive and two modelled angles.

Knows leases, the enable line, and how a board that has lost its supply is set up again. A servo moves only while the
guard calls `enforce`: when the program hangs, each servo holds. Does not know where a servo really stands, because a
servo reports nothing. So the first pulse makes it jump, and a stop during that jump takes its pulses away. A board that
kept its supply while no program ran still knows its last pulses: there is no jump.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress

from hw.chips.pca9685 import Pca9685
from hw.drives.leases import LONGEST_LEASE_S, wait_until
from hw.drives.positioned import DriveAngle
from hw.drives.servo_axis import ServoAxis, ServoSpec
from hw.ports import AngleSource, Axis, HardwareError, OutputLines

ENABLE = "servo_enable"
"""The line at the board's OE input; OE is active low, so this output is requested as active low."""

CHECK_S = 1.0
"""Seconds between two checks of a board with pulses for a reset."""
RETRY_S = 0.5
"""Seconds after a failure until the board is set up again."""


class ServoDrive:
    """Safe to call from any thread. `clock` gives seconds; `until_s` of an aim is on the same clock.

    `enable`: the line `ENABLE`, if it is wired. `idle_off_s`: a servo at rest for this time, in seconds, gets no pulses
    and is limp; None: it always holds. Raises HardwareError for two servos on one output, or a wrong table of pulses.
    """

    angle_source = AngleSource.MODELLED

    def __init__(
        self,
        chip: Pca9685,
        azimuth: ServoSpec | None,
        elevation: ServoSpec | None,
        clock: Callable[[], float],
        *,
        enable: OutputLines | None = None,
        idle_off_s: float | None = None,
    ) -> None:
        if azimuth and elevation and azimuth.channel == elevation.channel:
            raise HardwareError(f"azimuth and elevation are both on output {azimuth.channel}: give each its own")
        self._chip = chip
        self._clock = clock
        self._enable = enable
        self._idle_off_s = idle_off_s
        specs = {Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation}
        self._axes = {axis: ServoAxis(f"{axis.value} servo", spec) for axis, spec in specs.items() if spec}
        self._changed = threading.Condition()
        self._wire = threading.Lock()
        """Held while the bus is in use. `off` and `hold` do not take it, so that a stop never waits for the bus."""
        self._started = False
        self._begun = False
        """The board was set up, or taken over as it was."""
        self._check_s = clock()
        self._failure: str | None = None

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        """As the port says. Refuses an angle outside the axis's table of pulses, and moves nothing then."""
        with self._changed:
            now_s = self._clock()
            if self._failure:
                raise HardwareError(self._failure)
            if until_s <= now_s:
                self._axes[axis].hold(now_s)
            else:
                self._axes[axis].aim(angle_deg, rate_dps, now_s, min(until_s, now_s + LONGEST_LEASE_S))
            self._changed.notify_all()

    def hold(self, axis: Axis) -> None:
        with self._changed:
            self._hold(self._axes[axis])

    def off(self) -> None:
        with self._changed:
            for axis in self._axes.values():
                self._hold(axis)

    def release(self) -> None:
        """No pulses: the servos are limp. The next aim starts with a jump, as after power-on. Raises HardwareError."""
        self.off()
        with self._wire:
            self.off()
            try:
                if self._enable:
                    self._enable.set({ENABLE: False})
            finally:
                for axis in self._axes.values():
                    axis.sleep(lost=True)
            for axis in self._axes.values():
                self._chip.off(axis.spec.channel)
        with self._changed:
            self._changed.notify_all()

    def due_s(self) -> float | None:
        with self._changed:
            return self._due_s()

    def enforce(self, now_s: float) -> None:
        """Move each pulse as far as its slew rate allows. Hold each servo whose command has expired.

        Raises HardwareError when the board does not answer; later calls set it up again.
        """
        with self._wire:
            try:
                if not self._started:
                    self._start()
                elif now_s >= self._check_s:
                    self._chip.check()
                    self._check_s = now_s + CHECK_S
                for axis in self._axes.values():
                    self._step(axis, now_s)
            except HardwareError as fault:
                self._fail(str(fault), now_s)
                raise

    def wait_until_due(self, patience_s: float) -> None:
        """For the guard's thread: sleep until `enforce` is due, an order came, or `patience_s` seconds have passed."""
        with self._changed:
            wait_until(self._changed, self._due_s(), self._clock, patience_s)

    def finish(self) -> None:
        """After the guard's end: carry out a stop during a first jump, if the guard has not. Raises HardwareError."""
        with self._changed:
            jumps = any(axis.limp for axis in self._axes.values())
        if jumps:
            self.enforce(self._clock())

    # --- state

    def sensor(self, axis: Axis) -> DriveAngle:
        return DriveAngle(self, axis)

    def angle_deg(self, axis: Axis) -> float:
        """The model's angle, in degrees. Raises HardwareError when the board does not answer."""
        with self._changed:
            if self._failure:
                raise HardwareError(self._failure)
            return self._axes[axis].angle_deg

    def position_known(self, axis: Axis) -> bool:
        """Whether the jump of the first pulse is over: the time for the servo's whole travel has passed."""
        with self._changed:
            return self._axes[axis].settled_s <= self._clock()

    def faults(self) -> dict[Axis, str]:
        """Why the axes cannot move, one sentence for each; empty when the board answers."""
        with self._changed:
            return dict.fromkeys(self._axes, self._failure) if self._failure else {}

    def _hold(self, axis: ServoAxis) -> None:
        axis.hold(self._clock())
        if axis.limp:
            self._changed.notify_all()  # the guard's thread takes its pulses away

    # --- the board, with `_wire` held

    def _start(self) -> None:
        if self._enable:
            self._enable.set({ENABLE: False})
        # With an enable line the servos have been limp, and stay so until the first order.
        holds = not self._begun and self._take_over() and self._enable is None
        if not holds:
            self._chip.start()
        with self._changed:
            self._started, self._begun, self._failure = True, True, None
            self._check_s = self._clock() + CHECK_S

    def _take_over(self) -> bool:
        """Take the angles from the pulses that the board has gone on to make. False: it makes none."""
        if not self._chip.goes_on:
            return False
        widths = {axis: self._chip.width_us(axis.spec.channel) for axis in self._axes.values()}
        with self._changed:
            for axis, width_us in widths.items():
                if width_us is not None:
                    axis.found(axis.scale.angle_deg(width_us), holds=self._enable is None)
        return any(widths.values())

    def _step(self, axis: ServoAxis, now_s: float) -> None:
        with self._changed:
            axis.expire(now_s)
            limp = axis.limp
            due = axis.due_s() <= now_s and not limp
            angle_deg = axis.next_deg(now_s)
        if limp:
            self._chip.off(axis.spec.channel)
            with self._changed:
                axis.stop_jump(now_s)
            self._disable_unused()
        elif due and (angle_deg != axis.angle_deg or not axis.pulsing):
            self._chip.pulse(axis.spec.channel, axis.scale.value(angle_deg))
            if not axis.pulsing:
                self._wake(axis, now_s)
        elif self._idle(axis, now_s):
            self._chip.off(axis.spec.channel)
            axis.sleep(lost=False)
            self._disable_unused()
        if due:
            with self._changed:
                axis.stepped(angle_deg, now_s)

    def _disable_unused(self) -> None:
        if self._enable and not any(other.pulsing for other in self._axes.values()):
            self._enable.set({ENABLE: False})

    def _wake(self, axis: ServoAxis, now_s: float) -> None:
        # The board makes the right pulse before the enable line lets it through to the servo.
        if self._enable:
            self._enable.set({ENABLE: True})
        with self._changed:
            axis.wake(now_s)

    def _idle(self, axis: ServoAxis, now_s: float) -> bool:
        return axis.pulsing and now_s >= self._idle_s(axis)

    def _idle_s(self, axis: ServoAxis) -> float:
        if self._idle_off_s is None:
            return float("inf")
        return max(axis.moved_s, axis.settled_s) + self._idle_off_s

    def _fail(self, failure: str, now_s: float) -> None:
        with self._changed:
            self._failure, self._started = failure, False
            self._check_s = now_s + RETRY_S
            for axis in self._axes.values():
                axis.hold(now_s)
                axis.sleep(lost=True)
        if self._enable:
            with suppress(HardwareError):  # report the failure of the board, not this one
                self._enable.set({ENABLE: False})

    def _due_s(self) -> float | None:
        if self._wire.locked():  # `enforce` is running; in a simulation, time may pass on the bus meanwhile
            return None
        if not self._started:
            return self._check_s
        moments = [axis.due_s() for axis in self._axes.values() if axis.under_way or axis.limp]
        for axis in self._axes.values():
            if axis.pulsing:
                moments += [self._check_s, self._idle_s(axis)]
        return min(moments, default=None)
