"""The table of the converter that reads the pots.

Knows the words of the file for its inputs and its bus. Knows no driver.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from hw.ports import Axis
from rotator.config.i2c import I2CChip
from rotator.config.spi import SpiUse
from rotator.config.table import Channel, I2CAddress, I2CBus, Table


class Adc(Table):
    bus: I2CBus = 1
    """The N of /dev/i2c-N; the header's bus is 1."""
    address: I2CAddress = 0x48
    """The ADS1115's: 0x48 with its ADDR pin at GND, 0x49 at its supply, 0x4a at SDA, 0x4b at SCL."""
    azimuth_channel: Channel = 0
    """The input (A0 to A3) with the azimuth wiper."""
    elevation_channel: Channel = 1
    """The input with the elevation wiper."""
    reference_channel: Channel | None = None
    """Where the pots' supply is wired to, if it is: readings then no longer depend on it."""
    supply_v: float = Field(3.3, gt=0.5, le=5.5)
    """The pots' supply where it is not measured."""
    rate_sps: Literal[128, 250, 475, 860] = 860
    """Conversions a second: slower is quieter, but every cycle waits for two of them."""

    def channel(self, axis: Axis) -> int:
        """The input with the wiper of this axis."""
        return self.azimuth_channel if axis is Axis.AZIMUTH else self.elevation_channel

    def input_name(self, channel: int) -> str:
        """The name of an input on the converter: `A0`."""
        return f"A{channel}"

    @property
    def suspicion(self) -> str:
        """What may be wrong with a converter that answers and gives no reading, for a person."""
        return "A sick chip, or not an ADS1115 at adc.address."

    def faults(self) -> list[str]:
        """What contradicts itself in the table, where it is in use."""
        if len({self.azimuth_channel, self.elevation_channel, self.reference_channel}) < 3:
            return ["adc: azimuth_channel, elevation_channel and reference_channel must differ"]
        return []

    def chips(self) -> list[I2CChip]:
        """The converter, where it is on an I2C bus."""
        return [I2CChip(self.bus, self.address, "adc.address", "ADS1115")]

    def spi_uses(self) -> list[SpiUse]:
        """The converter, where it is on SPI."""
        return []
