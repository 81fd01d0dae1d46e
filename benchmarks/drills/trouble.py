"""Troubles of the world beyond the simulators' own faults: readings that are spoilt, contacts that weld, slow motors.

Knows how to begin and end each trouble on the simulated parts. Does not know when. A contact can weld only while it is
closed, so a weld waits until then.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable

from firmware_sim.parts.motor import SimMotor
from firmware_sim.rotors.controller import SimControllerRotor
from firmware_sim.rotors.digipot import SimDigipotRotor
from firmware_sim.rotors.h_bridge import SimBridgeRotor
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from firmware_sim.rotors.relay_pulse import SimRelayPulseRotor
from firmware_sim.rotors.relay_timed import SimRelayTimedRotor
from firmware_sim.rotors.rotor import AXES, SimRotor

SUPPLY_V = 3.3


class Wiper:
    """A pot's wiper with its troubles: calling it gives volts. Each public field is a trouble; 0 or False: none."""

    def __init__(self, volts: Callable[[], float], degree_v: float, clock: Callable[[], float], seed: str) -> None:
        self._volts = volts
        self._degree_v = degree_v
        self._clock = clock
        self._chance = random.Random(seed)
        self._count = 0
        self._last_v = 0.0
        self.every = 0
        """Each `every`-th reading is bad; 0: none."""
        self.bad = "zero"
        """The value of a bad reading: zero, full, far, near; or last, the good reading before it."""
        self.noise_deg = 0.0
        self.drift_dps = 0.0
        self.drift_most_deg = 0.0
        self.drift_since_s = 0.0
        self.burst_until_s = -math.inf
        self.stands = False

    def __call__(self) -> float:
        if self.stands:
            return self._last_v
        volts = self._volts() + self._shift_deg() * self._degree_v
        self._count += 1
        if self._clock() < self.burst_until_s or (self.every and self._count % self.every == 0):
            return self._spoilt(volts)
        self._last_v = volts
        return volts

    def _shift_deg(self) -> float:
        shift_deg = self._chance.gauss(0.0, self.noise_deg) if self.noise_deg else 0.0
        if self.drift_dps:
            drifted_deg = self.drift_dps * (self._clock() - self.drift_since_s)
            shift_deg += min(max(drifted_deg, -self.drift_most_deg), self.drift_most_deg)
        return shift_deg

    def _spoilt(self, volts: float) -> float:
        match self.bad:
            case "zero":
                return 0.0
            case "full":
                return SUPPLY_V
            case "far":
                return self._chance.uniform(0.1, 0.9) * SUPPLY_V
            case "near":
                return volts + self._chance.choice((-1, 1)) * self._chance.uniform(3.0, 15.0) * self._degree_v
            case _:
                return self._last_v


class Troubles:
    """The troubles of one simulated rotor."""

    def __init__(self, rotor: SimRotor, clock: Callable[[], float], seed: str) -> None:
        self._rotor = rotor
        self._clock = clock
        self.wipers: dict[str, Wiper] = {}
        self._waiting: dict[tuple[str, int], None] = {}
        """The contacts that weld when they next close, by axis and direction."""
        for name, volts in list(rotor.wipers.items()):
            self.wipers[name] = rotor.wipers[name] = Wiper(volts, 0.9 * SUPPLY_V / 360.0, clock, f"{seed} {name}")

    def motor(self, axis: str) -> SimMotor | None:
        """The geared motor of an axis; None: this kind has none."""
        match self._rotor:
            case SimRelayPotRotor() | SimRelayPulseRotor() | SimRelayTimedRotor() | SimDigipotRotor():
                return (self._rotor.azimuth, self._rotor.elevation)[AXES.index(axis)].motor
            case SimBridgeRotor() | SimControllerRotor():
                return (self._rotor.azimuth, self._rotor.elevation)[AXES.index(axis)].motor
        return None

    def begin(self, what: str, args: tuple[float | str, ...]) -> None:
        axis = str(args[0]) if args else ""
        match what:
            case "fault":
                self._rotor.inject(axis)
            case "clear":
                self._rotor.clear(axis)
            case "weld":
                self._waiting[axis, int(float(args[1]))] = None
            case "unweld":
                self._unweld(axis)
            case "pace" | "push" | "sticks":
                self._turn(what, axis, float(args[1]))
            case "obstacle":
                self._hold_up(axis, float(args[1]))
            case _ if axis in self.wipers:
                self._spoil(self.wipers[axis], what, args[1:])

    def look(self) -> None:
        """Weld the contacts that wait for it and are closed now."""
        if not self._waiting:
            return
        drives = self._rotor.drives()
        for axis, way in list(self._waiting):
            motor = self.motor(axis)
            if motor is None:
                del self._waiting[axis, way]
            elif drives[AXES.index(axis)] == way and motor.drive and motor.supply:
                del self._waiting[axis, way]
                if not motor.welded:
                    names = {("azimuth", 1): "cw", ("azimuth", -1): "ccw", ("elevation", 1): "up"}
                    self._rotor.inject(f"{axis}-relay-welded-{names.get((axis, way), 'down')}")

    def _unweld(self, axis: str) -> None:
        for key in [key for key in self._waiting if key[0] == axis]:
            del self._waiting[key]
        end = "cw" if axis == "azimuth" else "up"
        if f"{axis}-relay-welded-{end}" in self._rotor.faults:
            self._rotor.clear(f"{axis}-relay-welded-{end}")

    def _turn(self, what: str, axis: str, share: float) -> None:
        if (motor := self.motor(axis)) is None:
            return
        motor.advance(self._clock())
        setattr(motor, {"pace": "pace", "push": "pushed", "sticks": "sticks_s"}[what], share)

    def _hold_up(self, axis: str, room_deg: float) -> None:
        """From now on an obstacle holds the axis `room_deg` from here, in both directions. Infinite: no obstacle."""
        if (motor := self.motor(axis)) is None:
            return
        motor.advance(self._clock())
        spec, here_deg = motor.spec, motor.shaft_deg
        motor.stop_low_deg = max(spec.stop_low_deg, here_deg - room_deg)
        motor.stop_high_deg = min(spec.stop_high_deg, here_deg + room_deg)

    def _spoil(self, wiper: Wiper, what: str, args: tuple[float | str, ...]) -> None:
        match what:
            case "every":
                wiper.every, wiper.bad = int(float(args[0])), str(args[1])
            case "burst":
                wiper.burst_until_s, wiper.bad = self._clock() + float(args[0]), str(args[1])
            case "noise":
                wiper.noise_deg = float(args[0])
            case "drift":
                wiper.drift_dps, wiper.drift_most_deg = float(args[0]), float(args[1])
                wiper.drift_since_s = self._clock()
            case "stands":
                wiper.stands = bool(float(args[0]))
