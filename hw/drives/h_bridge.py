"""Two DC motors behind H-bridges, each with an encoder: a positioned drive that closes the loop itself.

Knows leases, the watch of another process, and that several threads use the drive while the guard's thread runs the
loop. Does not know how a speed is chosen: `bridge_axis` does; nor how a bridge is switched: `bridge` does.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from hw.drives.bridge import Bridge
from hw.drives.bridge_axis import STEP_S, Amiss, BridgeAxis, Course
from hw.drives.bridge_homing import BridgeEnd, BridgeHoming
from hw.drives.leases import LONGEST_LEASE_S, do_all, wait_until
from hw.ports import AngleSensor, Axis, Direction, HardwareError, LeaseWatch, OutputLines

ENABLE = "enable"
"""The line that lets both bridges drive, or feeds them."""
LOOK_S = 0.1
"""A motor that is off is looked at so often."""
RETRY_S = 1.0

Start = Callable[[Callable[[], Direction]], Direction]
"""Feeds a motor that was off, by the function that it gets, or not yet: it then returns OFF."""


class Encoder(AngleSensor, Protocol):
    @property
    def turned_deg(self) -> float:
        """How far it has turned since some moment; it does not jump where the angle is corrected."""

    @property
    def at_rest(self) -> bool:
        """Its motor has been off for a while, and it has not counted since."""

    trouble: str
    """Why its count may be wrong; empty: it is right."""


@dataclass(slots=True)
class BridgedMotor:
    """One motor: its bridge, its encoder, what may put off its start, and its end, if it can find one."""

    axis: BridgeAxis
    bridge: Bridge
    encoder: Encoder
    start: Start = lambda feed: feed()
    end: BridgeEnd | None = None
    homing: BridgeHoming | None = None
    """The way to its end; also when it is over, so that the caller's last order does not begin it anew."""

    @property
    def homes(self) -> bool:
        return self.homing is not None and not self.homing.over


