"""A simulated rotor of two steppers on chips with ramps, as of SatNOGS v3: worm gears, end switches or bare stops.

Knows which select each chip is on, the line ENN of both, the switches at the lower ends, and the rotor's faults by
name. Knows no driver: it offers a module in the shape of spidev and lines in the shape of gpiod. There is no play.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from firmware_sim.chips.tmc5160 import Tmc5160
from firmware_sim.faults import SimFault
from firmware_sim.parts.stepper import SimStepper, StepperMotorSpec
from firmware_sim.rotors.rotor import AXES, SimRotor


@dataclass(frozen=True, slots=True)
class StepperAxisSpec:
    """`select`: the chip is at /dev/spidev0.SELECT. `switch_deg`: there the switch at its lower end opens; None: it has
    none.
    """

    select: int
    model: str = "tmc5160"
    clock_hz: float = 12e6
    switch_deg: float | None = None
    motor: StepperMotorSpec = field(default_factory=StepperMotorSpec)


class SimStepperAxis:
    def __init__(self, spec: StepperAxisSpec, clock: Callable[[], float]) -> None:
        self.motor = SimStepper(spec.motor)
        self.switch_open = False
        """Fault: the wire of the switch is broken."""
        self._switch_deg = spec.switch_deg
        self.chip = Tmc5160(clock, self.motor, model=spec.model, clock_hz=spec.clock_hz, switch_high=self._switch_high)

    def _switch_high(self) -> bool:
        """Normally closed to ground, with a resistor to the supply: open is high."""
        return self.switch_open or (self._switch_deg is not None and self.motor.angle_deg <= self._switch_deg)


class SimStepperRotor(SimRotor):
    """`clock` gives seconds; `sleep` lets time pass on the I2C bus (None: transfers take no time).

    `enable_pin`: the line of ENN of both chips, with a pull-up to 3.3 V; None: wired to ground.
    """

    def __init__(
        self,
        azimuth: StepperAxisSpec,
        elevation: StepperAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        enable_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self._enable_pin = enable_pin
        self.azimuth, self.elevation = SimStepperAxis(azimuth, clock), SimStepperAxis(elevation, clock)
        self.axes = dict(zip(AXES, (self.azimuth, self.elevation), strict=True))
        self.enable_broken = False
        self.spidev.chips |= {(0, azimuth.select): self.azimuth.chip, (0, elevation.select): self.elevation.chip}
        if enable_pin is not None:
            self.gpio.drive_input(enable_pin, True)
            self.gpio.on_edges.append(self._lines_changed)
        self._set_enn()
        self.faults |= self._fault_table()

    def antenna(self) -> tuple[float, float]:
        self._advance()
        return self.azimuth.motor.angle_deg, self.elevation.motor.angle_deg

    def drives(self) -> tuple[int, int]:
        """The direction in which each ramp is ordered to run."""
        self._advance()
        azimuth, elevation = (axis.chip.ordered for axis in self.axes.values())
        return azimuth, elevation

    def kept(self) -> dict[str, float]:
        return {
            f"{name}_{key}": value
            for name, axis in self.axes.items()
            if axis.chip.supplied
            for key, value in axis.chip.kept().items()
        }

    def put_back(self, kept: Mapping[str, float]) -> None:
        for name, axis in self.axes.items():
            own = {key.removeprefix(f"{name}_"): value for key, value in kept.items() if key.startswith(f"{name}_")}
            if own:
                axis.chip.put_back(own)

    def _lines_changed(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        if self._enable_pin in changes:
            self._advance()
            self._set_enn()

    def _set_enn(self) -> None:
        high = self.enable_broken or (self._enable_pin is not None and self.gpio.level(self._enable_pin))
        for axis in self.axes.values():
            axis.chip.enn = high
            axis.chip.advance()

    def _advance(self) -> None:
        with self._lock:
            for axis in self.axes.values():
                axis.chip.advance()

    def _fault_table(self) -> dict[str, SimFault]:
        table = {"enable-broken": self._enable_fault()}
        for name, axis in self.axes.items():
            chip = axis.chip
            table |= {
                f"{name}-chip-silent": self._fault_of(chip, "dumb", True, False),
                f"{name}-chip-dips": self._single_fault(lambda chip=chip: self._dip(chip)),  # type: ignore[misc]
                f"{name}-chip-unpowered": self._fault_by(
                    lambda chip=chip: chip.power(on=False),  # type: ignore[misc]
                    lambda chip=chip: chip.power(on=True),  # type: ignore[misc]
                ),
                f"{name}-driver-hot": self._fault_of(chip, "hot", True, False),
                f"{name}-driver-warm": self._fault_of(chip, "warm", True, False),
                f"{name}-coil-short": self._fault_of(chip, "shorted", True, False),
                f"{name}-coil-open": self._fault_of(chip, "open_coil", True, False),
                f"{name}-held": self._fault_of(axis.motor, "held", True, False),
                f"{name}-switch-broken": self._fault_of(axis, "switch_open", True, False),
            }
        return table

    def _enable_fault(self) -> SimFault:
        def broken(value: bool) -> None:
            self.enable_broken = value
            self._set_enn()

        return self._fault_by(lambda: broken(True), lambda: broken(False))

    @staticmethod
    def _dip(chip: Tmc5160) -> None:
        chip.power(on=False)
        chip.power(on=True)
