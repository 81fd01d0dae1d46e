"""What the configuration file may say: every key, its default, its bounds. The only place where defaults live.

Knows the file's words. Knows no file, no hardware and nothing of what the program makes of the values.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, field_validator, model_validator

from rotator.config.links import Link, is_same_place
from rotator.config.table import Table

Gpio = Annotated[int, Field(ge=0, le=57)]
I2CAddress = Annotated[int, Field(ge=0x08, le=0x77)]
Channel = Annotated[int, Field(ge=0, le=3)]


class Rotor(Table):
    type: Literal["relay-pot"] = "relay-pot"
    """How the rotor is driven and measured: motors on relays, pots for the angles."""
    hardware: Literal["sim", "pi"] = "sim"
    """A simulated rotor, or the relays, pots and display on this Pi."""


class AxisTable(Table):
    min_deg: float = Field(0.0, ge=-360, le=720)
    """The lowest angle it may be sent to, on the rotor's own scale."""
    max_deg: float = Field(450.0, ge=-360, le=720)
    """The highest angle it may be sent to; above 360 on azimuth: overlap."""
    tolerance_deg: float = Field(4.0, gt=0, le=45)
    """How far off on the sky the antenna may be before a motor starts."""
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's speed, roughly: the box measures it as it goes."""
    coast_s: float = Field(0.17, ge=0, le=5)
    """How long the motor goes on after it is switched off, as time at full speed."""
    calibration: list[Annotated[tuple[float, float], Field(strict=False)]] | None = None
    """Points [reading, degrees]; the reading is the wiper's share of the pot's supply, 0 to 1."""
    lowest_reading: float = Field(0.02, ge=-0.1, le=1)
    """A reading below this means a broken wire or a shorted pot."""
    highest_reading: float = Field(0.98, ge=0, le=1.1)
    """A reading above this means the same; end resistors keep every valid angle between the two."""
    direction_checked: bool = False
    """A person has seen that CW turns clockwise and UP up."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """Added to the rotor's own scale: where the antenna points when the scale says 0."""
    longest_run_s: float = Field(300.0, ge=0, le=86_400)
    """How long the motor may run in one go before it has to rest; running and resting add up. 0: any time."""
    rest_s: float = Field(300.0, gt=0, le=86_400)
    """How long it takes to cool after that; it may run again when half of this has passed."""

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
    """The lowest elevation it may be sent to; where it rests below the horizon."""
    max_deg: float = Field(180.0, ge=0, le=210)
    """The highest elevation it may be sent to; 90 for a rotor that cannot go over the top."""
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's speed, roughly: the box measures it as it goes."""


class MountTable(Table):
    flip: Literal["off", "over-top"] = "off"
    """Whether the box itself may turn the antenna over the top (`over-top`): only where a person has seen that the
    antenna, its cables and the mast clear each other all the way."""
    north: Literal["true", "magnetic"] = "true"
    """Which north the azimuth scale was lined up with; orders and reports are always from true north."""
    declination_deg: float | None = Field(None, ge=-180, le=180)
    """By how much a compass points east of true north at your place (west: minus); `magnetic` needs it."""
    park_azimuth_deg: float = Field(0.0, ge=0, le=450)
    """Where a park order (rotctld K) sends the azimuth, on the rotor's own scale."""
    park_elevation_deg: float = Field(0.0, ge=0, le=180)
    """Where a park order sends the elevation."""
    park_after_s: float = Field(0.0, ge=0, le=86_400)
    """Park when no order has come for so long; 0: never."""
    horizon: list[Annotated[tuple[float, float], Field(strict=False)]] = Field(default_factory=list)
    """Points [azimuth, least elevation] of trees and roofs, azimuth rising from 0 to below 360."""

    @model_validator(mode="after")
    def _knows_north(self) -> MountTable:
        if self.north == "magnetic" and self.declination_deg is None:
            raise ValueError('north = "magnetic" needs declination_deg, how far east of true north a compass points')
        return self

    @field_validator("horizon")
    @classmethod
    def _goes_round(cls, points: list[tuple[float, float]]) -> list[tuple[float, float]]:
        azimuths = [azimuth_deg for azimuth_deg, _ in points]
        if any(not 0 <= azimuth_deg < 360 for azimuth_deg in azimuths) or azimuths != sorted(set(azimuths)):
            raise ValueError("azimuths must rise from point to point, from 0 to below 360")
        if any(not 0 <= elevation_deg <= 90 for _, elevation_deg in points):
            raise ValueError("elevations must be from 0 to 90")
        return points


class StateTable(Table):
    path: str = Field("run/state.json", min_length=1)
    """Where the box keeps what it has learnt of its motors; on a Pi `/var/lib/rotator/state.json` is the place."""


