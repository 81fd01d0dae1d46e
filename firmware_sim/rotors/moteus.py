"""A simulated rotor of two moteus controllers, and its faults by name.

Knows which controller turns which axis, the scale from revolutions to degrees of the antenna, and the rotor's faults by
name. Knows no driver: it offers a transport in the shape of the library's own, and an adapter on a pseudo-terminal.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from firmware_sim.faults import SimFault
from firmware_sim.moteus.bus import SimCan, SimTransport
from firmware_sim.moteus.controller import SimController
from firmware_sim.moteus.lines import LineServer
from firmware_sim.moteus.motor import Home, Mode, MoteusSettings, SimMoteusMotor
from firmware_sim.moteus.terminal import SimAdapter
from firmware_sim.rotors.rotor import EACH_BURST, EACH_READING, SimRotor
from firmware_sim.sporadic import Sporadic

FAULT_CODES = {
    "calibration": 32,
    "gate-driver": 33,
    "over-voltage": 34,
    "encoder": 35,
    "not-configured": 36,
    "pwm-overrun": 37,
    "over-temperature": 38,
    "start-outside-limit": 39,
    "under-voltage": 40,
    "config-changed": 41,
    "theta-invalid": 42,
    "position-invalid": 43,
    "driver-enable": 44,
    "stop-position": 45,
    "timing": 46,
    "bemf-feedforward": 47,
    "invalid-limits": 48,
    "position-error": 49,
    "velocity-error": 50,
}
"""The firmware's fault codes. After each of them the motor has no torque until the controller gets a stop."""

FACTORY_BOUND_REV = 0.01
"""Fault `factory-bounds`: the position bounds of a controller that was never configured."""
GAP_REPLIES = 8
"""Fault `replies-gaps`: so many replies in a row are lost."""
LATE_S = 0.3
"""Fault `lines-late`: the delay of each reply."""


@dataclass(frozen=True, slots=True)
class MoteusAxisSpec:
    """One axis: its controller's CAN id, its scale, and its settings."""

    can_id: int
    start_deg: float = 0.0
    rev_per_turn: float = 1.0
    """Revolutions of the controller's scale for 360° of the antenna; negative if the directions are opposite."""
    zero_rev: float = 0.0
    settings: MoteusSettings = field(default_factory=MoteusSettings)


class SimMoteusRotor(SimRotor):
    """`clock` gives seconds: a SimClock for `transport`, real time for `adapter`."""

    def __init__(
        self,
        azimuth: MoteusAxisSpec,
        elevation: MoteusAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self._specs = {"azimuth": azimuth, "elevation": elevation}
        self._controllers = {
            name: SimController(
                clock,
                spec.settings,
                shaft_rev=spec.zero_rev + spec.start_deg / 360 * spec.rev_per_turn,
                serial=spec.can_id,
            )
            for name, spec in self._specs.items()
        }
        self.can = SimCan({spec.can_id: self._controllers[name] for name, spec in self._specs.items()})
        self.lines = LineServer(self.can, clock)
        self.faults = self._fault_table()

    def transport(self) -> SimTransport:
        """For the library in simulated time, all in one thread."""
        return SimTransport(self.can)

    def adapter(self, path: Path) -> SimAdapter:
        """For the library in real time. `plug` makes it appear at `path`. Adds the fault `adapter-unplugged`."""

        def receive(data: bytes) -> list[tuple[float, bytes]]:
            with self._lock:
                return self.lines.receive(data)

        adapter = SimAdapter(path, receive, self._clock)
        self.faults["adapter-unplugged"] = SimFault(adapter.unplug, adapter.plug)
        return adapter

    def controller(self, axis: str) -> SimController:
        """The controller of `azimuth` or `elevation`, for tests."""
        return self._controllers[axis]

    def sense(self, axis: str) -> int:
        """1: the controller's scale rises as the axis's does; -1: it falls."""
        return 1 if self.rev_per_turn(axis) > 0 else -1

    def rev_per_turn(self, axis: str) -> float:
        """Revolutions of the controller's scale for a turn of the antenna; negative if the directions are opposite."""
        return self._specs[axis].rev_per_turn

    def antenna(self) -> tuple[float, float]:
        azimuth_deg, elevation_deg = (self._antenna_deg(name) for name in self._specs)
        return azimuth_deg, elevation_deg

    def kept(self) -> dict[str, float]:
        with self._lock:
            kept: dict[str, float] = {}
            for name, controller in self._controllers.items():
                kept[f"{name}_scale_rev"] = controller.motor.scale_rev
                kept[f"{name}_home"] = controller.motor.home
                kept[f"{name}_moved"] = controller.motor.mode in (Mode.POSITION, Mode.TIMEOUT)
            return kept

    def put_back(self, kept: Mapping[str, float]) -> None:
        with self._lock:
            for name, controller in self._controllers.items():
                controller.motor.power_cycle()
                if f"{name}_scale_rev" in kept:
                    controller.motor.scale_rev = kept[f"{name}_scale_rev"]
                    controller.motor.home = Home(int(kept[f"{name}_home"]))
                if kept.get(f"{name}_moved"):
                    controller.motor.time_out()

    def _antenna_deg(self, name: str) -> float:
        spec = self._specs[name]
        with self._lock:
            motor = self._controllers[name].motor
            motor.advance()
            return (motor.shaft_rev - spec.zero_rev) / spec.rev_per_turn * 360

    def _fault_table(self) -> dict[str, SimFault]:
        mishaps = self.lines.mishaps
        table = {
            "adapter-deaf": self._fault_of(mishaps, "deaf", True, False),
            "lines-dropped": self._fault_of(mishaps, "dropped", True, False),
            "lines-garbled": self._fault_of(mishaps, "garbled", True, False),
            "lines-late": self._fault_of(mishaps, "late_s", LATE_S, 0.0),
        }
        for axis, spec in self._specs.items():
            motor, can_id = self._controllers[axis].motor, spec.can_id
            lost, gaps = self.can.lapses[can_id] = Sporadic(), Sporadic(GAP_REPLIES)
            table |= {
                f"{axis}-silent": SimFault(
                    partial(self.can.muted.add, can_id), partial(self.can.muted.discard, can_id)
                ),
                f"{axis}-replies-lost": self._sporadic_fault(lost, EACH_READING),
                f"{axis}-replies-gaps": self._sporadic_fault(gaps, EACH_BURST),
                f"{axis}-jammed": self._fault_of(motor, "jammed", True, False),
                f"{axis}-power-cycled": self._single_fault(motor.power_cycle),
                f"{axis}-factory-bounds": self._bounds(motor),
            }
            for name, code in FAULT_CODES.items():
                table[f"{axis}-{name}"] = self._single_fault(partial(motor.fail, code))
        return table

    def _advance(self) -> None:
        for controller in self._controllers.values():
            controller.motor.advance()

    def _bounds(self, motor: SimMoteusMotor) -> SimFault:
        settings = motor.settings
        bounds = settings.position_min_rev, settings.position_max_rev

        def become(low_rev: float, high_rev: float) -> None:
            settings.position_min_rev, settings.position_max_rev = low_rev, high_rev

        return self._fault_by(lambda: become(-FACTORY_BOUND_REV, FACTORY_BOUND_REV), lambda: become(*bounds))
