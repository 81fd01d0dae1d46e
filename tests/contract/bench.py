"""The bench on which the contract is checked: pins, a bus, a converter and a display, to be set, broken and read.

Knows what a test may ask of a bench. There are three: simulated chips, the kernel's own drivers, and a Raspberry Pi.
Where a bench cannot do something, the test is skipped with the reason.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from hw.buses.i2c import SmbusI2C

RELAYS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25}
LCD_PINS = {"rs": 17, "e": 27, "d4": 5, "d5": 6, "d6": 12, "d7": 13}
ADC_ADDRESS, LCD_ADDRESS, EMPTY_ADDRESS = 0x48, 0x27, 0x35


@dataclass(frozen=True, slots=True)
class Edge:
    """A pin whose physical level changed, on the clock of time.monotonic()."""

    at_s: float
    offset: int
    level: bool


class Bench(Protocol):
    @property
    def api(self) -> Any:
        """The gpiod package, or of its shape."""

    @property
    def chip(self) -> str:
        """The path of the chip with the pin header."""

    @property
    def relays(self) -> Mapping[str, int]:
        """The pins of the four motor relays, by name."""

    @property
    def lcd_pins(self) -> Mapping[str, int]:
        """The pins of a display on six lines, by name."""

    @property
    def bus(self) -> SmbusI2C: ...

    @property
    def adc_address(self) -> int: ...

    @property
    def lcd_address(self) -> int: ...

    @property
    def backpack(self) -> str:
        """Which board is behind the display at that address."""

    # --- GPIO

    def paths(self) -> list[str]:
        """Every chip there is."""

    def crowd(self, labels: Sequence[str]) -> tuple[Any, list[str]]:
        """Chips with these labels, in this order and no others: their `api` and paths."""

    def level(self, offset: int) -> bool:
        """The physical level of a pin of the header."""

    def edges(self) -> list[Edge]:
        """The changes of the relays' pins since the last call, in order."""

    # --- I2C

    def set_volts(self, channel: int, volts: float) -> None:
        """Put a voltage on an input of the converter."""

    def unplug(self, address: int) -> None:
        """The chip at that address no longer answers."""

    def replug(self, address: int) -> None: ...

    def hang(self) -> None:
        """The bus stands still in the middle of a transfer, until `release`."""

    def release(self) -> None: ...

    # --- the display

    def read_glass(self, port: str, expected: Sequence[str]) -> tuple[str, ...]:
        """The text on the display that is connected to `port` (`backpack` or `lines`)."""

    def close(self) -> None:
        """Take everything away again."""
