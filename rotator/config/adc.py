"""The table [adc]: the converter that reads the pots, an ADS1115 on I2C or an MCP3208 on SPI.

Knows its keys and defaults, and how many inputs each converter has. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from hw.ports import Axis
from rotator.config.chips import I2CChip, SpiUse
from rotator.config.table import Gpio, I2CAddress, I2CBus, Table

Input = Annotated[int, Field(ge=0, le=7)]
INPUTS = {"ads1115": 4, "mcp3208": 8}


class Adc(Table):
    kind: Literal["ads1115", "mcp3208"] = "ads1115"
    """An ADS1115 (16 bits, 4 inputs, I2C) or an MCP3208 (12 bits, 8 inputs, SPI)."""
    bus: I2CBus = 1
    """ADS1115: its bus."""
    address: I2CAddress = 0x48
    """ADS1115: 0x48 with its ADDR pin at GND, 0x49 at its supply, 0x4a at SDA, 0x4b at SCL."""
    spi: Literal["lines", "kernel"] = "lines"
    """MCP3208: any GPIO lines, or the Pi's SPI controller (dtparam=spi=on, Python package spidev)."""
    select: Gpio = 8
    """MCP3208: its CS; with the Pi's controller GPIO 8 is CE0, 7 is CE1."""
    sck: Gpio = 11
    si: Gpio = 10
    so: Gpio = 9
    """MCP3208: its CLK, DIN, DOUT."""
    azimuth_channel: Input = 0
    """The input with the azimuth wiper: 0 for A0 or CH0."""
    elevation_channel: Input = 1
    """The input with the elevation wiper."""
    reference_channel: Input | None = None
    """ADS1115: the input with the pots' supply, whose voltage then does not matter."""
    supply_v: float = Field(3.3, gt=0.5, le=5.5)
    """The pots' supply where no input measures it. Wire the MCP3208's VREF to it."""
    rate_sps: Literal[128, 250, 475, 860] = 860
    """ADS1115: conversions a second. Fewer give less noise; each cycle waits for two."""

    def channel(self, axis: Axis) -> int:
        """The input with the wiper of this axis."""
        return self.azimuth_channel if axis is Axis.AZIMUTH else self.elevation_channel

    def input_name(self, channel: int) -> str:
        """The name of an input on the converter: `A0`, `CH0`."""
        return f"{'A' if self.kind == 'ads1115' else 'CH'}{channel}"

    @property
    def suspicion(self) -> str:
        """Likely causes of a converter without readings, as a text for the user."""
        if self.kind == "ads1115":
            return "A sick chip, or not an ADS1115 at adc.address."
        return "Its VDD and VREF on 3.3 V; CLK, DIN, DOUT and CS on adc.sck, si, so and select; an MCP3208?"

    def faults_in_use(self) -> Iterator[str]:
        """Contradictions between the keys of the table, which matter only where a pot is in use."""
        channels = self.given("azimuth_channel", "elevation_channel", "reference_channel")
        last = INPUTS[self.kind] - 1
        for key, channel in channels.items():
            if channel > last:
                yield f"adc.{key} = {channel}: an {self.kind.upper()} has the inputs 0 to {last}"
        if len(set(channels.values())) < len(channels):
            yield "adc: azimuth_channel, elevation_channel and reference_channel must differ"
        if self.kind == "mcp3208" and self.reference_channel is not None:
            yield "adc.reference_channel: an MCP3208 measures against its VREF; wire that to the pots' supply"

    def chips(self) -> list[I2CChip]:
        """The converter, where it is on an I2C bus."""
        return [I2CChip(self.bus, self.address, "adc.address", "ADS1115")] if self.kind == "ads1115" else []

    def spi_uses(self) -> list[SpiUse]:
        """The converter, where it is on SPI."""
        if self.kind != "mcp3208":
            return []
        wires = self.given("sck", "si", "so")
        return [SpiUse("adc", "converter", self.given("select"), wires, kernel=self.spi == "kernel")]
