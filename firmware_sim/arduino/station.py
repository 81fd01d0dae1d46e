"""The station before this program: a UNO with the F1EFW sketch, two motors, two pots and a display, wired up.

Knows which wire goes where. Knows neither tracking, which the sketch does, nor mechanics, which are in `parts`. It
works with any clock: in simulated time call `run_until`; in real time give it `time.monotonic` and `time.sleep`, and
let a thread call `run` while other threads send orders and read the antenna.
"""

from __future__ import annotations

import random
import threading
from collections.abc import Callable
from dataclasses import dataclass

from firmware_sim.arduino import f1efw
from firmware_sim.arduino.f1efw import Coefficients, F1efwV4
from firmware_sim.arduino.uno import ADC_STEPS, SUPPLY_V, Uno
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.pot import PotSpec, SimPot

# The pots have no end resistors, so the wiper uses the converter's whole range.
AZIMUTH_POT = PotSpec(low_deg=0.0, high_deg=450.0, low_ratio=0.0, high_ratio=1.0)
ELEVATION_POT = PotSpec(low_deg=0.0, high_deg=180.0, low_ratio=0.0, high_ratio=1.0)

LCD_WIRES = (f1efw.LCD.rs, f1efw.LCD.enable, *f1efw.LCD.data)
"""In the order of `Hd44780.pins`; R/W is on ground."""


@dataclass(frozen=True, slots=True)
class Boom:
    """True direction of the antenna on the rotor's own scale. The pots may show another angle."""

    azimuth_deg: float
    elevation_deg: float


def coefficient(pot: PotSpec) -> float:
    """Degrees for each count, as a user of the sketch measures them: turn to the end, read the converter, divide."""
    end_count = min(int(pot.high_ratio * ADC_STEPS), ADC_STEPS - 1)
    return pot.high_deg / end_count


class WiredAxis:
    """A motor on two relay pins with its pot. Moments are arguments, in seconds."""

    def __init__(self, motor: SimMotor, pot: SimPot, plus: int, minus: int) -> None:
        self.motor = motor
        self.pot = pot
        self.relays = {plus: False, minus: False}
        self._plus = plus
        self._minus = minus

    @property
    def drive(self) -> int:
        return int(self.relays[self._plus]) - int(self.relays[self._minus])

    def relay(self, pin: int, closed: bool, now_s: float) -> None:
        self.relays[pin] = closed
        self.motor.coils(self.relays[self._plus], self.relays[self._minus], now_s)

    def wiper_v(self, now_s: float) -> float:
        self.motor.advance(now_s)
        return self.pot.volts(self.motor.shaft_deg)


class ArduinoStation:
    """The constructor switches the station on: the sketch's `setup` runs at once and takes about 60 ms of the clock."""

    def __init__(
        self,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        azimuth: MotorSpec,
        elevation: MotorSpec,
        *,
        azimuth_pot: PotSpec = AZIMUTH_POT,
        elevation_pot: PotSpec = ELEVATION_POT,
        azimuth_start_deg: float = 0.0,
        elevation_start_deg: float = 0.0,
    ) -> None:
        self.relay_starts = 0
        """Number of closures of relays."""
        self.board = Uno(clock, sleep)
        self.display = Hd44780(clock)
        self.azimuth = WiredAxis(
            SimMotor(azimuth, azimuth_start_deg, clock()),
            SimPot(azimuth_pot, SUPPLY_V, chance=random.Random(1)),
            plus=f1efw.CW,
            minus=f1efw.CCW,
        )
        self.elevation = WiredAxis(
            SimMotor(elevation, elevation_start_deg, clock()),
            SimPot(elevation_pot, SUPPLY_V, chance=random.Random(2)),
            plus=f1efw.UP,
            minus=f1efw.DOWN,
        )
        self.sketch = F1efwV4(self.board, Coefficients(coefficient(azimuth_pot), coefficient(elevation_pot)))
        self._lcd_levels = dict.fromkeys(LCD_WIRES, False)
        self._clock = clock
        # One thread may run the sketch while another reads the antenna; both advance the motors.
        self._mechanics = threading.Lock()
        self.board.analog_inputs[f1efw.AZIMUTH_POT] = lambda: self._wiper_v(self.azimuth)
        self.board.analog_inputs[f1efw.ELEVATION_POT] = lambda: self._wiper_v(self.elevation)
        self.board.on_pin.append(self._follow)
        self.sketch.setup()

    def run_until(self, moment_s: float) -> None:
        """Run the sketch until the clock has passed `moment_s`, by less than one turn of its loop.

        For an event at an exact moment on the way (an order, a sample), use an alarm of the clock.
        """
        while self._clock() < moment_s:
            self.sketch.loop()

    def run(self, stop: threading.Event) -> None:
        """Run the sketch in the calling thread until `stop` is set. The pins then keep their levels."""
        while not stop.is_set():
            self.sketch.loop()

    def host_send(self, data: bytes) -> None:
        self.board.host_send(data)

    def host_receive(self) -> bytes:
        return self.board.host_receive()

    def lcd_text(self) -> tuple[str, ...]:
        return self.display.text()

    def antenna(self) -> Boom:
        with self._mechanics:
            now_s = self._clock()
            self.azimuth.motor.advance(now_s)
            self.elevation.motor.advance(now_s)
            return Boom(self.azimuth.motor.boom_deg, self.elevation.motor.boom_deg)

    def drives(self) -> tuple[int, int]:
        """Direction in which the relays switch azimuth and elevation: -1, 0 or 1."""
        return self.azimuth.drive, self.elevation.drive

    def _wiper_v(self, axis: WiredAxis) -> float:
        with self._mechanics:
            return axis.wiper_v(self._clock())

    def _follow(self, now_s: float, pin: int, level: bool) -> None:
        """Pass a pin's new level on to the display or the relay that is wired to it."""
        if pin in LCD_WIRES:
            self._lcd_levels[pin] = level
            self.display.pins(*self._lcd_levels.values())
            return
        for axis in (self.azimuth, self.elevation):
            if pin in axis.relays:
                self.relay_starts += level
                with self._mechanics:
                    axis.relay(pin, level, now_s)
