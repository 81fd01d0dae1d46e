"""A simulated rotor of relays and pots.

Knows what is wired where, and its faults by name. Knows no driver and no converter: it offers lines in the shape of
gpiod and the volts at the wipers, and the rest is physics.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.pot import PotFault, PotSpec, SimPot
from firmware_sim.rotors.rotor import GearedRotor

EARLY_DEG = 4.0
"""How far inside the range a misplaced end stop stands."""


@dataclass(frozen=True, slots=True)
class AxisSpec:
    """One axis of the rotor: its parts, and where they are wired."""

    motor: MotorSpec
    pot: PotSpec
    start_deg: float
    plus_pin: int
    minus_pin: int


@dataclass(frozen=True, slots=True)
class WorldSpec:
    azimuth: AxisSpec
    elevation: AxisSpec
    relays_active_low: bool = False
    master_pin: int | None = None
    pot_supply_v: float = 3.3


class SimAxis:
    """A motor with its pot. Looked at only through the world, under its lock."""

    def __init__(self, spec: AxisSpec, supply_v: float, now_s: float) -> None:
        self.spec = spec
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.pot = SimPot(spec.pot, supply_v)
        self.coils = (False, False)


class World(GearedRotor):
    """`clock` tells the time, `sleep` lets it pass on the bus (None: transfers take none)."""

    azimuth: SimAxis
    elevation: SimAxis

    def __init__(
        self, spec: WorldSpec, clock: Callable[[], float], sleep: Callable[[float], None] | None = None
    ) -> None:
        super().__init__(clock, sleep)
        self._spec = spec
        self.azimuth = SimAxis(spec.azimuth, spec.pot_supply_v, clock())
        self.elevation = SimAxis(spec.elevation, spec.pot_supply_v, clock())
        self.relay_starts: int = 0
        self.wipers = {
            "azimuth": lambda: self._wiper_v(self.azimuth),
            "elevation": lambda: self._wiper_v(self.elevation),
        }
        self.gpio.on_edges.append(self._relays_changed)
        self.faults = self._fault_table()
        if spec.master_pin is not None:
            self._relays_changed(clock(), {spec.master_pin: self.gpio.level(spec.master_pin)})

    def drives(self) -> tuple[int, int]:
        with self._lock:
            coils = (self.azimuth.coils, self.elevation.coils)
            azimuth, elevation = (int(plus) - int(minus) for plus, minus in coils)
            return azimuth, elevation

    def _relays_changed(self, now_s: float, changes: Mapping[int, bool]) -> None:
        with self._lock:
            for axis in (self.azimuth, self.elevation):
                pins = (axis.spec.plus_pin, axis.spec.minus_pin)
                if changes.keys() & set(pins):
                    plus, minus = axis.coils = (self._pulled(pins[0]), self._pulled(pins[1]))
                    axis.motor.coils(plus, minus, now_s)
                    self.relay_starts += sum(self._pulled(pin) for pin in changes.keys() & set(pins))
            master = self._spec.master_pin
            if master is not None and master in changes:
                self._advance()
                supply = self._pulled(master)
                self.azimuth.motor.supply = self.elevation.motor.supply = supply

    def _pulled(self, pin: int) -> bool:
        return self.gpio.level(pin) != self._spec.relays_active_low

    def _advance(self) -> None:
        now_s = self._clock()
        self.azimuth.motor.advance(now_s)
        self.elevation.motor.advance(now_s)

    def _wiper_v(self, axis: SimAxis) -> float:
        with self._lock:
            self._advance()
            return axis.pot.volts(axis.motor.shaft_deg)

    def _fault_table(self) -> dict[str, SimFault]:
        table = {
            "bus-hung": SimFault(self.bus.hang, self.bus.release),
        }
        for name, axis, plus, minus in (
            ("azimuth", self.azimuth, "cw", "ccw"),
            ("elevation", self.elevation, "up", "down"),
        ):
            table |= {
                f"{name}-pot-open": self._pot_fault(axis, PotFault.OPEN),
                f"{name}-pot-shorted": self._pot_fault(axis, PotFault.SHORTED),
                f"{name}-pot-reversed": self._pot_fault(axis, PotFault.REVERSED),
                f"{name}-pot-stuck": self._pot_fault(axis, PotFault.STUCK),
                f"{name}-pot-jumps": SimFault(lambda axis=axis: self._jump(axis), lambda: None),  # type: ignore[misc]
                f"{name}-pot-loose": self._fault_of(axis.pot, "loose_deg", 90.0, 0.0),
                f"{name}-motor-stalled": self._fault_of(axis.motor, "stalled", True, False),
                f"{name}-motor-reversed": self._fault_of(axis.motor, "reversed", True, False),
                f"{name}-motor-slow": self._fault_of(axis.motor, "pace", 0.4, 1.0),
                f"{name}-hand-turns": self._fault_of(axis.motor, "pushed", 1.0, 0.0),
                f"{name}-wind-turns": self._fault_of(axis.motor, "pushed", 0.3, 0.0),
                f"{name}-stop-early": self._fault_of(
                    axis.motor,
                    "stop_high_deg",
                    axis.spec.pot.high_deg - EARLY_DEG,
                    axis.spec.motor.stop_high_deg,
                ),
                f"{name}-relay-welded-{plus}": self._fault_of(axis.motor, "welded", 1, 0),
                f"{name}-relay-welded-{minus}": self._fault_of(axis.motor, "welded", -1, 0),
            }
        return table

    def _pot_fault(self, axis: SimAxis, fault: PotFault) -> SimFault:
        def inject() -> None:
            with self._lock:
                self._advance()
                if fault is PotFault.STUCK:
                    axis.pot.stick(axis.motor.shaft_deg)
                axis.pot.fault = fault

        def clear() -> None:
            axis.pot.fault = PotFault.NONE

        return SimFault(inject, clear)

    def _jump(self, axis: SimAxis) -> None:
        axis.pot.jump_deg = 90.0
