"""The tables [relays] and [lcd]: the pins of the motor relays, and the display on pins or on I2C.

Knows their keys and defaults. Knows no driver.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from hw.ports import Axis
from rotator.config.chips import I2CChip
from rotator.config.table import Gpio, I2CAddress, I2CBus, Table


class Relays(Table):
    """GPIO numbers (BCM). The default pins have pull-downs at boot, and belong to no bus."""

    chip: str | None = None
    """A path such as /dev/gpiochip0; left out, the box finds the header's chip."""
    azimuth_cw: Gpio = 22
    azimuth_ccw: Gpio = 23
    elevation_up: Gpio = 24
    elevation_down: Gpio = 25
    """The relay that turns this way."""
    master: Gpio | None = None
    """An output that switches the motors' supply."""
    heartbeat: Gpio | None = None
    """An output that toggles while the control loop is well, for a one-shot on the motors' supply."""
    active: Literal["high", "low"] = "high"
    """The level that closes a relay and the master."""
    dead_time_s: float = Field(0.5, ge=0.05, le=5)
    """The pause of a motor before it reverses."""
    one_at_a_time: bool = False
    """One motor at a time, for a small transformer."""

    def turning(self, axis: Axis) -> tuple[int, int]:
        """The GPIOs of the two relays of an axis: clockwise or up, then the other way."""
        if axis is Axis.AZIMUTH:
            return self.azimuth_cw, self.azimuth_ccw
        return self.elevation_up, self.elevation_down

    @property
    def contacts(self) -> dict[str, int]:
        """The GPIO of each line that closes a contact, by its key."""
        return self.given("azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down", "master")

    @property
    def outputs(self) -> dict[str, int]:
        """The contacts' lines, and the heartbeat's."""
        return self.contacts | self.given("heartbeat")


class Lcd(Table):
    kind: Literal["none", "gpio", "pcf8574"] = "gpio"
    """None, on six GPIO lines, or on an I2C backpack (PCF8574)."""
    bus: I2CBus = 1
    """Backpack: its bus."""
    address: I2CAddress = 0x27
    """Backpack: usually 0x27 or 0x3f."""
    backpack: Literal["ywrobot", "lcm1602", "mjkdz", "lcdxio", "swapped"] = "ywrobot"
    """Backpack: its wiring; nearly every board sold is `ywrobot`."""
    rs: Gpio = 17
    e: Gpio = 27
    d4: Gpio = 5
    d5: Gpio = 6
    d6: Gpio = 12
    d7: Gpio = 13
    """Six lines: the display's pins."""

    @property
    def lines(self) -> dict[str, int]:
        """The GPIO of each of the six pins, for a display on GPIO lines; empty for the other kinds."""
        return self.given("rs", "e", "d4", "d5", "d6", "d7") if self.kind == "gpio" else {}

    def chips(self) -> list[I2CChip]:
        """The chip of the backpack; empty for a display without one."""
        return [I2CChip(self.bus, self.address, "lcd.address", "PCF8574")] if self.kind == "pcf8574" else []
