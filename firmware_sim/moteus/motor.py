"""The motor of a moteus with its firmware: modes, watchdog, position bounds, and what it loses at power-off.

Knows what a command does, the angle of the shaft, and the faults. Knows no frames. Its modes are stopped, fault,
enabling, position, timeout, zero velocity and brake. The shaft follows the set point exactly, unless it is jammed. Not
simulated: torque, current, load, and coasting without torque.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

from firmware_sim.moteus.registers import COMMAND_DEFAULTS, Register
from firmware_sim.moteus.trajectory import SetPoint, Target


class Mode(IntEnum):
    STOPPED = 0
    FAULT = 1
    ENABLING = 2
    CALIBRATING = 3
    CALIBRATION_COMPLETE = 4
    POSITION = 10
    TIMEOUT = 11
    ZERO_VELOCITY = 12
    BRAKE = 15


class Home(IntEnum):
    """Reference of the reported position: arbitrary, true within a turn of the rotor, or true for the output."""

    RELATIVE = 0
    ROTOR = 1
    OUTPUT = 2


STOP_WITH_LIMITS = 45
START_OUTSIDE_LIMIT = 39
AT_BOUNDS = 103
"""No fault: the position bounds limit the set point."""

ENABLE_S = 0.02
COMMANDABLE = {Mode.STOPPED, Mode.POSITION, Mode.ZERO_VELOCITY, Mode.BRAKE}
LATCHED = {Mode.FAULT, Mode.TIMEOUT}
"""Only a stop leaves these modes."""


@dataclass(slots=True)
class MoteusSettings:
    """The controller's stored settings, which tview sets: `servo.*`, `servopos.*`, in revolutions of the output."""

    position_min_rev: float = math.nan
    position_max_rev: float = math.nan
    default_timeout_s: float = 0.1
    timeout_mode: int = Mode.ZERO_VELOCITY
    default_velocity_limit_rev_s: float = math.nan
    default_accel_limit_rev_s2: float = 50.0
    rotor_turns: float = 1.0
    """Turns of the rotor for one turn of the output. The encoder is on the rotor."""
    output_encoder: bool = False
    """A second encoder is on the output: after power-on the position is right within one turn of the output."""