class BridgeDrive:
    """Safe to call from any thread. `clock` gives seconds. `enable`: the lines with ENABLE; None: it is not wired.

    `watch` learns of each lease before a motor is fed.
    """

    def __init__(
        self,
        motors: Mapping[Axis, BridgedMotor],
        clock: Callable[[], float],
        *,
        enable: OutputLines | None = None,
        watch: LeaseWatch | None = None,
    ) -> None:
        self._motors = motors
        self._clock = clock
        self._enable = enable
        self._watch = watch
        self._renewed = False
        self._barred = False
        """The motors stay off, and ENABLE too, even if one is to run."""
        self._enabled = False
        self._failure: str | None = None
        """Why an output or an encoder fails; None: all are well."""
        self._looked_s = clock()
        self._due_s = clock()
        self._changed = threading.Condition(threading.RLock())

    # --- hw.ports.PositionedDrive

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        with self._changed:
            now_s, motor = self._clock(), self._motors[axis]
            if self._failure:
                raise HardwareError(self._failure)
            if not (math.isfinite(angle_deg) and math.isfinite(rate_dps)):
                raise HardwareError(f"{axis.value}: {angle_deg}° at {rate_dps}°/s is nowhere to aim at")
            motor.axis.course = motor.homing = None
            if until_s > now_s and not self._barred:
                motor.axis.course = Course(angle_deg, rate_dps, now_s, min(until_s, now_s + LONGEST_LEASE_S))
            self._soon(now_s)

    def seek(self, axis: Axis, until_s: float) -> None:
        """Go on to its lower end. Raises HardwareError."""
        with self._changed:
            now_s, motor = self._clock(), self._motors[axis]
            if self._failure or motor.end is None:
                raise HardwareError(self._failure or f"{axis.value} has no end to find")
            if motor.homing is None and not self._barred:
                motor.axis.course, motor.homing = None, BridgeHoming(motor.axis, motor.end)
            if motor.homing:
                motor.homing.until_s = min(until_s, now_s + LONGEST_LEASE_S)
            self._soon(now_s)

    def hold(self, axis: Axis) -> None:
        with self._changed:
            motor = self._motors[axis]
            motor.axis.course = motor.homing = None
            self._soon(self._clock())

    def release(self) -> None:
        """A worm gear holds without torque: nothing turns."""
        self.off()

    def off(self) -> None:
        """Every motor off now, without braking. From any thread. Raises HardwareError."""
        with self._changed:
            now_s = self._clock()
            for motor in self._motors.values():
                motor.axis.stop()
                motor.homing = None
            acts = [lambda motor=motor: motor.bridge.off(now_s) for motor in self._motors.values()]
            try:
                do_all([*acts, lambda: self._switch(on=False)])
            finally:
                self._report()

    def due_s(self) -> float | None:
        with self._changed:
            return self._due_s

    def enforce(self, now_s: float) -> None:
        """A round of the loop: each motor gets its speed, and is off where its command has expired.

        Raises HardwareError where an encoder or an output fails: both motors are off then.
        """
        with self._changed:
            past_s, self._looked_s = now_s - self._looked_s, now_s
            try:
                for motor in self._motors.values():
                    self._step(motor, now_s, past_s)
                self._failure = None
                moving = any(motor.axis.moving or motor.homes for motor in self._motors.values())
                self._due_s = now_s + (STEP_S if moving else LOOK_S)
                if not moving:
                    self._switch(on=False)
            except HardwareError as fault:
                self._failure = str(fault)
                self._due_s = now_s + RETRY_S
                self.off()
                raise
            finally:
                self._report()

    def wait_until_due(self, patience_s: float) -> None:
        with self._changed:
            wait_until(self._changed, self._due_s, self._clock, patience_s)

    # --- how it is

    @property
    def failure(self) -> str | None:
        return self._failure

    def amiss(self, axis: Axis) -> tuple[Amiss, str] | None:
        return self._motors[axis].axis.amiss

    def finds_end(self, axis: Axis) -> bool:
        return self._motors[axis].end is not None

    def fail(self, axis: Axis, amiss: Amiss, seen: str) -> None:
        """Something else was found that stops this axis until it is acknowledged."""
        with self._changed:
            self._motors[axis].axis.amiss = self._motors[axis].axis.amiss or (amiss, seen)
            self._soon(self._clock())

    # --- on an operator's request, and of the controller

    def acknowledge(self, axis: Axis) -> None:
        with self._changed:
            self._motors[axis].axis.amiss = None

    def cut(self) -> bool:
        """Everything off, and ENABLE too, until `restore`. False: it is not wired. Raises HardwareError."""
        with self._changed:
            self._barred = self._enable is not None
            self.off()
            return self._barred

    def restore(self) -> None:
        with self._changed:
            self._barred = False

    # --- with the lock held

    def _step(self, motor: BridgedMotor, now_s: float, past_s: float) -> None:
        axis, bridge = motor.axis, motor.bridge
        angle_deg = motor.encoder.read()
        if motor.homes and motor.homing:
            if motor.homing.until_s > now_s and not axis.amiss:
                motor.homing.step(now_s, angle_deg, stands=motor.encoder.at_rest)
            else:
                axis.course = motor.homing = None
        speed_dps = axis.step(now_s, angle_deg)
        direction = Direction((speed_dps > 0) - (speed_dps < 0))
        if direction is not bridge.on:
            bridge.off(now_s)
        if direction is not Direction.OFF and bridge.may_turn(direction, now_s):
            self._feed(motor, direction, axis.duty(speed_dps))
        well = axis.amiss is None
        axis.watch(now_s, motor.encoder.turned_deg, bridge.on, past_s)
        if axis.amiss:
            if well and axis.amiss[0] is Amiss.QUIET:
                motor.encoder.trouble = "its motor was driven and the encoder did not count: it may have turned"
            axis.stop()
            bridge.off(now_s)

    def _feed(self, motor: BridgedMotor, direction: Direction, share: float) -> None:
        def feed() -> Direction:
            # The watch learns of the lease before the motor is fed.
            if self._watch:
                self._watch.renew()
                self._renewed = True
            self._switch(on=True)
            motor.bridge.feed(direction, share)
            return motor.bridge.on

        if motor.bridge.on is Direction.OFF:
            motor.start(feed)
        else:
            feed()

    def _switch(self, *, on: bool) -> None:
        if self._enable and on is not self._enabled:
            self._enabled = True  # a line that fails may have switched
            self._enable.set({ENABLE: on})
            self._enabled = on

    def _report(self) -> None:
        """Tell the watch of the end of each lease: silence would mean that the program hangs."""
        fed = any(motor.bridge.on is not Direction.OFF for motor in self._motors.values())
        if self._watch and self._renewed and not fed:
            self._watch.rest()
            self._renewed = False

    def _soon(self, now_s: float) -> None:
        """An order came: the loop runs now, not at its next look."""
        if self._due_s > now_s + STEP_S:
            self._due_s = now_s
            self._changed.notify_all()
