"""The sketch this program replaces: F1EFW's "V4" azimuth and elevation tracker for the Arduino UNO.

Knows the sketch as its author describes it, with its faults. Of the rotor it knows only two coefficients. The sketch
does not know the end stops, that 359 and 1 degrees are neighbours, that a motor coasts, or that a reversal needs a
pause.

F1EFW publishes his sketches with articles on his radio club's site (f6kmf.org, f6kmf.fr). The article on V4 (June 2026)
was read, its program text was not: this is a model made from the description, and where the article is silent it may
differ from the sketch. The article says: the pins; `W` or `w` anywhere in the received text, then azimuth and
elevation; no reply, and any other text ignored; angle = ADC x coefficient; a relay on while target and pot differ by
more than `marge`, 4 degrees; both motors stopped at zero or negative elevation; the two LCD rows.

Assumed:

- Characters are read as they come, and an order counts when it is complete: at the next character, or after a turn of
  the loop without one (a terminal may send no line end). The sketch cannot use `Serial.readString()`: that returns
  after a second of silence, and with orders every second there is no such silence.
- Between the numbers are blanks, tabs or commas. Of two orders received in one turn of the loop, the later one counts.
- Before the first order the target is azimuth 0, elevation 0, as for any C variable without a value. That stops the
  motors, and the LCD shows it.
- Angles are compared with their fractions and shown without.
- The loop's period, below.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from firmware_sim.arduino.liquid_crystal import LcdPins, LiquidCrystal
from firmware_sim.arduino.uno import A0, A1, HIGH, LOW, PinMode, Uno

AZIMUTH_POT = A0
ELEVATION_POT = A1
UP, DOWN, CW, CCW = 3, 4, 5, 6
"""Relay pins; HIGH closes the relay."""
RELAYS = (UP, DOWN, CW, CCW)
LCD = LcdPins(rs=7, enable=8, data=(9, 10, 11, 12))

BAUD = 9600
MARGE_DEG = 4

PAUSE_MS = 100
"""A turn of the loop takes about 107 ms: 6.5 ms for 34 characters and two cursor moves, 0.2 ms for two conversions.

The pause is a guess; most sketches of this kind have 100 ms. There must be one: without it the last digits of a pot
reading would change 150 times a second and be unreadable. Two things depend on it: how far a motor runs past the edge
of the margin (0.6 degrees at 6 degrees a second), and how often pot noise restarts it there. Over twelve satellite
passes with 0.1 degrees of noise, relay starts fall from 300 a pass at 20 ms to 230 at 50, 200 at 100 and 170 at 200 ms,
while the pointing error stays within 0.3 degrees. So 100 ms is rather favourable to the sketch.
"""

ORDER = re.compile(rb"[Ww](\d{1,3})[ \t,]+(-?\d{1,3})(?!\d)")
HEARD_BYTES = 32
"""Longer than any order: older characters cannot be part of the next one."""


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Degrees for each count of the converter, measured on each rotor over its full travel."""

    azimuth_deg: float
    elevation_deg: float


@dataclass(frozen=True, slots=True)
class Direction:
    azimuth_deg: float = 0
    elevation_deg: float = 0

    def row(self, name: str) -> str:
        return f"{name} A:{int(self.azimuth_deg):03d} E:{int(self.elevation_deg):03d}"


class F1efwV4:
    """Call `setup` once, then `loop` again and again; the board's clock moves on inside them."""

    def __init__(self, board: Uno, coefficients: Coefficients) -> None:
        self.target = Direction()
        """The direction of the last order: SAT on the display."""
        self.antenna = Direction()
        """The direction from the pots: ANT on the display."""
        self._board = board
        self._coefficients = coefficients
        self._lcd = LiquidCrystal(board, LCD)
        self._heard = b""

    def setup(self) -> None:
        self._board.serial.begin(BAUD)
        for pin in RELAYS:
            self._board.pin_mode(pin, PinMode.OUTPUT)
            self._board.digital_write(pin, LOW)
        self._lcd.begin()

    def loop(self) -> None:
        self._listen()
        self._look()
        self._steer()
        self._show()
        self._board.delay(PAUSE_MS)

    def _listen(self) -> None:
        port = self._board.serial
        came = bytes(port.read() for _ in range(port.available()))
        self._heard += came
        done = 0
        for order in ORDER.finditer(self._heard):
            if came and order.end() == len(self._heard):
                break  # the elevation's last digit may still be on the line
            self.target = Direction(int(order[1]), int(order[2]))
            done = order.end()
        self._heard = self._heard[done:][-HEARD_BYTES:] if came else b""

    def _look(self) -> None:
        self.antenna = Direction(
            self._board.analog_read(AZIMUTH_POT) * self._coefficients.azimuth_deg,
            self._board.analog_read(ELEVATION_POT) * self._coefficients.elevation_deg,
        )

    def _steer(self) -> None:
        if self.target.elevation_deg <= 0:
            for pin in RELAYS:
                self._board.digital_write(pin, LOW)
            return
        self._close_in(self.target.azimuth_deg - self.antenna.azimuth_deg, CW, CCW)
        self._close_in(self.target.elevation_deg - self.antenna.elevation_deg, UP, DOWN)

    def _close_in(self, missing_deg: float, plus: int, minus: int) -> None:
        """One axis. A reversal swaps the relays within microseconds: there is no dead time."""
        if missing_deg > MARGE_DEG:
            self._board.digital_write(minus, LOW)
            self._board.digital_write(plus, HIGH)
        elif missing_deg < -MARGE_DEG:
            self._board.digital_write(plus, LOW)
            self._board.digital_write(minus, HIGH)
        else:
            self._board.digital_write(plus, LOW)
            self._board.digital_write(minus, LOW)

    def _show(self) -> None:
        for row, text in enumerate((self.target.row("SAT"), self.antenna.row("ANT"))):
            self._lcd.set_cursor(0, row)
            self._lcd.print(text)
