"""The tables of what is wired to the Pi whatever the rotor: relays, the pots' converter, the display.

Knows the file's words for pins and addresses. Knows no driver.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from rotator.config.table import Channel, Gpio, I2CAddress, I2CBus, Table


class Relays(Table):
    """GPIO numbers as the Pi's kernel counts them (BCM). The defaults have pull-downs at boot and are no bus's pins."""

    chip: str | None = None
    """A path such as /dev/gpiochip0; left out, the chip with the 40-pin header is found by its label."""
    azimuth_cw: Gpio = 22
    """Turns clockwise."""
    azimuth_ccw: Gpio = 23
    """Turns counter-clockwise."""
    elevation_up: Gpio = 24
    """Turns up."""
    elevation_down: Gpio = 25
    """Turns down."""
    master: Gpio | None = None
    """An output that switches the motors' supply."""
    heartbeat: Gpio | None = None
    """An output that changes level after every good step, for a one-shot that gates the motors' supply."""
    active: Literal["high", "low"] = "high"
    """The level that closes a relay, for all of them, the master too."""
    dead_time_s: float = Field(0.5, ge=0.05, le=5)
    """How long a motor rests before it is reversed."""
    one_at_a_time: bool = False
    """Never run both motors at once, for a small transformer: the second waits for the first."""

    @property
    def contacts(self) -> dict[str, int]:
        """The GPIO of each line that closes a contact, by its key."""
        keys = ("azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down", "master")
        return {key: pin for key in keys if (pin := getattr(self, key)) is not None}

    @property
    def outputs(self) -> dict[str, int]:
        """The contacts' lines, and the heartbeat's."""
        return self.contacts | ({} if self.heartbeat is None else {"heartbeat": self.heartbeat})


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


class Lcd(Table):
    kind: Literal["none", "gpio", "pcf8574"] = "gpio"
    """No display, one on six GPIO lines, or one behind an I2C backpack."""
    bus: I2CBus = 1
    """Backpack: the N of /dev/i2c-N."""
    address: I2CAddress = 0x27
    """Backpack: usually 0x27 or 0x3f."""
    backpack: Literal["ywrobot", "lcm1602", "mjkdz", "lcdxio", "swapped"] = "ywrobot"
    """Backpack: which of its bits goes to which pin; `ywrobot` is nearly every board sold."""
    rs: Gpio = 17
    """Six lines: RS."""
    e: Gpio = 27
    """Six lines: E."""
    d4: Gpio = 5
    """Six lines: D4."""
    d5: Gpio = 6
    """Six lines: D5."""
    d6: Gpio = 12
    """Six lines: D6."""
    d7: Gpio = 13
    """Six lines: D7."""
