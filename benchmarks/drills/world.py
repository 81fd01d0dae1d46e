"""The truth of the simulated world, axis by axis: how the shaft turns, what feeds its motor, and where the stops are.

Knows the simulated rotors by their parts. Never asks the box. `coil` is the direction that the box commands; `power` is
the direction of the current that turns the shaft, also through a welded contact. Angles are on the rotor's own scale.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from firmware_sim.controllers.brain import SimBrain
from firmware_sim.moteus.motor import Mode
from firmware_sim.parts.motor import SimMotor
from firmware_sim.parts.servo import SimServo
from firmware_sim.rotors.controller import SimControllerRotor
from firmware_sim.rotors.digipot import SimBox, SimDigipotRotor
from firmware_sim.rotors.h_bridge import SimBridgeRotor
from firmware_sim.rotors.moteus import SimMoteusRotor
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from firmware_sim.rotors.relay_pulse import SimRelayPulseRotor
from firmware_sim.rotors.relay_timed import SimRelayTimedRotor
from firmware_sim.rotors.rotor import AXES, SimRotor
from firmware_sim.rotors.servo import SimServoRotor
from firmware_sim.rotors.stepper import SimStepperAxis, SimStepperRotor

AT_STOP_DEG = 1e-3
STANDS_DPS = 0.02
"""A shaft slower than this stands."""
SPED_SHARE = 0.02
"""A speed input is above its lowest by more than this share of full speed."""


@dataclass(slots=True)
class AxisTruth:
    """One axis at the latest look. Directions: -1, 0 or 1."""

    name: str
    full_dps: float
    """The true full speed of its motor, which the configuration may give wrongly."""
    coasts_s: float
    """Seconds from full speed to a standstill."""
    stop_low_deg: float = -math.inf
    stop_high_deg: float = math.inf
    shaft_deg: float = 0.0
    boom_deg: float = 0.0
    speed_dps: float = 0.0
    power: int = 0
    coil: int = 0
    welded: bool = False
    pushed: bool = False
    """A hand or the wind turns it."""
    shorted_s: float = 0.0
    braked_s: float = 0.0
    """How long its motor was fed against its brake."""
    jolts: int = 0
    """How often its brake has fallen on a shaft that turned."""
    sped: bool = False
    """Its speed input is above its lowest."""
    told_dps: float = math.inf
    """The speed of the set point that the motor follows; infinite: its set point has no speed."""
    sent_deg: float = math.nan
    """The angle to which a control box was sent; NaN: no control box drives the axis."""
    relayed: bool = False
    """Relays of the box itself feed its motor."""

    @property
    def at_stop(self) -> int:
        """The stop at which the shaft stands: -1 the low one, 1 the high one, 0 none."""
        if self.shaft_deg >= self.stop_high_deg - AT_STOP_DEG:
            return 1
        return -1 if self.shaft_deg <= self.stop_low_deg + AT_STOP_DEG else 0

    @property
    def stands(self) -> bool:
        """Whether the shaft stands though its set point moves. A set point that creeps, as at the end of a move, does
        not count as moving."""
        return abs(self.speed_dps) < STANDS_DPS <= self.told_dps


Look = Callable[[AxisTruth], None]


class World:
    """Call `look` at every cycle: it brings `axes` up to the present moment."""

    def __init__(self, rotor: SimRotor, clock: Callable[[], float]) -> None:
        self.rotor = rotor
        self._clock = clock
        self._looks: list[Look] = []
        self.axes: list[AxisTruth] = []
        for place, name in enumerate(AXES):
            truth, look = _eye(rotor, place, name)
            self.axes.append(truth)
            self._looks.append(look)
        self._looked_s = clock()
        for truth, look, boom_deg in zip(self.axes, self._looks, rotor.antenna(), strict=True):
            truth.boom_deg = boom_deg
            look(truth)

    @property
    def relay_starts(self) -> int | None:
        return self.rotor.relay_starts

    def look(self) -> None:
        now_s = self._clock()
        past_s, self._looked_s = now_s - self._looked_s, now_s
        if past_s <= 0:
            return
        booms_deg = self.rotor.antenna()
        for place, (truth, look) in enumerate(zip(self.axes, self._looks, strict=True)):
            before_deg, truth.boom_deg = truth.shaft_deg, booms_deg[place]
            look(truth)
            truth.speed_dps = (truth.shaft_deg - before_deg) / past_s


STEPPER_DPS = 12.0
"""The speed of a stepper, as shipped."""


def _eye(rotor: SimRotor, place: int, name: str) -> tuple[AxisTruth, Look]:
    """The truth of one axis of this kind of rotor, and the function that brings it up to date."""
    match rotor:
        case SimRelayPotRotor() | SimRelayPulseRotor() | SimRelayTimedRotor():
            motor = (rotor.azimuth, rotor.elevation)[place].motor
            lowest = rotor.slowest[place] if isinstance(rotor, SimRelayPotRotor) else 1.0
            truth = _geared(name, motor)
            truth.relayed = True
            return truth, lambda truth: _see_relays(truth, motor, rotor.drives()[place], lowest)
        case SimBridgeRotor():
            motor = (rotor.azimuth, rotor.elevation)[place].motor
            truth = _geared(name, motor)
            return truth, lambda truth: _see_bridge(truth, motor, rotor.drives()[place], rotor.shorted[place])
        case SimDigipotRotor():
            box = (rotor.azimuth, rotor.elevation)[place]
            return _geared(name, box.motor), lambda truth: _see_box(truth, box)
        case SimControllerRotor():
            brain = (rotor.azimuth, rotor.elevation)[place]
            return _geared(name, brain.motor), lambda truth: _see_controlled(truth, brain)
        case SimStepperRotor():
            stepper = (rotor.azimuth, rotor.elevation)[place]
            ends_deg = stepper.motor.spec.low_deg, stepper.motor.spec.high_deg
            truth = AxisTruth(name, STEPPER_DPS, 0.0, *ends_deg)
            return truth, lambda truth: _see_stepper(truth, stepper)
        case SimServoRotor():
            servo = (rotor.azimuth, rotor.elevation)[place]
            spec = servo.spec
            low_deg = spec.low_deg - spec.stop_margin_deg
            high_deg = spec.low_deg + spec.range_deg + spec.stop_margin_deg
            truth = AxisTruth(name, spec.slew_dps, 0.1, low_deg, high_deg)
            return truth, lambda truth: _see_servo(truth, servo)
        case SimMoteusRotor():
            return AxisTruth(name, 30.0, 30.0 / 20.0), lambda truth: _see_moteus(truth, rotor, place)
    raise ValueError(f"no eye for {type(rotor).__name__}")


def _geared(name: str, motor: SimMotor) -> AxisTruth:
    spec = motor.spec
    # Five time constants: less than a hundredth of the speed is left.
    coasts_s = spec.relay_delay_s + 5.0 * spec.lag_s
    return AxisTruth(name, spec.speed_dps, coasts_s, motor.stop_low_deg, motor.stop_high_deg)


def _see_motor(truth: AxisTruth, motor: SimMotor) -> None:
    truth.shaft_deg = motor.shaft_deg
    truth.power = motor.drive if motor.supply else 0
    truth.stop_low_deg, truth.stop_high_deg = motor.stop_low_deg, motor.stop_high_deg
    truth.pushed = motor.pushed != 0.0
    truth.shorted_s = motor.shorted_s
    if motor.brake:
        truth.braked_s, truth.jolts = motor.brake.fed_s, motor.brake.jolts


def _see_relays(truth: AxisTruth, motor: SimMotor, coil: int, lowest: float) -> None:
    _see_motor(truth, motor)
    truth.coil = coil if motor.supply else 0
    truth.sped = motor.throttle > lowest + SPED_SHARE
    truth.welded = motor.welded != 0


def _see_bridge(truth: AxisTruth, motor: SimMotor, coil: int, shorted: int) -> None:
    _see_motor(truth, motor)
    truth.coil, truth.welded = coil, shorted != 0


def _see_box(truth: AxisTruth, box: SimBox) -> None:
    _see_motor(truth, box.motor)
    truth.sent_deg = box.chip.share() * box.spec.full_deg
    truth.coil = truth.power


def _see_controlled(truth: AxisTruth, brain: SimBrain) -> None:
    """What a person does at the controller's knob is no doing of the box."""
    _see_motor(truth, brain.motor)
    truth.pushed, truth.sent_deg = brain.knob != 0, math.nan if brain.target_deg is None else brain.target_deg
    truth.power = truth.coil = 0 if truth.pushed else truth.power


