"""The tables of the kinds of rotor: how each is driven, and what is usual for it.

Knows the file's words for a rotor's own parts. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field, model_validator

from rotator.config.table import Gpio, I2CAddress, I2CBus, Point, Table

Kind = Literal["relay-pot", "relay-pulse", "moteus", "servo", "digipot"]


class Rotor(Table):
    type: Kind = "relay-pot"
    """How the rotor is driven and measured: motors on relays with pots, or with a contact that is counted; two moteus
    controllers; two hobby servos; or a control box with a digital pot for a knob."""
    hardware: Literal["sim", "pi"] = "sim"
    """A simulated rotor, or the relays, chips and display on this Pi."""

    @property
    def switched(self) -> bool:
        """Whether its motors are only on or off, by relays."""
        return self.type in ("relay-pot", "relay-pulse")


class PulseAxisTable(Table):
    contact: Gpio = 16
    """The input with the cam's contact."""
    spacing_deg: float = Field(5.0, gt=0, le=30)
    """From one closure to the next: 5 on a modified Alliance U-100, else 6 or 10."""
    closed_deg: float = Field(1.0, gt=0, le=30)
    """How much of that the contact is closed."""
    closes_at_deg: float = Field(0.0, ge=-360, le=720)
    """An angle at which the contact closes when turning clockwise or up."""
    coast_s: float = Field(0.5, gt=0, le=5)
    """How long after its relay has opened the motor stands for certain."""
    play_deg: float = Field(0.0, ge=0, le=10)
    """Turning back, the contact changes this much later."""
    home_deg: float = Field(0.0, ge=-360, le=720)
    """The angle of the low end stop, where homing ends."""

    @model_validator(mode="after")
    def _opens(self) -> PulseAxisTable:
        if self.closed_deg >= self.spacing_deg:
            raise ValueError(f"closed_deg ({self.closed_deg:g}) must be below spacing_deg ({self.spacing_deg:g})")
        return self


class PulseElevation(PulseAxisTable):
    contact: Gpio = 20
    """The input with the cam's contact."""


class Pulses(Table):
    active: Literal["low", "high"] = "low"
    """The level of a closed contact; low for an opto-isolator to ground."""
    pull: bool = True
    """The Pi's own resistor holds the line at the open contact's level."""
    debounce_s: float = Field(0.02, ge=0, le=0.3)
    """A change of the contact counts when it has stayed for so long."""
    azimuth: PulseAxisTable = PulseAxisTable()
    """The azimuth axis's cam."""
    elevation: PulseElevation = PulseElevation()
    """The elevation axis's cam."""


class MoteusAxisTable(Table):
    id: int = Field(1, ge=1, le=126)
    """The controller's CAN id."""
    rev_per_turn: float = 1.0
    """Revolutions of the controller's scale for 360° of the antenna; below 0 where it runs the other way."""
    zero_rev: float = 0.0
    """What the controller shows where the rotor's scale says 0°."""
    velocity_limit_dps: float = Field(30.0, gt=0, le=360)
    """Its greatest speed, always sent."""
    accel_limit_dps2: float = Field(20.0, gt=0, le=1000)
    """Its greatest acceleration, always sent."""
    max_torque_nm: float | None = Field(None, gt=0)
    """Its greatest torque; left out, what the controller itself is set to."""
    geared: bool = True
    """Its only encoder sits before a gear: after power-on it does not know where the antenna points, and nothing moves
    until a person confirms it."""

    @model_validator(mode="after")
    def _turns(self) -> MoteusAxisTable:
        if self.rev_per_turn == 0:
            raise ValueError("rev_per_turn must not be 0")
        return self


class MoteusElevation(MoteusAxisTable):
    id: int = Field(2, ge=1, le=126)
    """The controller's CAN id."""


class Moteus(Table):
    port: str = Field("/dev/fdcanusb", min_length=1)
    """The adapter's serial port."""
    can: str | None = Field(None, min_length=1)
    """In place of `port`: a CAN-FD interface of the kernel, can0 say."""
    azimuth: MoteusAxisTable = MoteusAxisTable()
    """The azimuth controller."""
    elevation: MoteusElevation = MoteusElevation()
    """The elevation controller."""

    @model_validator(mode="after")
    def _differ(self) -> Moteus:
        if self.azimuth.id == self.elevation.id:
            raise ValueError(f"azimuth and elevation both have id {self.azimuth.id}: give one another with tview")
        return self


class ServoAxisTable(Table):
    channel: int = Field(0, ge=0, le=15)
    """The board's output."""
    pulses_us: list[Point] = Field(default=[(0.0, 500.0), (180.0, 2500.0)], min_length=2)
    """Points [degrees, pulse width in microseconds]; beyond its ends the servo is never sent."""
    start_deg: float = Field(0.0, ge=-360, le=720)
    """Where the first pulse sends it, at the servo's own speed: put it where the antenna was left."""
    slew_dps: float = Field(60.0, gt=0, le=720)
    """How fast the ordered angle moves; no more than the servo can."""