class SimMoteusMotor:
    """`clock` gives seconds. Call `advance` before reading a field; the methods call it themselves."""

    def __init__(self, clock: Callable[[], float], settings: MoteusSettings, shaft_rev: float) -> None:
        self.settings = settings
        self.shaft_rev = shaft_rev
        """True position of the output, on the scale that the controller had at the start."""
        self.home = Home.OUTPUT
        self.jammed = False
        """Fault: the set point moves and the shaft does not."""
        self.command = dict(COMMAND_DEFAULTS)
        self.fault_code = 0
        self.set_point = SetPoint(shaft_rev, 0.0, clock(), arrived=True)
        self._clock = clock
        self.scale_rev = 0.0
        """The controller's position minus the shaft's: its own count of turns, lost at power-off."""
        self._mode = Mode.STOPPED
        self._enabled_at_s = 0.0
        self._expires_s = math.inf
        self._target = Target(math.nan, 0.0, clock())

    # --- faults

    def fail(self, code: int) -> None:
        """Fault with this code of the firmware: no torque until the next stop."""
        self.advance()
        self._fault(code)

    def power_cycle(self) -> None:
        """Power off and on: the motor stops, and the controller loses the count of the rotor's turns."""
        self.advance()
        self.command = dict(COMMAND_DEFAULTS)
        self._become(Mode.STOPPED)
        self.fault_code = 0
        on_output = self.settings.output_encoder
        turn_rev = 1.0 if on_output else 1 / self.settings.rotor_turns
        self.scale_rev = math.remainder(self.shaft_rev, turn_rev) - self.shaft_rev
        self.home = Home.OUTPUT if on_output else Home.ROTOR

    def time_out(self) -> None:
        """The program that commanded it has gone, and its watchdog has expired."""
        self._become(Mode.TIMEOUT)

    # --- commands

    @property
    def mode(self) -> Mode:
        """The mode register; after a command it passes through the stages of enabling."""
        left_s = self._enabled_at_s - self._clock()
        if self._mode is not Mode.POSITION or left_s <= 0:
            return self._mode
        stages = (Mode.CALIBRATION_COMPLETE, Mode.CALIBRATING, Mode.ENABLING)
        return stages[min(2, int(3 * left_s / ENABLE_S))]

    @property
    def position_rev(self) -> float:
        """The position that the controller reports, in revolutions of the output."""
        return self.shaft_rev + self.scale_rev

    def obey(self, mode: Mode) -> None:
        """A write to the mode register, with the command registers as they are."""
        if mode is not Mode.STOPPED and self._mode in LATCHED:
            return
        if mode is not Mode.POSITION:
            self.fault_code = 0
            self._become(mode)
            return
        limited = (
            self._limit(Register.COMMAND_VELOCITY_LIMIT, math.nan),
            self._limit(Register.COMMAND_ACCEL_LIMIT, math.nan),
        )
        if not math.isnan(self.command[Register.COMMAND_STOP_POSITION]) and not all(map(math.isnan, limited)):
            self._fault(STOP_WITH_LIMITS)
            return
        if self._mode is not Mode.POSITION:
            if self._outside(self.position_rev) and not self.command[Register.COMMAND_IGNORE_BOUNDS]:
                self._fault(START_OUTSIDE_LIMIT)
                return
            self._become(Mode.POSITION)
            self._enabled_at_s = self._clock() + ENABLE_S
            self.set_point = SetPoint(self.position_rev, 0.0, self._enabled_at_s)
        self._aim()

    def set_output(self, position_rev: float, *, exactly: bool) -> None:
        """Take this position for the present one: `exactly`, or whole turns of the rotor from the reported one."""
        by_rev = position_rev - self.position_rev
        if not exactly:
            turn_rev = 1 / self.settings.rotor_turns
            by_rev = round(by_rev / turn_rev) * turn_rev
        self.scale_rev += by_rev  # the set point stays: a motor that holds then turns there, as with older firmware
        self.home = Home.OUTPUT

    def _aim(self) -> None:
        now_s = self._clock()
        wait_s = self.command[Register.COMMAND_TIMEOUT] or self.settings.default_timeout_s
        self._expires_s = math.inf if math.isnan(wait_s) else now_s + wait_s
        self.set_point.arrived = False
        self._target = Target(
            self.command[Register.COMMAND_POSITION],
            _or(self.command[Register.COMMAND_VELOCITY], 0.0),
            now_s,
            self._limit(Register.COMMAND_VELOCITY_LIMIT, self.settings.default_velocity_limit_rev_s),
            self._limit(Register.COMMAND_ACCEL_LIMIT, self.settings.default_accel_limit_rev_s2),
        )

    def _limit(self, register: Register, default: float) -> float:
        limit = _or(self.command[register], default)
        return math.inf if math.isnan(limit) or limit < 0 else limit

    def _become(self, mode: Mode) -> None:
        self._mode = mode
        self._expires_s = math.inf
        self._enabled_at_s = 0.0
        self.set_point = SetPoint(self.position_rev, 0.0, self._clock(), arrived=True)

    def _fault(self, code: int) -> None:
        self._become(Mode.FAULT)
        self.fault_code = code

    # --- time

    def advance(self) -> None:
        """Move the set point and the shaft up to the present moment."""
        now_s = self._clock()
        if self._mode is Mode.POSITION and self._expires_s <= now_s:
            self._move(self._expires_s)
            self._expire()
        self._move(now_s)

    def _expire(self) -> None:
        moment_s, going = self._expires_s, self.set_point
        self._become(Mode.TIMEOUT)
        if self.settings.timeout_mode == Mode.POSITION:  # decelerate and hold
            self.set_point = going
            going.arrived = False
            accel = self._target.accel_limit_rev_s2
            self._target = Target(math.nan, 0.0, moment_s, accel_limit_rev_s2=accel)
        else:
            self.set_point.now_s = moment_s

    def _move(self, until_s: float) -> None:
        if self._mode not in (Mode.POSITION, Mode.TIMEOUT):
            self.set_point.now_s = until_s
            return
        self.set_point.advance(self._target, until_s)
        low_rev, high_rev = self._bounds()
        within_rev = min(max(self.set_point.position_rev, low_rev), high_rev)
        held_back = within_rev != self.set_point.position_rev
        if held_back:
            self.set_point.position_rev, self.set_point.velocity_rev_s = within_rev, 0.0
        if self._mode is Mode.POSITION:
            self.fault_code = AT_BOUNDS if held_back else 0
        if self.jammed:
            return
        self.shaft_rev = self.set_point.position_rev - self.scale_rev

    def _bounds(self) -> tuple[float, float]:
        if self.command[Register.COMMAND_IGNORE_BOUNDS]:
            return -math.inf, math.inf
        return _or(self.settings.position_min_rev, -math.inf), _or(self.settings.position_max_rev, math.inf)

    def _outside(self, position_rev: float) -> bool:
        low_rev, high_rev = self._bounds()
        return not low_rev <= position_rev <= high_rev


def _or(value: float, default: float) -> float:
    return default if math.isnan(value) else value
