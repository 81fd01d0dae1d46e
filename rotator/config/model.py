"""The whole configuration: all its tables, the small ones in this file, and the rules across tables.

The bigger tables have files beside this one, the kinds of rotor have theirs in `kinds/`; `conflicts` knows what two
parts must not share. Defaults and bounds are in these tables, except what differs by kind of rotor: `usual` of each
kind. Knows no file on a disk and no hardware.
"""

from __future__ import annotations

from typing import Any

from pydantic import Field, model_validator

from hw.ports import AngleSource, Axis
from rotator.config.adc import Adc
from rotator.config.angle import Angle
from rotator.config.axes import AxisTable, Azimuth, Elevation
from rotator.config.chips import I2CChip, SpiUse, spi_lines
from rotator.config.conflicts import chips_twice, follows_itself, needs_station, pins_twice, places_twice
from rotator.config.devices import Lcd, Relays
from rotator.config.forbidden import Place, forbidden_faults
from rotator.config.kinds.digipot import Digipot, DigipotKind
from rotator.config.kinds.kind import EndStop, Kind
from rotator.config.kinds.moteus import Moteus, MoteusKind
from rotator.config.kinds.relay_pot import RelayPot
from rotator.config.kinds.relay_pulse import Pulses, RelayPulse
from rotator.config.kinds.servo import Servo, ServoKind
from rotator.config.links import Link
from rotator.config.mount import MountTable
from rotator.config.mqtt import MqttTable
from rotator.config.page import PageTable
from rotator.config.panel import LimitsTable, PanelTable
from rotator.config.places import STATE
from rotator.config.rotors import Rotor, with_usual
from rotator.config.sensors import CompassTable
from rotator.config.sim import Sim
from rotator.config.sky import SkyTable
from rotator.config.station import StationTable
from rotator.config.table import FilePath, Table

SWITCH_ROOM_DEG = 2.0
"""How far above the place where homing ends at a limit switch the range may begin."""


class StateTable(Table):
    path: FilePath = STATE
    """The file with what the box remembers: a stop, doubts about relays, learnt motors, knobs, the order of the plan;
    on a Pi `/var/lib/rotator/state.json`."""


class MonitorTable(Table):
    path: FilePath | None = None
    """The socket for `rotator monitor`; left out, in systemd's runtime directory, else beside the state file."""


class Control(Table):
    rate_hz: float = Field(20.0, ge=20, le=100)
    """How often the box reads its sensors and decides; orders act at once."""


