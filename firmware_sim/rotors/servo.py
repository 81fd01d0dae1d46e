"""A simulated rotor of two hobby servos on a PCA9685, and the antenna they turn.

Knows which output each servo is on, the board's OE line, and the rotor's faults by name. Knows no driver: it offers a
bus in the shape of smbus2 and lines in the shape of gpiod. The boom is the servo's own shaft: there is no backlash.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from firmware_sim.chips.pca9685 import Pca9685
from firmware_sim.faults import SimFault
from firmware_sim.parts.servo import SimServo, SimServoSpec
from firmware_sim.rotors.rotor import SimRotor

REGISTERS = (*range(0x46), 0xFE)
"""Of the board: its modes, its outputs and its frequency."""
WIND_DPS = 10.0
"""Fault `wind-turns`: the speed at which the wind turns a servo without torque."""


@dataclass(frozen=True, slots=True)
class ServoAxisSpec:
    """One axis: the board's output for its servo, and the servo's angle at power-on."""

    channel: int
    start_deg: float = 90.0
    servo: SimServoSpec = field(default_factory=SimServoSpec)


class SimServoRotor(SimRotor):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time).

    `enable_pin`: the line at the board's OE input, active low, with a pull-up to 3.3 V beside it.
    """

    def __init__(
        self,
        azimuth: ServoAxisSpec,
        elevation: ServoAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        place: tuple[int, int] = (1, 0x40),
        enable_pin: int | None = None,
        osc_hz: float = 25e6,
    ) -> None:
        super().__init__(clock, sleep)
        self._enable_pin = enable_pin
        self._enabled = enable_pin is None
        self.board = Pca9685(clock, osc_hz=osc_hz)
        self.wire_i2c("board", place, self.board)
        self.azimuth, self.elevation = (
            SimServo(spec.servo, spec.start_deg, clock, lambda spec=spec: self._pulse_us(spec.channel))  # type: ignore[misc]
            for spec in (azimuth, elevation)
        )
        self.board.before_change.append(self._advance)
        if enable_pin is not None:
            self.gpio.drive_input(enable_pin, True)
            self.gpio.on_edges.append(self._lines_changed)
        self.faults |= self._fault_table()

    def antenna(self) -> tuple[float, float]:
        with self._lock:
            return self.azimuth.angle_deg(), self.elevation.angle_deg()

    def shafts(self) -> tuple[float, float]:
        """As `antenna`, without the jitter of a servo that holds."""
        with self._lock:
            return self.azimuth.shaft_deg(), self.elevation.shaft_deg()

    def kept(self) -> dict[str, float]:
        """The board's registers, while it has supply: it goes on with its pulses when the program has ended."""
        return {f"board_{number}": value for number in REGISTERS if (value := self.board.register(number))}

    def put_back(self, kept: Mapping[str, float]) -> None:
        self._advance()
        self.board.put_back({number: int(kept.get(f"board_{number}", 0)) for number in REGISTERS} if kept else {})

    def _pulse_us(self, channel: int) -> float | None:
        return self.board.pulse_us(channel) if self._enabled else None

    def _lines_changed(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        if self._enable_pin is not None and self._enable_pin in changes:
            self._advance()
            self._enabled = not changes[self._enable_pin]

    def _advance(self) -> None:
        with self._lock:
            self.azimuth.advance()
            self.elevation.advance()

    def _fault_table(self) -> dict[str, SimFault]:
        table = {
            "board-unpowered": self._fault_of(self.board, "supply", False, True),
            "bus-hung": SimFault(self._hang_buses, self._release_buses),
            "board-dips": self._single_fault(self._dip),
        }
        for name, servo in (("azimuth", self.azimuth), ("elevation", self.elevation)):
            table |= {
                f"{name}-servo-stalled": self._fault_of(servo, "stalled", True, False),
                f"{name}-servo-unpowered": self._fault_of(servo, "powered", False, True),
                f"{name}-wind-turns": self._fault_of(servo, "pushed_dps", WIND_DPS, 0.0),
            }
        return table

    def _dip(self) -> None:
        """Interrupt the board's supply, which resets the chip. A board without supply stays so."""
        before, self.board.supply = self.board.supply, False
        self.board.supply = before