class MonitorTable(Table):
    path: str | None = Field(None, min_length=1)
    """The socket that `rotator monitor` reads; left out, `monitor` in systemd's runtime directory, else beside the
    state file."""


class Control(Table):
    rate_hz: float = Field(20.0, ge=20, le=100)
    """How often the pots are read and the motors decided on; orders never wait for it."""


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
    bus: int = Field(1, ge=0, le=255)
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
    bus: int = Field(1, ge=0, le=255)
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


class SimAxisTable(Table):
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's full speed."""
    lag_s: float = Field(0.15, ge=0, le=5)
    """First-order lag of the motor: it coasts speed × lag."""
    relay_delay_s: float = Field(0.015, ge=0, le=1)
    """From the coil to the contact."""
    backlash_deg: float = Field(0.5, ge=0, le=30)
    """Total play; the pot is on the shaft, the antenna beyond the play."""
    pot_noise_deg: float = Field(0.1, ge=0, le=30)
    """Noise of the pot, rms."""
    pot_bow_deg: float = Field(0.0, ge=-30, le=30)
    """How far the pot is off a straight line in the middle of its travel."""
    start_deg: float | None = None
    """Where the rotor stands at first; left out, at 0 (in a rehearsal, where the pass begins)."""


class SimElevation(SimAxisTable):
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's full speed."""


class Sim(Table):
    azimuth: SimAxisTable = SimAxisTable()
    """The simulated azimuth motor and pot."""
    elevation: SimElevation = SimElevation()
    """The simulated elevation motor and pot."""
    bus_takes_time: bool = True
    """The simulated I2C bus is as slow as a real one."""


class Config(Table):
    rotor: Rotor = Rotor()
    """What turns and how it is reached."""
    azimuth: Azimuth = Azimuth()
    """The azimuth axis, in degrees on the rotor's own scale."""
    elevation: Elevation = Elevation()
    """The elevation axis."""
    mount: MountTable = MountTable()
    """How the two axes carry the antenna."""
    control: Control = Control()
    """The control loop."""
    state: StateTable = StateTable()
    """What the box remembers from one run to the next."""
    monitor: MonitorTable = MonitorTable()
    """Watching what goes over the links."""
    relays: Relays = Relays()
    """The motor relays. Numbers are GPIO (BCM), not pins of the header."""
    adc: Adc = Adc()
    """The ADS1115 that reads the pots."""
    lcd: Lcd = Lcd()
    """The 16×2 display."""
    sim: Sim = Sim()
    """The simulated rotor; without effect on real hardware."""
    link: list[Link] = Field(default_factory=list)
    """A way in for a program: give exactly one of `pty`, `serial`, `tcp` (rotctld-follow: `connect`; pstrotator, n1mm,
    macdoppler: `udp`; wsjtx: `file`). As many as you like."""

    @model_validator(mode="after")
    def _nothing_twice(self) -> Config:
        twice = [*self._pins_twice(), *self._places_twice(), *self._follows_itself()]
        if len({self.adc.azimuth_channel, self.adc.elevation_channel, self.adc.reference_channel}) < 3:
            twice.append("adc: azimuth_channel, elevation_channel and reference_channel must differ")
        if self.lcd.kind == "pcf8574" and (self.lcd.bus, self.lcd.address) == (self.adc.bus, self.adc.address):
            twice.append(f"lcd.address and adc.address are both 0x{self.adc.address:02x} on bus {self.adc.bus}")
        if twice:
            raise ValueError("; ".join(twice))
        return self

    def _pins_twice(self) -> list[str]:
        users: dict[int, list[str]] = {}
        for key, pin in self.relays.outputs.items():
            users.setdefault(pin, []).append(f"relays.{key}")
        if self.lcd.kind == "gpio":
            for key in ("rs", "e", "d4", "d5", "d6", "d7"):
                users.setdefault(getattr(self.lcd, key), []).append(f"lcd.{key}")
        return [f"GPIO {pin} is used by {' and '.join(keys)}" for pin, keys in users.items() if len(keys) > 1]

    def _places_twice(self) -> list[str]:
        users: dict[tuple[str, str | None, str | None], int] = {}
        for link in self.link:
            place = (link.where, link.connect, link.udp)
            users[place] = users.get(place, 0) + 1
        return [f"{count} links use {where}" for (where, *_), count in users.items() if count > 1]

    def _follows_itself(self) -> list[str]:
        return [
            f'link[{number}].connect = "{link.connect}" is the box itself (link[{other}].tcp = "{server.tcp}"): '
            "give one of the two another port"
            for number, link in enumerate(self.link)
            for other, server in enumerate(self.link)
            if link.connect and server.tcp and is_same_place(server.tcp, link.connect)
        ]