class Config(Table):
    rotor: Rotor = Rotor()
    """The kind of rotor, real or simulated."""
    azimuth: Azimuth = Azimuth()
    """The azimuth axis, in degrees on the rotor's own scale."""
    elevation: Elevation = Elevation()
    """The elevation axis."""
    station: StationTable = StationTable()
    """Where the antenna stands: for the sky, telescope programs and PstRotator's `LLH`."""
    sky: SkyTable = SkyTable()
    """What is known of the sky."""
    mount: MountTable = MountTable()
    """How the two axes carry the antenna."""
    control: Control = Control()
    """The control loop."""
    state: StateTable = StateTable()
    """What the box remembers from one run to the next."""
    monitor: MonitorTable = MonitorTable()
    """The monitor of the bytes on the links."""
    mqtt: MqttTable = MqttTable()
    """A broker of messages, for Home Assistant and the like; needs the extra `mqtt`."""
    page: PageTable = PageTable()
    """The page for a browser, and its API. Moving the antenna there needs pairing: `rotator pair`."""
    pulses: Pulses = Pulses()
    """Rotor type relay-pulse: contacts that are counted, as on the Alliance U-100."""
    moteus: Moteus = Moteus()
    """Rotor type moteus: two controllers on CAN-FD."""
    servo: Servo = Servo()
    """Rotor type servo: two hobby servos on a PCA9685."""
    digipot: Digipot = Digipot()
    """Rotor type digipot: an MCP41010 for each control box's knob."""
    compass: CompassTable = CompassTable()
    """The compass that finds north."""
    relays: Relays = Relays()
    """The motor relays. Numbers are GPIO (BCM), not pins of the header."""
    adc: Adc = Adc()
    """The converter that reads the pots."""
    panel: PanelTable = PanelTable()
    """A front panel. A part without a key is not fitted."""
    limits: LimitsTable = LimitsTable()
    """Limit switches: normally closed, to ground, so that a broken wire acts as a reached limit."""
    lcd: Lcd = Lcd()
    """The 16×2 display."""
    sim: Sim = Sim()
    """The simulated rotor. Real hardware ignores it."""
    link: list[Link] = Field(default_factory=list)
    """A link to a program. Each has exactly one place: `pty`, `serial` or `tcp`; stellarium and pstrotatoraz `tcp`;
    rotctld-follow `connect`; pstrotator, n1mm, macdoppler `udp`; wsjtx `file`."""

    @model_validator(mode="before")
    @classmethod
    def _usual(cls, values: Any) -> Any:
        return with_usual(values) if isinstance(values, dict) else values

    @model_validator(mode="after")
    def _fits_together(self) -> Config:
        faults = [fault for chip in self.chips() if (fault := chip.fault())]
        faults += [*pins_twice(self.pins()), *chips_twice(self.chips())]
        faults += [*places_twice(self.link), *follows_itself(self.link)]
        faults += [] if self.station.is_known else needs_station(self.link)
        faults += self.adc.faults() if self.uses_adc else []
        faults += self.kind.faults({axis: self.axis(axis) for axis in Axis})
        faults += self._compass_faults()
        faults += self._switches_in_the_way()
        faults += self._park_faults()
        faults += forbidden_faults(self.mount.forbidden, {axis: self.axis(axis) for axis in Axis}, self._stands_at())
        if self.azimuth.sensor.kind == "mpu6050":
            faults.append('azimuth.sensor.kind = "mpu6050": gravity tells no azimuth; it is for the elevation')
        if self.mount.tolerance == "axis" and not self.rotor.switched:
            faults.append('mount.tolerance = "axis" is for motors on relays: these go to every angle, however near')
        if faults:
            raise ValueError("\n".join(faults))
        return self

    @property
    def keeps_files(self) -> bool:
        """Whether the rotor outlives the program, so that kept angles stay true: a real or a kept one."""
        return self.rotor.hardware != "sim" or self.sim.world is not None

    @property
    def kind(self) -> Kind:
        """The kind of rotor that the file names, with its tables."""
        match self.rotor.type:
            case "relay-pot":
                return RelayPot(self.relays)
            case "relay-pulse":
                return RelayPulse(self.relays, self.pulses)
            case "moteus":
                return MoteusKind(self.moteus)
            case "servo":
                return ServoKind(self.servo)
            case "digipot":
                return DigipotKind(self.digipot)

    def axis(self, axis: Axis) -> AxisTable:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    def angle(self, axis: Axis) -> Angle:
        """How the angle of this axis is known: by its own sensor table, else as its kind of rotor says."""
        return self.axis(axis).sensor.angle or self.kind.own

    def has_pot(self, axis: Axis) -> bool:
        """Whether a pot on the converter measures the angle of this axis."""
        return self.angle(axis).pot

    def counts(self, axis: Axis) -> bool:
        """Whether the angle of this axis comes from counted pulses."""
        return self.angle(axis).source is AngleSource.COUNTED

    def in_degrees(self, axis: Axis) -> bool:
        """Whether the readings of this axis are degrees on the rotor's own scale, and need no calibration."""
        return self.angle(axis).in_degrees

    def end_stop(self, axis: Axis) -> EndStop | None:
        """The end stop at which homing ends; None for an axis that does not count pulses, and has no homing."""
        return self.kind.end_stop(axis, self.axis(axis).max_deg) if self.counts(axis) else None

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        """The lowest and highest possible limit, on the rotor's own scale; None: the tables set no end."""
        stop = self.end_stop(axis)
        return (stop.home_deg, None) if stop else self.kind.reach_deg(axis)

    @property
    def uses_adc(self) -> bool:
        return any(self.has_pot(axis) for axis in Axis)

    def spi_uses(self) -> list[SpiUse]:
        """The SPI chips in use, by table."""
        return self.kind.spi_uses() + (self.adc.spi_uses() if self.uses_adc else [])

    def pins(self) -> list[tuple[int, str]]:
        """Every GPIO in use, with the key that names it."""
        used = [*spi_lines(self.spi_uses()), *self.kind.pins()]
        used += [(pin, f"panel.{key}") for key, pin in self.panel.switches.items()]
        used += [(pin, f"limits.{key}") for key, pin in self.limits.switches.items()]
        used += [(pin, f"lcd.{key}") for key, pin in self.lcd.lines.items()]
        return used

    def chips(self) -> list[I2CChip]:
        """Every I2C chip in use."""
        used = self.adc.chips() if self.uses_adc else []
        used += [chip for axis in Axis for chip in self.axis(axis).sensor.chips(f"{axis.value}.sensor.address")]
        return used + self.kind.chips() + self.panel.chips() + self.compass.chips() + self.lcd.chips()

    def _compass_faults(self) -> list[str]:
        if not self.compass.at_start:
            return []
        faults = [] if self.compass.kind != "none" else ['compass.at_start needs a compass: kind = "bno055"']
        if not self.kind.confirmable:
            faults.append("compass.at_start is for a rotor that may not know its angle: rotor.type = moteus")
        if self.mount.north == "true" and self.mount.declination_deg is None:
            faults.append("compass.at_start needs mount.declination_deg: a compass shows magnetic north")
        return faults

    def _switches_in_the_way(self) -> list[str]:
        """Homing ends just below a low limit switch: the range must begin above it."""
        stops = {axis: stop for axis in Axis if (stop := self.end_stop(axis))}
        return [
            f"limits.{axis.value}_low opens a little above pulses.{axis.value}.home_deg ({stop.home_deg:g}), where "
            f"homing ends: {axis.value}.min_deg must be {stop.home_deg + SWITCH_ROOM_DEG:g} at least, or home_deg less"
            for axis, stop in stops.items()
            if f"{axis.value}_low" in self.limits.switches and self.axis(axis).min_deg < stop.home_deg + SWITCH_ROOM_DEG
        ]

    @property
    def park_deg(self) -> Place:
        """The park position on the rotor's own scale. What the file leaves out is 0, or next to it."""
        azimuth, elevation, mount = self.azimuth, self.elevation, self.mount
        azimuth_deg, elevation_deg = mount.park_azimuth_deg, mount.park_elevation_deg
        if "park_azimuth_deg" not in mount.model_fields_set:
            norths = (north for north in (0.0, 360.0, -360.0) if azimuth.min_deg <= north <= azimuth.max_deg)
            azimuth_deg = next(norths, min(max(0.0, azimuth.min_deg), azimuth.max_deg))
        if "park_elevation_deg" not in mount.model_fields_set:
            elevation_deg = min(max(0.0, elevation.min_deg), elevation.max_deg)
        return azimuth_deg, elevation_deg

    def _park_faults(self) -> list[str]:
        return [
            f"mount.park_{axis.value}_deg = {angle_deg:g} is outside {axis.value}'s range, "
            f"{self.axis(axis).min_deg:g} to {self.axis(axis).max_deg:g}"
            for axis, angle_deg in zip(Axis, self.park_deg, strict=True)
            if not self.axis(axis).min_deg <= angle_deg <= self.axis(axis).max_deg
        ]

    def _stands_at(self) -> dict[str, Place]:
        """By key: where the antenna has to be able to stand."""
        places = {"the park position": self.park_deg}
        if self.rotor.type == "digipot":
            places["digipot's start_deg"] = (self.digipot.azimuth.start_deg, self.digipot.elevation.start_deg)
        return places