def _see_stepper(truth: AxisTruth, stepper: SimStepperAxis) -> None:
    chip, spec = stepper.chip, stepper.motor.spec
    truth.shaft_deg = stepper.motor.angle_deg
    truth.told_dps = abs(chip.v) / (abs(spec.gear) * spec.steps_per_turn * 256 / 360.0)
    truth.power = truth.coil = (chip.v > 0) - (chip.v < 0) if chip.feeds else 0


def _see_servo(truth: AxisTruth, servo: SimServo) -> None:
    before_deg, truth.shaft_deg = truth.shaft_deg, servo.shaft_deg()
    # A simulated servo does not report its current: it counts as powered while it moves under its pulse.
    turned_deg = truth.shaft_deg - before_deg
    truth.pushed = servo.pushed_dps != 0.0
    truth.power = 0 if truth.pushed or abs(turned_deg) < AT_STOP_DEG else (1 if turned_deg > 0 else -1)
    truth.coil = truth.power


def _see_moteus(truth: AxisTruth, rotor: SimMoteusRotor, place: int) -> None:
    name = AXES[place]
    motor = rotor.controller(name).motor
    truth.shaft_deg = truth.boom_deg
    rev_s = motor.set_point.velocity_rev_s if motor.mode in (Mode.POSITION, Mode.TIMEOUT) else 0.0
    sense = rotor.sense(name)
    truth.told_dps = abs(rev_s / rotor.rev_per_turn(name)) * 360.0
    truth.power = 0 if abs(rev_s) < 1e-6 else (1 if rev_s * sense > 0 else -1)
    truth.coil = truth.power