class ServoElevation(ServoAxisTable):
    channel: int = Field(1, ge=0, le=15)
    """The board's output."""


class Servo(Table):
    bus: I2CBus = 1
    """The N of /dev/i2c-N; the header's bus is 1."""
    address: I2CAddress = 0x40
    """The PCA9685's."""
    osc_hz: float = Field(25e6, ge=20e6, le=30e6)
    """What its oscillator really does; on many boards 26 to 27 million. It scales every pulse."""
    enable: Gpio | None = None
    """The line at the board's OE input, with a pull-up beside it: no pulse before the program makes one."""
    idle_off_s: float = Field(0.0, ge=0, le=86_400)
    """A servo that has not moved for so long gets no more pulses, and is limp. 0: it holds for good."""
    azimuth: ServoAxisTable = ServoAxisTable()
    """The azimuth servo."""
    elevation: ServoElevation = ServoElevation()
    """The elevation servo."""


class DigipotAxisTable(Table):
    select: Gpio = 8
    """The chip's select line; with the kernel's SPI, GPIO 8 is CE0 and 7 is CE1."""
    steps: list[Point] = Field(default=[(0.0, 0.0), (360.0, 256.0)], min_length=2)
    """Points [degrees, the chip's step there, 0 to 256]."""
    start_deg: float = Field(0.0, ge=-360, le=720)
    """Where the rotor is taken to stand when the program starts, where no pot tells."""
    dead_band_deg: float = Field(2.0, ge=0, le=20)
    """How far off the box lets it be before it turns the motor."""


class DigipotElevation(DigipotAxisTable):
    select: Gpio = 7
    """The chip's select line; with the kernel's SPI, GPIO 8 is CE0 and 7 is CE1."""
    steps: list[Point] = Field(default=[(0.0, 0.0), (90.0, 64.0)], min_length=2)
    """Points [degrees, the chip's step there, 0 to 256]."""


class Digipot(Table):
    spi: Literal["lines", "kernel"] = "lines"
    """Any GPIO lines, or the Pi's SPI controller (dtparam=spi=on, and the Python package spidev)."""
    sck: Gpio = 11
    """The clock."""
    si: Gpio = 10
    """The data."""
    enable: Gpio | None = None
    """The relay that feeds the boxes: without it they turn to the middle at power-on, where the chips start."""
    azimuth: DigipotAxisTable = DigipotAxisTable()
    """The azimuth box."""
    elevation: DigipotElevation = DigipotElevation()
    """The elevation box."""


_SLOW = {"speed_dps": 6.0}
USUAL: Mapping[Kind, Mapping[str, Mapping[str, Any]]] = {
    "relay-pot": {},
    "relay-pulse": {
        "azimuth": {"coast_s": 0.1},
        "elevation": {**_SLOW, "coast_s": 0.1},
        "sim.azimuth": {"lag_s": 0.1},
        "sim.elevation": {**_SLOW, "lag_s": 0.1},
    },
    "moteus": {axis: {"speed_dps": 30.0} for axis in ("azimuth", "elevation", "sim.azimuth", "sim.elevation")},
    "servo": {
        "azimuth": {"max_deg": 180.0, "speed_dps": 60.0},
        "elevation": {"speed_dps": 60.0},
        "sim.azimuth": {"speed_dps": 60.0},
        "sim.elevation": {"speed_dps": 60.0},
    },
    "digipot": {
        "azimuth": {"max_deg": 360.0},
        "elevation": {"max_deg": 90.0, **_SLOW},
        "sim.elevation": _SLOW,
    },
}
"""What each kind has in place of a relay rotor's defaults, where the file does not say. On real hardware the limits
are not taken from here: a person has to give them."""


def with_usual(values: dict[str, Any]) -> dict[str, Any]:
    """The file's values, with what is usual for its kind of rotor beneath them."""
    rotor = values.get("rotor")
    said: dict[str, Any] = rotor if isinstance(rotor, dict) else {}
    usual = next((places for kind, places in USUAL.items() if kind == said.get("type")), {})
    limits = {"min_deg", "max_deg"} if said.get("hardware") == "pi" else set()
    filled = dict(values)
    for place, keys in usual.items():
        parent = filled
        for part in place.split("."):
            inner = parent.get(part, {})
            if not isinstance(inner, dict):
                break
            parent[part] = dict(inner)
            parent = parent[part]
        else:
            for key, value in keys.items():
                if key not in limits:
                    parent.setdefault(key, value)
    return filled
