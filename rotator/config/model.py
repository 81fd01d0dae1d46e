"""The whole configuration: all its tables, the small ones in this file, and the rules across tables.

The bigger tables have files beside this one, the kinds of rotor have theirs in `kinds/`. Defaults and bounds are in
these tables, except what differs by kind of rotor: `usual` of each kind. Knows no file on a disk and no hardware.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields
from typing import Any, TypeVar

from pydantic import Field, model_validator

from hw.ports import AngleSource, Axis
from rotator.config.adc import Adc
from rotator.config.axes import AxisTable, Azimuth, BrakeTable, Elevation, SpeedTable
from rotator.config.axis_faults import endless_faults, felt_faults, in_turns
from rotator.config.chips import I2CChip, SpiUse, chips_twice, pins_twice, spi_lines
from rotator.config.devices import Lcd, Relays
from rotator.config.forbidden import Place, forbidden_faults
from rotator.config.kinds import KINDS, Rotor, with_usual
from rotator.config.kinds.controller import Controller
from rotator.config.kinds.digipot import Digipot
from rotator.config.kinds.h_bridge import Bridge
from rotator.config.kinds.kind import EndStop, Kind, OffLine
from rotator.config.kinds.moteus import Moteus
from rotator.config.kinds.relay_pulse import Pulses
from rotator.config.kinds.relay_timed import Timed
from rotator.config.kinds.servo import Servo
from rotator.config.kinds.stepper import Stepper
from rotator.config.links import Link, follows_itself, needs_station, places_twice
from rotator.config.mount import MountTable
from rotator.config.mqtt import MqttTable
from rotator.config.page import NotifyTable, PageTable
from rotator.config.panel import LimitsTable, PanelTable
from rotator.config.places import STATE
from rotator.config.sensors import Angle, CompassTable
from rotator.config.sim import Sim
from rotator.config.sky import SkyTable, StationTable
from rotator.config.table import FilePath, Table

T = TypeVar("T")

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
    rotor: Rotor = Rotor.model_construct()
    """The kind of rotor, real or simulated."""
    azimuth: Azimuth = Azimuth.model_construct()
    """The azimuth axis, in degrees on the rotor's own scale."""
    elevation: Elevation = Elevation.model_construct()
    """The elevation axis."""
    station: StationTable = StationTable.model_construct()
    """Where the antenna stands: for the sky, telescope programs and PstRotator's `LLH`."""
    sky: SkyTable = SkyTable.model_construct()
    """What is known of the sky."""
    mount: MountTable = MountTable.model_construct()
    """How the two axes carry the antenna."""
    control: Control = Control.model_construct()
    """The control loop."""
    state: StateTable = StateTable.model_construct()
    """What the box remembers from one run to the next."""
    monitor: MonitorTable = MonitorTable.model_construct()
    """The monitor of the bytes on the links."""
    mqtt: MqttTable = MqttTable.model_construct()
    """A broker of messages, for Home Assistant and the like; needs the extra `mqtt`."""
    notify: NotifyTable = NotifyTable.model_construct()
    """Notices for a person who does not look at the box, posted to an address: ntfy, a home's hub, a chat."""
    page: PageTable = PageTable.model_construct()
    """The page for a browser, and its API. Moving the antenna there needs pairing: `rotator pair`."""
    pulses: Pulses = Pulses.model_construct()
    """Rotor type relay-pulse: contacts that are counted, as on the Alliance U-100."""
    timed: Timed = Timed.model_construct()
    """Rotor type relay-timed: motors from which nothing comes back."""
    moteus: Moteus = Moteus.model_construct()
    """Rotor type moteus: two controllers on CAN-FD."""
    servo: Servo = Servo.model_construct()
    """Rotor type servo: two hobby servos on a PCA9685."""
    digipot: Digipot = Digipot.model_construct()
    """Rotor type digipot: an MCP41010 for each control box's knob."""
    bridge: Bridge = Bridge.model_construct()
    """Rotor type h-bridge: DC motors behind H-bridges, with encoders. Numbers are GPIO (BCM)."""
    controller: Controller = Controller.model_construct()
    """Rotor type controller: a ready-made controller for both axes, or one for each."""
    stepper: Stepper = Stepper.model_construct()
    """Rotor type stepper: a TMC5160 or TMC5130 for each motor, on the Pi's own SPI."""
    compass: CompassTable = CompassTable.model_construct()
    """The compass that finds north."""
    relays: Relays = Relays.model_construct()
    """The motor relays. Numbers are GPIO (BCM), not pins of the header."""
    adc: Adc = Adc.model_construct()
    """The converter that reads the pots."""
    panel: PanelTable = PanelTable.model_construct()
    """A front panel. A part without a key is not fitted."""
    limits: LimitsTable = LimitsTable.model_construct()
    """Limit switches: normally closed, to ground, so that a broken wire acts as a reached limit."""
    lcd: Lcd = Lcd.model_construct()
    """The 16×2 display."""
    sim: Sim = Sim.model_construct()
    """The simulated rotor. Real hardware ignores it."""
    link: list[Link] = Field(default_factory=list)
    """A link to a program. Each has exactly one place: `pty`, `serial` or `tcp`; stellarium and pstrotatoraz `tcp`;
    rotctld-follow `connect`; pstrotator, n1mm, macdoppler `udp`; wsjtx `file`."""

    @model_validator(mode="before")
    @classmethod
    def _usual(cls, values: Any) -> Any:
        return with_usual(values) if isinstance(values, dict) else values

    def faults(self) -> Iterator[str]:
        axes = {axis: self.axis(axis) for axis in self.fitted}
        if not axes:
            yield "neither axis is fitted: one of azimuth.fitted and elevation.fitted must be true"
            return
        yield from filter(None, (chip.fault() for chip in self.chips()))
        yield from (*pins_twice(self.pins()), *chips_twice(self.chips()))
        yield from (*places_twice(self.link), *follows_itself(self.link))
        yield from needs_station(self.link) if not self.station.is_known else ()
        yield from self.adc.faults_in_use() if self.uses_adc else ()
        yield from (*self.kind.faults(axes), *self._compass_faults(), *self._switches_in_the_way())
        yield from self._park_faults()
        yield from forbidden_faults(self.mount.forbidden, {axis: self.axis(axis) for axis in Axis}, self._stands_at())
        if self.notify.url and not self.page.enabled:
            yield "notify.url needs the page, which posts the notices: page.enabled = true"
        switched = self.rotor.switched
        yield from felt_faults(self.azimuth, self.elevation, self.mount, self.rotor.type, switched=switched)
        yield from endless_faults(axes, self.kind, self.rotor.type, self.angle, self.limits.switches)
        for axis, brake in self.brakes.items():
            if not self.rotor.switched:
                yield f"{axis.value}.brake is for motors on relays: rotor.type = {self.rotor.type} has no such motor"
            elif brake.rock and self.counts(axis):
                yield (
                    f"{axis.value}.brake.rock is for an angle that is measured: an axis that counts cannot see whether "
                    "the short run has turned it"
                )
        if self.speeds and self.rotor.type != "relay-pot":
            yield (
                f"{next(iter(self.speeds)).value}.speed is for motors on relays whose angle is measured: rotor.type = "
                f"{self.rotor.type} has no such motor"
            )
        if self.mount.tolerance == "axis" and not self.rotor.switched:
            yield 'mount.tolerance = "axis" is for motors on relays: these go to every angle, however near'

    @property
    def simulated(self) -> bool:
        """Whether the rotor is a simulated one."""
        return self.rotor.hardware == "sim"

    @property
    def keeps_files(self) -> bool:
        """Whether the rotor outlives the program, so that kept angles stay true: a real or a kept one."""
        return not self.simulated or self.sim.world is not None

    @property
    def kind(self) -> Kind:
        """The kind of rotor that the file names, with the tables that its fields name."""
        kind = KINDS[self.rotor.type]
        make: Callable[..., Kind] = kind
        return make(*(getattr(self, field.name) for field in fields(kind)))

    @property
    def fitted(self) -> tuple[Axis, ...]:
        """The axes that the rotor has."""
        return tuple(axis for axis in Axis if self.axis(axis).fitted)

    def of_each(self, make: Callable[[Axis], T]) -> tuple[T | None, T | None]:
        """What `make` makes for azimuth and for elevation; None for an axis that the rotor does not have."""
        azimuth, elevation = (make(axis) if axis in self.fitted else None for axis in Axis)
        return azimuth, elevation

    def is_of_an_axis_not_fitted(self, key: str) -> bool:
        """Whether this key of the file names a part of an axis that the rotor does not have."""
        words = {word for part in key.split(".") for word in part.split("_")}
        return any(axis.value in words for axis in Axis if axis not in self.fitted)

    def off_lines(self) -> list[OffLine]:
        """The outputs of the axes that it has which must be off while the Pi starts and after the program has died."""
        return [line for line in self.kind.off_lines() if not self.is_of_an_axis_not_fitted(line.key)]

    def axis(self, axis: Axis) -> AxisTable:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    @property
    def brakes(self) -> dict[Axis, BrakeTable]:
        """The brake of each axis that has one."""
        return {axis: brake for axis in self.fitted if (brake := self.axis(axis).brake).line is not None}

    @property
    def speeds(self) -> dict[Axis, SpeedTable]:
        """The speed output of each axis that has one."""
        return {axis: speed for axis in self.fitted if (speed := self.axis(axis).speed).output != "none"}

    def angle(self, axis: Axis) -> Angle:
        """How the angle of this axis is known: by its own sensor table, else as its kind of rotor says."""
        angle = self.axis(axis).sensor.angle or self.kind.own
        return in_turns(angle) if self.endless(axis) else angle

    def endless(self, axis: Axis) -> bool:
        """Whether the axis turns on and on, without ends."""
        return self.axis(axis).endless and self.axis(axis).fitted

    def has_pot(self, axis: Axis) -> bool:
        """Whether a pot on the converter measures the angle of this axis."""
        return self.angle(axis).pot

    def counts(self, axis: Axis) -> bool:
        """Whether the angle of this axis is counted from an end stop: by pulses, or by time."""
        source = self.angle(axis).source
        return source is AngleSource.COUNTED or (source is AngleSource.MODELLED and self.rotor.switched)

    def speeds_dps(self, axis: Axis) -> tuple[float, float] | None:
        """The speeds of an axis that is reckoned by time, clockwise or up first; None: it is not."""
        return self.kind.speeds_dps(axis, self.axis(axis)) if self.counts(axis) else None

    def in_degrees(self, axis: Axis) -> bool:
        """Whether the readings of this axis are degrees on the rotor's own scale, and need no calibration."""
        return self.angle(axis).in_degrees

    def end_stop(self, axis: Axis) -> EndStop | None:
        """The end stop at which homing ends; None for an axis that does not count, and has no homing."""
        return self.kind.end_stop(axis, self.axis(axis).max_deg) if self.counts(axis) else None

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        """The lowest and highest possible limit, on the rotor's own scale; None: the tables set no end."""
        stop, reach_deg = self.end_stop(axis), self.kind.reach_deg(axis)
        return (stop.home_deg, reach_deg[1]) if stop else reach_deg

    @property
    def uses_adc(self) -> bool:
        return any(self.has_pot(axis) for axis in self.fitted)

    def spi_uses(self) -> list[SpiUse]:
        """The SPI chips in use, by table."""
        sensors = [use for axis in self.fitted for use in self.axis(axis).sensor.spi_uses(f"{axis.value}.sensor")]
        return self.kind.spi_uses() + (self.adc.spi_uses() if self.uses_adc else []) + sensors

    def pins(self) -> list[tuple[int, str]]:
        """Every GPIO in use, with the key that names it."""
        used = [*spi_lines(self.spi_uses()), *self.kind.pins()]
        used += [(pin, f"panel.{key}") for key, pin in self.panel.switches.items()]
        used += [(pin, f"limits.{key}") for key, pin in self.limits.switches.items()]
        used += [(pin, f"lcd.{key}") for key, pin in self.lcd.lines.items()]
        return [(pin, key) for pin, key in used if not self.is_of_an_axis_not_fitted(key)]

    def chips(self) -> list[I2CChip]:
        """Every I2C chip in use."""
        used = self.adc.chips() if self.uses_adc else []
        used += [chip for axis in self.fitted for chip in self.axis(axis).sensor.chips(f"{axis.value}.sensor.address")]
        return used + self.kind.chips() + self.panel.chips() + self.compass.chips() + self.lcd.chips()

    def _compass_faults(self) -> Iterator[str]:
        if not self.compass.at_start:
            return
        if self.compass.kind == "none":
            yield 'compass.at_start needs a compass: kind = "bno055"'
        if self.rotor.type not in ("moteus", "stepper"):
            yield "compass.at_start is for a rotor that may not know its angle: rotor.type = moteus or stepper"
        if self.mount.north == "true" and self.mount.declination_deg is None:
            yield "compass.at_start needs mount.declination_deg: a compass shows magnetic north"

    def _switches_in_the_way(self) -> list[str]:
        """Homing ends just below a low limit switch: the range must begin above it. An axis that is reckoned by time
        may meet each switch at any time."""
        if timed := [key for key in self.limits.switches if self.speeds_dps(Axis(key.split("_")[0]))]:
            return [
                f"limits.{timed[0]}: leave it out; by time alone the box would run into it: the rotor's own end "
                "switches stop the motor there"
            ]
        stops = {axis: stop for axis in self.fitted if (stop := self.end_stop(axis))}
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
            if axis in self.fitted
            if not self.axis(axis).min_deg <= angle_deg <= self.axis(axis).max_deg
        ]

    def _stands_at(self) -> dict[str, Place]:
        """By key: where the antenna has to be able to stand."""
        places = {"the park position": self.park_deg}
        if self.rotor.type == "digipot":
            places["digipot's start_deg"] = (self.digipot.azimuth.start_deg, self.digipot.elevation.start_deg)
        return places
