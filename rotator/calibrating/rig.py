"""The parts that run during a calibration: the control loop with its guard, without links, and the guide on top.

Knows how a guide is fed with statuses and how its orders reach the loop. The questions are the guides'; the hardware is
put together in `rotator.assembly`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack

from hw.ports import Axis, FeelsField, HardwareError
from rotator.assembly.buses import Board
from rotator.assembly.calibration import (
    calibration_controller,
    guided_controller,
    open_compass,
)
from rotator.assembly.station import Station
from rotator.calibrating.axis_guide import AxisGuide
from rotator.calibrating.compass import CompassReader
from rotator.calibrating.degrees_guide import DegreesGuide
from rotator.calibrating.entries import Entry
from rotator.calibrating.facts import axis_facts, north_facts
from rotator.calibrating.field_guide import FieldGuide
from rotator.calibrating.guide import Guide
from rotator.calibrating.north_guide import NorthGuide
from rotator.calibrating.stopwatch_guide import StopwatchGuide
from rotator.calibrating.table_guide import TableGuide
from rotator.config.model import Config
from rotator.control.controller import Controller
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus
from rotator.runtime.loop import ControlLoop
from rotator.store.state import State

CALIBRATE = Source("calibrate")


class Rig:
    """What a calibration session runs, one after the other: a guide on a control loop."""

    guide: Guide
    loop: ControlLoop

    def step(self, entry: Entry | None = None) -> tuple[str, ...]:
        """Give the guide the latest status and an entry. Returns the lines it shows."""
        return step(self.guide, self.loop, entry)

    def picture(self) -> tuple[str, bool]:
        """The state in one line, and whether anything moves."""
        raise NotImplementedError

    def start(self) -> None:
        """What runs beside the loop, which the session starts and stops."""

    def stop(self) -> None:
        """What `start` has started."""


class AxisRig(Rig):
    """One axis, treated as never set up: it obeys jog only, 2 s a press."""

    guide: AxisGuide

    def __init__(
        self, config: Config, axis: Axis, station: Station, clock: Callable[[], float], guide: AxisGuide | None = None
    ) -> None:
        """`guide`: None: the one that fits the axis's sensor."""
        self.guide = guide or axis_guide(config, axis)
        self.loop = control_loop(config, calibration_controller(config, axis), station, clock)

    def picture(self) -> tuple[str, bool]:
        guide, axis = self.guide, self.loop.status.axis(self.guide.facts.axis)
        return f"reading {reading(guide, axis)}  {doing(guide, axis)}".rstrip(), bool(axis.drive)


class FieldRig(AxisRig):
    """The azimuth, while the compass that is its sensor learns its iron. Raises HardwareError where it has none."""

    guide: FieldGuide

    def __init__(self, config: Config, station: Station, clock: Callable[[], float]) -> None:
        sensor = station.rotor.sensors.get(Axis.AZIMUTH)
        if not isinstance(sensor, FeelsField):
            raise HardwareError(
                "the azimuth has no compass as its sensor, so there is none that could learn: see rotator help compass"
            )
        sensor.ellipse = None
        self._sensor: FeelsField = sensor
        super().__init__(config, Axis.AZIMUTH, station, clock, FieldGuide(axis_facts(config, Axis.AZIMUTH)))

    def step(self, entry: Entry | None = None) -> tuple[str, ...]:
        if self._sensor.field_ut:
            self.guide.feel(self._sensor.field_ut)
        return super().step(entry)

    def picture(self) -> tuple[str, bool]:
        ahead_ut, left_ut = self._sensor.field_ut or (math.nan, math.nan)
        return f"field {ahead_ut:.1f} µT ahead, {left_ut:.1f} µT to the left", super().picture()[1]


