"""The SPI chips of a table of the file, with their GPIO lines.

Knows the two select lines of the Pi's own SPI controller, and that its chips share clock and data lines. Knows no chip.
"""

from __future__ import annotations

from dataclasses import dataclass

KERNEL_SELECTS = {8: 0, 7: 1}
"""The select lines of /dev/spidev0.0 and /dev/spidev0.1, by GPIO: CE0 and CE1."""


@dataclass(frozen=True, slots=True)
class SpiUse:
    """The chips of one table of the file. Each line is its GPIO by the key within that table."""

    table: str
    """Such as `digipot`."""
    chips: str
    """The name of the chips for the user: `digital pots`."""
    selects: dict[str, int]
    """The select lines: `azimuth.select`."""
    wires: dict[str, int]
    """Clock and data: `sck`, `si`, and `so` where a chip answers."""
    kernel: bool
    """True: the Pi's own SPI controller, through spidev. False: the program switches the lines bit by bit."""

    @property
    def lines(self) -> list[tuple[int, str]]:
        """Every GPIO, with the full key that names it."""
        return [(pin, f"{self.table}.{key}") for key, pin in (self.selects | self.wires).items()]


def spi_lines(uses: list[SpiUse]) -> list[tuple[int, str]]:
    """The lines of all uses, each with its key. Lines that chips share on the kernel's SPI are listed once."""
    lines: list[tuple[int, str]] = []
    shared: set[int] = set()
    for use in uses:
        lines += [(pin, key) for pin, key in use.lines if pin not in shared]
        shared.update(use.wires.values() if use.kernel else ())
    return lines
