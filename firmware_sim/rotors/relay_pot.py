"""A simulated rotor of motors on relays with a pot on each shaft, as a Yaesu G-5500.

Knows which relay feeds which motor, which pot is on which shaft, and the rotor's faults by name. Knows no driver and no
converter: it offers lines in the shape of gpiod and the volts at the wipers. The physics is in `parts`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from firmware_sim.buses.pwm import PINS, SimPwm
from firmware_sim.chips.mcp4725 import Mcp4725
from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.pot import PotFault, PotSpec, SimPot
from firmware_sim.parts.relays import RelayPins
from firmware_sim.rotors.geared import RelayedRotor

EARLY_DEG = 4.0
"""Fault `stop-early`: how far the misplaced end stop stands inside the pot's range."""
WIND_SHARE = 0.3
"""Fault `wind-turns`: the share of the motor's speed at which wind turns an axis that is not fed."""
POT_ERROR_DEG = 90.0
"""Error of one reading in fault `pot-jumps`; largest error of each reading in fault `pot-loose`."""


SPEED_BOW = 0.1
"""The speed is not quite a straight line of the voltage: at mid-range it is so much higher, as a share of the range."""


@dataclass(frozen=True, slots=True)
class SpeedInput:
    """An input whose voltage sets the speed: its range, as shares of the output's, and the speed at its lower end, as a
    share of full speed. It is wired to a pin of the PWM, through a filter, or to an MCP4725 at that address.
    """

    lowest: float
    full: float
    slowest: float
    pwm_pin: int | None = None
    address: int | None = None
    bus: int = 1

    def pace(self, share: float) -> float:
        """The speed as a share of full speed, with that much at the output."""
        way = min(max((share - self.lowest) / (self.full - self.lowest), 0.0), 1.0)
        return self.slowest + (1.0 - self.slowest) * (way + 4.0 * SPEED_BOW * way * (1.0 - way))


@dataclass(frozen=True, slots=True)
class RelayPotAxisSpec:
    """One axis: its parts, and the GPIO numbers of its relays."""

    motor: MotorSpec
    pot: PotSpec
    start_deg: float
    plus_pin: int
    minus_pin: int
    brake_pin: int | None = None
    speed: SpeedInput | None = None


@dataclass(frozen=True, slots=True)
class RelayPotSpec:
    """Both axes, and what they share: the relay board's levels, the master relay, the pots' supply."""

    azimuth: RelayPotAxisSpec
    elevation: RelayPotAxisSpec
    relays_active_low: bool = False
    master_pin: int | None = None
    pot_supply_v: float = 3.3


class RelayPotAxis:
    """A motor with its pot. Only the rotor uses it, under the rotor's lock."""

    def __init__(self, spec: RelayPotAxisSpec, supply_v: float, now_s: float) -> None:
        self.spec = spec
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.pot = SimPot(spec.pot, supply_v)


class SimRelayPotRotor(RelayedRotor):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time)."""

    azimuth: RelayPotAxis
    elevation: RelayPotAxis

    def __init__(
        self, spec: RelayPotSpec, clock: Callable[[], float], sleep: Callable[[float], None] | None = None
    ) -> None:
        super().__init__(clock, sleep)
        self.azimuth = RelayPotAxis(spec.azimuth, spec.pot_supply_v, clock())
        self.elevation = RelayPotAxis(spec.elevation, spec.pot_supply_v, clock())
        self.wipers = {
            "azimuth": lambda: self._wiper_v(self.azimuth),
            "elevation": lambda: self._wiper_v(self.elevation),
        }
        azimuth, elevation = spec.azimuth, spec.elevation
        pins = RelayPins(
            azimuth.plus_pin,
            azimuth.minus_pin,
            elevation.plus_pin,
            elevation.minus_pin,
            spec.master_pin,
            azimuth.brake_pin,
            elevation.brake_pin,
        )
        self._wire_relays(pins, active_low=spec.relays_active_low)
        self.faults = self._fault_table()
        self.pwm = SimPwm()
        self.pwm.changed = lambda _number: self._speeds_changed()
        self._speeds: list[tuple[SimMotor, Callable[[], float]]] = []
        """Each motor with a speed input, and what its voltage lets it turn at, as a share of full speed."""
        for name, axis in (("azimuth", self.azimuth), ("elevation", self.elevation)):
            if axis.spec.speed is not None:
                self._wire_speed(name, axis, axis.spec.speed)
        self._speeds_changed()

    def _wire_speed(self, name: str, axis: RelayPotAxis, speed: SpeedInput) -> None:
        if speed.pwm_pin is not None:
            channel = self.pwm.channels[PINS[speed.pwm_pin]]
            self._speeds.append((axis.motor, lambda: speed.pace(channel.share)))
            self.faults["pwm-refuses"] = self._fault_of(self.pwm, "refuses", True, False)
        if speed.address is not None:
            dac = Mcp4725()
            dac.changed = self._speeds_changed
            self._speeds.append((axis.motor, lambda: speed.pace(dac.share)))
            self.wire_i2c(f"{name}-dac", (speed.bus, speed.address), dac)
            self.faults[f"{name}-dac-dips"] = self._single_fault(dac.power_on)

    @property
    def slowest(self) -> tuple[float, float]:
        """What each motor turns at with its speed input at the lowest, as a share of full speed; 1: it has no input."""
        azimuth, elevation = (axis.spec.speed for axis in (self.azimuth, self.elevation))
        return azimuth.slowest if azimuth else 1.0, elevation.slowest if elevation else 1.0

    def _speeds_changed(self) -> None:
        with self._lock:
            self._advance()
            for motor, pace in self._speeds:
                motor.throttle = pace()

    def _wiper_v(self, axis: RelayPotAxis) -> float:
        with self._lock:
            axis.motor.advance(self._clock())
            return axis.pot.volts(axis.motor.shaft_deg)

    def _fault_table(self) -> dict[str, SimFault]:
        """Of one axis, `pot-open`, `-shorted`, `-reversed` and `-stuck` exclude each other; so do `wind-turns` and
        `hand-turns`.
        """
        table = {"bus-hung": SimFault(self._hang_buses, self._release_buses)}
        for name, axis in (("azimuth", self.azimuth), ("elevation", self.elevation)):
            stop_deg, early_deg = axis.spec.motor.stop_high_deg, axis.spec.pot.high_deg - EARLY_DEG
            table |= {
                f"{name}-pot-open": self._pot_fault(axis, PotFault.OPEN),
                f"{name}-pot-shorted": self._pot_fault(axis, PotFault.SHORTED),
                f"{name}-pot-reversed": self._pot_fault(axis, PotFault.REVERSED),
                f"{name}-pot-stuck": self._pot_fault(axis, PotFault.STUCK),
                f"{name}-pot-jumps": self._single_fault(partial(axis.pot.disturb_once, POT_ERROR_DEG)),
                f"{name}-pot-loose": self._fault_of(axis.pot, "loose_deg", POT_ERROR_DEG, 0.0),
                f"{name}-wind-turns": self._fault_of(axis.motor, "pushed", WIND_SHARE, 0.0),
                f"{name}-stop-early": self._fault_of(axis.motor, "stop_high_deg", early_deg, stop_deg),
            }
            table |= self._pot_sampling(name, axis.pot)
        return table | self._motor_faults()

    def _pot_fault(self, axis: RelayPotAxis, fault: PotFault) -> SimFault:
        def become(wanted: PotFault) -> None:
            axis.pot.break_down(wanted, axis.motor.shaft_deg)

        return self._fault_by(lambda: become(fault), lambda: become(PotFault.NONE))