class NorthRig(Rig):
    """The whole box as configured, with its compass. Raises HardwareError where the file has no compass.

    `corrections`: what remembers the compass's own corrections; None: they are not kept.
    """

    guide: NorthGuide

    def __init__(
        self,
        config: Config,
        station: Station,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        corrections: State | None = None,
    ) -> None:
        self._opened = ExitStack()
        self._saving = False
        compass = open_compass(config, Board(station.world, self._opened, clock, sleep))
        self.compass = CompassReader(compass, clock, corrections)
        self.loop = control_loop(config, guided_controller(config), station, clock)
        self.guide = NorthGuide(north_facts(config, has_file=corrections is not None))

    def step(self, entry: Entry | None = None) -> tuple[str, ...]:
        reader = self.compass
        if reader.latest:
            self.guide.see(reader.latest)
        lines = super().step(entry)
        if self.guide.save_wanted and not self._saving:
            reader.save_wanted.set()
            self._saving = True
        elif self._saving and not reader.save_wanted.is_set():
            self.guide.save_wanted = self._saving = False
        return (*lines, *(reader.messages.popleft() for _ in range(len(reader.messages))))

    def picture(self) -> tuple[str, bool]:
        status, seen = self.loop.status, self.compass.latest
        angle = "----" if status.azimuth.angle_deg is None else f"{status.azimuth.angle_deg:.1f}°"
        compass = "----" if seen is None or seen.problem else f"{seen.heading_deg:.1f}°; {seen.calibration}"
        return f"azimuth {angle}  compass {compass}", status.moving

    def start(self) -> None:
        self.compass.start()

    def stop(self) -> None:
        self.compass.stop()
        self._opened.close()


def control_loop(config: Config, controller: Controller, station: Station, clock: Callable[[], float]) -> ControlLoop:
    return ControlLoop(controller, station.rotor, clock, 1 / config.control.rate_hz, after_good_step=station.beat)


def step(guide: Guide, loop: ControlLoop, entry: Entry | None) -> tuple[str, ...]:
    result = guide.step(loop.status, entry)
    for order in result.orders:
        loop.post(CALIBRATE, order)
    return result.lines


def reading(guide: AxisGuide, axis: AxisStatus) -> str:
    facts = guide.facts
    if axis.raw is None:
        return "----"
    if facts.lowest_reading <= axis.raw <= facts.highest_reading:
        return guide.reading_text(axis.raw)
    no_sensor = f"which no whole sensor reads: {facts.lowest_reading:g} to {facts.highest_reading:g}"
    return f"{guide.reading_text(axis.raw)}, {no_sensor}"


def doing(guide: AxisGuide, axis: AxisStatus) -> str:
    """The way that the motor turns; empty: it stands."""
    if axis.drive:
        return guide.direction_text(axis.drive)
    return "it waits, and looks whether the axis stands" if axis.waiting else ""


def page_guide(config: Config, axis: Axis) -> AxisGuide:
    """On the page a compass that has not learnt its iron does that first. Raises HardwareError as `axis_guide`."""
    return axis_guide(config, axis) if config.axis(axis).sensor.learnt else FieldGuide(axis_facts(config, axis))


def axis_guide(config: Config, axis: Axis) -> AxisGuide:
    """The guide that fits the axis's sensor. Raises HardwareError where the axis cannot be calibrated this way."""
    table = config.axis(axis)
    if not table.sensor.learnt:
        raise HardwareError("the compass has to learn its iron first: rotator calibrate compass (rotator help compass)")
    if config.in_degrees(axis):
        timed = config.speeds_dps(axis) is not None
        return (StopwatchGuide if timed else DegreesGuide)(axis_facts(config, axis))
    if not config.rotor.switched:
        raise HardwareError(
            f"{axis.value}: this rotor is sent angles, so it can be turned only when its {table.sensor.kind} is "
            "calibrated: turn it by hand or by its own control box, and write `calibration` into the file "
            "(rotator help calibration by-hand)"
        )
    return TableGuide(axis_facts(config, axis), config.adc.supply_v if config.has_pot(axis) else None)
