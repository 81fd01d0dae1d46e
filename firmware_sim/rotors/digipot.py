"""A simulated rotor of two control boxes of the ORBIT-360 kind, each with an MCP41010 in place of its knob.

Knows which lines the chips are on, how a box compares the wiper with its own pot, and the rotor's faults by name. Knows
no driver: it offers lines in the shape of gpiod and a module in the shape of spidev. Not simulated: the noise and the
errors of a box's own pot, and what the box's front panel does.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from firmware_sim.chips.mcp41010 import Mcp41010
from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.rotors.geared import GearedRotor

BOX_MOTOR = MotorSpec(
    speed_dps=6.0, lag_s=0.15, relay_delay_s=0.015, backlash_deg=0.5, stop_low_deg=-3.0, stop_high_deg=363.0
)
COMPARE_S = 0.005
"""Period of the comparison. A real box compares continuously."""


@dataclass(frozen=True, slots=True)
class DigipotAxisSpec:
    """One axis: its box, and the GPIO number of its chip's select line."""

    select_pin: int
    start_deg: float = 0.0
    motor: MotorSpec = BOX_MOTOR
    full_deg: float = 360.0
    """The rotor's angle with the knob at its upper end. The lower end is 0°."""
    dead_band_deg: float = 2.0


class SimBox:
    """A comparator between two wipers, and its motor. Only the rotor uses it, under the rotor's lock."""

    def __init__(self, spec: DigipotAxisSpec, now_s: float) -> None:
        self.spec = spec
        self.chip = Mcp41010()
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.starts = 0
        """Number of times the box has switched its motor on."""
        self._now_s = now_s
        self._driven = 0

    def advance(self, now_s: float) -> None:
        """Compare and turn up to `now_s`."""
        reach_deg = self.motor.fastest_dps * COMPARE_S
        while self._now_s < now_s:
            # Comparisons before the shaft can have come to the edge of the dead band change nothing.
            idle = int(abs(self._compare()) / reach_deg)
            self._now_s = min(self._now_s + max(1, idle) * COMPARE_S, now_s)
            self.motor.advance(self._now_s)

    def _compare(self) -> float:
        """Switch the motor. Returns how far the error is from the edge of the dead band."""
        error_deg = self.chip.share() * self.spec.full_deg - self.motor.shaft_deg
        driven = 0 if abs(error_deg) <= self.spec.dead_band_deg else 1 if error_deg > 0 else -1
        if driven != self._driven:
            self._driven = driven
            self.starts += driven != 0
            self.motor.coils(driven > 0, driven < 0, self._now_s)
        return abs(error_deg) - self.spec.dead_band_deg


class SimDigipotRotor(GearedRotor):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time).

    `enable_pin`: the line of a relay that feeds both boxes while the line is high; None: they are always fed.
    """

    azimuth: SimBox
    elevation: SimBox

    def __init__(
        self,
        azimuth: DigipotAxisSpec,
        elevation: DigipotAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        sck_pin: int = 11,
        si_pin: int = 10,
        enable_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self._wires = sck_pin, si_pin
        self._enable_pin = enable_pin
        self.azimuth, self.elevation = SimBox(azimuth, clock()), SimBox(elevation, clock())
        self.spidev.chips |= {(0, 0): self.azimuth.chip, (0, 1): self.elevation.chip}
        self._boxes = self.azimuth, self.elevation
        for box in self._boxes:
            box.chip.before_change.append(self._advance)
            box.motor.supply = enable_pin is None or self.gpio.level(enable_pin)
        self.gpio.on_edges.append(self._lines_changed)
        self.faults = self._fault_table()

    def _lines_changed(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        with self._lock:
            if self._enable_pin is not None and self._enable_pin in changes:
                self._advance()
                for box in self._boxes:
                    box.motor.supply = changes[self._enable_pin]
            sck, si = (self.gpio.level(pin) for pin in self._wires)
            for box in self._boxes:
                box.chip.pins(cs=self.gpio.level(box.spec.select_pin), sck=sck, si=si)

    def _advance(self) -> None:
        with self._lock:
            for box in self._boxes:
                box.advance(self._clock())

    def _fault_table(self) -> dict[str, SimFault]:
        table: dict[str, SimFault] = {}
        for name, box in (("azimuth", self.azimuth), ("elevation", self.elevation)):
            table |= {
                f"{name}-chip-dips": self._single_fault(box.chip.power_on),
                f"{name}-select-broken": self._fault_of(box.chip, "deaf", True, False),
            }
        return table | self._motor_faults()
