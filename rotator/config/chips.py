"""The chips in use on I2C and SPI: buses, addresses and lines, the addresses that each part can have, and one that it
cannot have.

Knows the two select lines of the Pi's own SPI controller, and that its chips share clock and data lines. Knows no
register, and not which chips a configuration uses: its tables say that.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rotator.config.table import twice

ADDRESSES: dict[str, tuple[int, ...]] = {
    "ADS1115": tuple(range(0x48, 0x4C)),
    "PCA9685": tuple(range(0x40, 0x48)),
    "PCF8574": (*range(0x20, 0x28), *range(0x38, 0x40)),
    "AS5600": (0x36, 0x40),
    "AS5048B": tuple(range(0x40, 0x44)),
    "MT6701": (0x06, 0x46),
    "MPU6050": (0x68, 0x69),
    "ADXL345": (0x53, 0x1D),
    "LSM303-ACCEL": (0x19,),
    "LSM303-MAG": (0x1E,),
    "HMC5883L": (0x1E,),
    "QMC5883L": (0x0D,),
    "BNO055": (0x28, 0x29),
    "MCP4725": tuple(range(0x60, 0x68)),
}
"""The usual addresses of each part, from its data sheet, the most usual one first. 0x38 to 0x3F are a PCF8574A's."""
_MORE = {"PCA9685": range(0x40, 0x78), "AS5600": range(0x08, 0x78)}
"""Six pins set a PCA9685's address, and an AS5600L's is programmed."""


@dataclass(frozen=True, slots=True)
class I2CChip:
    bus: int
    """The N of /dev/i2c-N."""
    address: int
    key: str
    """The key of the file that names the address: `adc.address`."""
    part: str
    """The name of the part, as in `ADDRESSES`."""

    def fault(self) -> str | None:
        """What is wrong with an address that the part cannot have; 48 for 0x48 is the usual slip."""
        usual = ADDRESSES.get(self.part, ())
        meant = int(str(self.address), 16)
        if not usual or self.address in usual or (meant not in usual and self.address in _MORE.get(self.part, ())):
            return None
        right = f"write 0x{meant:02x}" if meant in usual else f"write one of {_listed(usual)}"
        return f"{self.key} = {self.address} is 0x{self.address:02x}, and no {self.part} has that: {right}"


def _listed(addresses: tuple[int, ...]) -> str:
    """Addresses in rising order, neighbours as a range."""
    ends = [at for at in addresses if at - 1 not in addresses or at + 1 not in addresses]
    text = ", ".join(f"0x{at:02x}" for at in ends)
    return text if len(ends) == len(addresses) else re.sub(r"(0x..), (0x..)", r"\1 to \2", text)


KERNEL_SELECTS = {8: 0, 7: 1}
"""The select lines of /dev/spidev0.0 and /dev/spidev0.1, by GPIO: CE0 and CE1."""
KERNEL_WIRES = {"sck": 11, "si": 10, "so": 9}
"""The lines of the Pi's own SPI, which its chips share."""


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
    mode: int = 0
    speed_hz: int = 100_000
    """Of the clock, on the Pi's own controller: slow, for long wires, unless the chips say otherwise."""

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


def pins_twice(used: Iterable[tuple[int, str]]) -> list[str]:
    """`used`: each GPIO, with the key that names it."""
    return [f"GPIO {pin} is used by {' and '.join(keys)}" for pin, keys in twice(used).items()]


def chips_twice(used: Iterable[I2CChip]) -> list[str]:
    at = twice(((chip.bus, chip.address), chip.key) for chip in used)
    return [
        f"{' and '.join(sorted(keys, reverse=True))} are both 0x{address:02x} on bus {bus}"
        for (bus, address), keys in at.items()
    ]
