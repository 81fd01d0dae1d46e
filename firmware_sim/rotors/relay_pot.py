"""A simulated rotor of motors on relays with a pot on each shaft, as a Yaesu G-5500.

Knows which relay feeds which motor, which pot is on which shaft, and the rotor's faults by name. Knows no driver and no
converter: it offers lines in the shape of gpiod and the volts at the wipers. The physics is in `parts`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

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


@dataclass(frozen=True, slots=True)
class RelayPotAxisSpec:
    """One axis: its parts, and the GPIO numbers of its relays."""

    motor: MotorSpec
    pot: PotSpec
    start_deg: float
    plus_pin: int
    minus_pin: int


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
        pins = RelayPins(azimuth.plus_pin, azimuth.minus_pin, elevation.plus_pin, elevation.minus_pin, spec.master_pin)
        self._wire_relays(pins, active_low=spec.relays_active_low)
        self.faults = self._fault_table()

    def _wiper_v(self, axis: RelayPotAxis) -> float:
        with self._lock:
            axis.motor.advance(self._clock())
            return axis.pot.volts(axis.motor.shaft_deg)

    def _fault_table(self) -> dict[str, SimFault]:
        """Of one axis, `pot-open`, `-shorted`, `-reversed` and `-stuck` exclude each other; so do `wind-turns` and
        `hand-turns`.
        """
        table = {"bus-hung": SimFault(self.bus.hang, self.bus.release)}
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
