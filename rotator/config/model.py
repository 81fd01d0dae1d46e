"""What the configuration file may say: every key, its default, its bounds. The only place where defaults live.

Knows the file's words. Knows no file, no hardware and nothing of what the program makes of the values.
"""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

ProtocolName = Literal["gs232a", "gs232b", "gs232-f1efw", "rotctld"]

Gpio = Annotated[int, Field(ge=0, le=57)]
I2CAddress = Annotated[int, Field(ge=0x08, le=0x77)]
Channel = Annotated[int, Field(ge=0, le=3)]


class Table(BaseModel):
    """A table of the file: no key but those named, nothing changed after loading."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Rotor(Table):
    type: Literal["relay-pot"] = "relay-pot"
    hardware: Literal["sim", "pi"] = "sim"


class AxisTable(Table):
    min_deg: float = Field(0.0, ge=-360, le=720)
    max_deg: float = Field(450.0, ge=-360, le=720)
    tolerance_deg: float = Field(4.0, gt=0, le=45)
    """How far off on the sky the antenna may be before a motor starts."""
    coast_s: float = Field(0.17, ge=0, le=5)
    """How long the motor goes on after it is switched off, as time at full speed."""
    calibration: list[tuple[float, float]] | None = None
    """Points [reading, degrees]; the reading is the wiper's share of the pot's supply, 0 to 1."""
    lowest_reading: float = Field(0.02, ge=-0.1, le=1)
    highest_reading: float = Field(0.98, ge=0, le=1.1)
    """Readings outside mean a broken or shorted pot; end resistors keep every valid angle inside."""
    direction_checked: bool = False
    """A person has seen that CW turns clockwise and UP up."""

    @model_validator(mode="after")
    def _make_sense(self) -> AxisTable:
        if self.min_deg >= self.max_deg:
            raise ValueError(f"min_deg ({self.min_deg:g}) must be below max_deg ({self.max_deg:g})")
        if self.lowest_reading >= self.highest_reading:
            raise ValueError("lowest_reading must be below highest_reading")
        points = self.calibration
        if points is not None:
            if len(points) < 2:
                raise ValueError("calibration needs two points or more, each [reading, degrees]")
            if any(b[1] <= a[1] for a, b in pairwise(points)):
                raise ValueError("calibration: degrees must rise from point to point")
            rises = [b[0] > a[0] for a, b in pairwise(points)]
            if any(b[0] == a[0] for a, b in pairwise(points)) or len(set(rises)) != 1:
                raise ValueError("calibration: readings must rise, or fall, all the way")
        return self


class Azimuth(AxisTable):
    pass


class Elevation(AxisTable):
    min_deg: float = Field(0.0, ge=-90, le=180)
    max_deg: float = Field(180.0, ge=0, le=210)


class MountTable(Table):
    flip: Literal["off"] = "off"
    park_azimuth_deg: float = Field(0.0, ge=0, le=450)
    park_elevation_deg: float = Field(0.0, ge=0, le=180)


class Control(Table):
    rate_hz: float = Field(20.0, ge=20, le=100)


class Relays(Table):
    """GPIO numbers as the Pi's kernel counts them (BCM). The defaults have pull-downs at boot and are no bus's pins."""

    chip: str | None = None
    """A path such as /dev/gpiochip0; left out, the chip with the 40-pin header is found by its label."""
    azimuth_cw: Gpio = 22
    azimuth_ccw: Gpio = 23
    elevation_up: Gpio = 24
    elevation_down: Gpio = 25
    master: Gpio | None = None
    """An output that switches the motors' supply."""
    active: Literal["high", "low"] = "high"
    dead_time_s: float = Field(0.5, ge=0.05, le=5)
    """How long a motor rests before it is reversed."""


class Adc(Table):
    bus: int = Field(1, ge=0, le=255)
    address: I2CAddress = 0x48
    azimuth_channel: Channel = 0
    elevation_channel: Channel = 1
    reference_channel: Channel | None = None
    """Where the pots' supply is wired to, if it is: readings then no longer depend on it."""
    supply_v: float = Field(3.3, gt=0.5, le=5.5)
    """The pots' supply where it is not measured."""
    rate_sps: Literal[128, 250, 475, 860] = 860


class Lcd(Table):
    kind: Literal["none", "gpio", "pcf8574"] = "pcf8574"
    bus: int = Field(1, ge=0, le=255)
    address: I2CAddress = 0x27
    backpack: Literal["ywrobot", "lcm1602", "mjkdz", "lcdxio", "swapped"] = "ywrobot"
    rs: Gpio = 17
    e: Gpio = 27
    d4: Gpio = 5
    d5: Gpio = 6
    d6: Gpio = 12
    d7: Gpio = 13


class SimAxisTable(Table):
    speed_dps: float = Field(6.0, gt=0, le=360)
    lag_s: float = Field(0.15, ge=0, le=5)
    relay_delay_s: float = Field(0.015, ge=0, le=1)
    backlash_deg: float = Field(0.5, ge=0, le=30)
    pot_noise_deg: float = Field(0.1, ge=0, le=30)
    pot_bow_deg: float = Field(0.0, ge=-30, le=30)
    start_deg: float | None = None
    """Where the rotor stands at first; left out, at 0 (in a rehearsal, where the pass begins)."""


class SimElevation(SimAxisTable):
    speed_dps: float = Field(2.7, gt=0, le=360)


class Sim(Table):
    azimuth: SimAxisTable = SimAxisTable()
    elevation: SimElevation = SimElevation()
    bus_takes_time: bool = True
    """The simulated I2C bus is as slow as a real one."""


class Link(Table):
    protocol: ProtocolName
    name: str | None = Field(None, min_length=1, max_length=24)
    pty: str | None = Field(None, min_length=1)
    serial: str | None = Field(None, min_length=1)
    tcp: str | None = None
    baud: int = Field(9600, ge=50, le=4_000_000)
    ack: Literal["none", "cr"] = "none"
    """GS-232: what follows a command that asks nothing; old Hamlib (3.x) wants the CR."""
    may_calibrate: bool = False
    """GS-232: O, F, O2 and F2 take the present reading for an end of the range."""

    @model_validator(mode="after")
    def _one_place(self) -> Link:
        places = [place for place in (self.pty, self.serial, self.tcp) if place is not None]
        if len(places) != 1:
            raise ValueError("must have exactly one of pty, serial, tcp")
        if self.tcp is not None:
            address(self.tcp)
        return self

    @property
    def where(self) -> str:
        return self.pty or self.serial or self.tcp or ""


def address(text: str) -> tuple[str, int]:
    """`host:port` taken apart; an IPv6 host stands in brackets. Raises ValueError."""
    parts = re.fullmatch(r"(?:\[([0-9a-fA-F:.%\w]+)\]|([^:\[\]\s]+)):(\d{1,5})", text)
    if not parts or not 0 < int(parts[3]) < 65536:
        raise ValueError(f'tcp must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533", not "{text}"')
    return parts[1] or parts[2], int(parts[3])


class Config(Table):
    rotor: Rotor = Rotor()
    azimuth: Azimuth = Azimuth()
    elevation: Elevation = Elevation()
    mount: MountTable = MountTable()
    control: Control = Control()
    relays: Relays = Relays()
    adc: Adc = Adc()
    lcd: Lcd = Lcd()
    sim: Sim = Sim()
    link: list[Link] = Field(default_factory=list)

    @model_validator(mode="after")
    def _nothing_twice(self) -> Config:
        twice = [*self._pins_twice(), *self._places_twice()]
        if len({self.adc.azimuth_channel, self.adc.elevation_channel, self.adc.reference_channel}) < 3:
            twice.append("adc: azimuth_channel, elevation_channel and reference_channel must differ")
        if self.lcd.kind == "pcf8574" and (self.lcd.bus, self.lcd.address) == (self.adc.bus, self.adc.address):
            twice.append(f"lcd.address and adc.address are both 0x{self.adc.address:02x} on bus {self.adc.bus}")
        if twice:
            raise ValueError("; ".join(twice))
        return self

    def _pins_twice(self) -> list[str]:
        users: dict[int, list[str]] = {}
        for key in ("azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down", "master"):
            users.setdefault(getattr(self.relays, key), []).append(f"relays.{key}")
        if self.lcd.kind == "gpio":
            for key in ("rs", "e", "d4", "d5", "d6", "d7"):
                users.setdefault(getattr(self.lcd, key), []).append(f"lcd.{key}")
        return [f"GPIO {pin} is used by {' and '.join(keys)}" for pin, keys in users.items() if len(keys) > 1]

    def _places_twice(self) -> list[str]:
        users: dict[str, int] = {}
        for link in self.link:
            users[link.where] = users.get(link.where, 0) + 1
        return [f"{count} links use {where}" for where, count in users.items() if count > 1]
