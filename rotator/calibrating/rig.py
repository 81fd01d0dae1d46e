"""One axis on the bench, or the compass: the control loop with its guard but without links, and the guide through it.

Part of the composition root. Knows how the parts fit together; what is asked and what is believed is the guides'.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from hw.ports import Axis, HardwareError
from rotator.assembly.board import Board
from rotator.assembly.settings import build_controller, build_offsets, source
from rotator.assembly.station import Station
from rotator.calibrating.answers import Answer
from rotator.calibrating.asking import Asking, Commissioned, Known
from rotator.calibrating.boom import Scale
from rotator.calibrating.compass import CompassReader, open_compass
from rotator.calibrating.degrees import DegreesGuide, Kind
from rotator.calibrating.guide import Guide
from rotator.calibrating.north import Found, NorthGuide, Placed
from rotator.calibrating.readings import DEGREES
from rotator.calibrating.walk import Walk
from rotator.config.model import Config
from rotator.config.save import changed, save_axis
from rotator.orders import Source
from rotator.runtime.loop import ControlLoop
from rotator.store.compass import CompassFile

SCALES_DEG = {Axis.AZIMUTH: (-360.0, 720.0), Axis.ELEVATION: (-90.0, 210.0)}
"""What the file accepts as an angle of the axis."""
SETTLE_S = 2.0
"""From 30°/s, at 20°/s² down, a motor that goes to an angle by itself is still moving for a second and a half."""
CALIBRATE = Source("calibrate")

Saved = Commissioned | Found


class Sat(Protocol):
    """What a sitting is held at."""

    loop: ControlLoop

    @property
    def guide(self) -> Walk: ...

    @property
    def result(self) -> Saved | Placed | None:
        """What came of it; None: nothing."""

    def step(self, answer: Answer | None = None) -> tuple[str, ...]:
        """Show the guide how things stand, and what the person said; returns what it says to that."""

    def picture(self) -> tuple[str, bool]:
        """How it stands, in a line, and whether it turns."""

    def start(self) -> None: ...

    def stop(self) -> None: ...


class Bench:
    """The axis, taken for one that nobody has set up: it obeys jog only, 2 s a press."""

    def __init__(self, config: Config, axis: Axis, station: Station, clock: Callable[[], float]) -> None:
        self.guide: Asking = _guide(config, axis)
        controller = build_controller(_unlimited(config, axis), commissioning=axis)
        self.loop = ControlLoop(
            controller,
            station.rotor,
            clock,
            1 / config.control.rate_hz,
            after_good_step=station.beat,
        )

    @property
    def result(self) -> Commissioned | None:
        return self.guide.result

    def step(self, answer: Answer | None = None) -> tuple[str, ...]:
        turn = self.guide.step(self.loop.status, answer)
        for order in turn.orders:
            self.loop.post(CALIBRATE, order)
        return turn.lines

    def picture(self) -> tuple[str, bool]:
        axis = self.loop.status.axis(self.guide.known.axis)
        reading = "----" if axis.raw is None else self.guide.reading(axis.raw)
        way = f"  {self.guide.way(axis.drive)}" if axis.drive else ""
        return f"reading {reading}{way}", bool(axis.drive)

    def start(self) -> None:
        """Nothing beside the loop."""

    def stop(self) -> None:
        """Nothing beside the loop."""


class NorthBench:
    """The whole box, as it is set up, with its compass. `kept`: the file of what that has learnt; None: there is none.

    Raises HardwareError where the file has no compass.
    """

    def __init__(
        self,
        config: Config,
        station: Station,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        kept: Path | None = None,
    ) -> None:
        self._opened = ExitStack()
        self._keeping = False
        compass = open_compass(config, Board(station.world, self._opened, clock, sleep))
        self.compass = CompassReader(compass, clock, CompassFile(kept) if kept else None)
        self.loop = ControlLoop(
            build_controller(config), station.rotor, clock, 1 / config.control.rate_hz, after_good_step=station.beat
        )
        magnetic = config.mount.north == "magnetic"
        self.guide = NorthGuide(
            Scale(
                config.azimuth.offset_deg,
                build_offsets(config).azimuth_deg,
                # A magnetic scale stays one: the mount adds the declination to it.
                0.0 if magnetic else config.mount.declination_deg,
                config.compass.offset_deg,
                keeps=kept is not None,
            )
        )

    @property
    def result(self) -> Found | Placed | None:
        return self.guide.result

    def step(self, answer: Answer | None = None) -> tuple[str, ...]:
        reader = self.compass
        if reader.latest:
            self.guide.see(reader.latest)
        turn = self.guide.step(self.loop.status, answer)
        for order in turn.orders:
            self.loop.post(CALIBRATE, order)
        if self.guide.keep and not self._keeping:
            reader.keep()
            self._keeping = True
        elif self._keeping and not reader.keeps:
            self.guide.keep = self._keeping = False
        return (*turn.lines, *(reader.told.popleft() for _ in range(len(reader.told))))

    def picture(self) -> tuple[str, bool]:
        status, seen = self.loop.status, self.compass.latest
        angle = "----" if status.azimuth.angle_deg is None else f"{status.azimuth.angle_deg:.1f}°"
        compass = "----" if seen is None or seen.problem else f"{seen.heading_deg:.1f}°; {seen.learnt}"
        return f"azimuth {angle}  compass {compass}", status.moving

    def start(self) -> None:
        self.compass.start()

    def stop(self) -> None:
        self.compass.stop()
        self._opened.close()


def keep(done: Saved, path: Path) -> None:
    """Into the file, whole or not at all. Raises OSError or ConfigError."""
    saved = _keys(done)
    save_axis(path, saved.axis, calibration=saved.points, **saved.values)


def as_toml(done: Saved) -> str:
    """The same as text, for a person without a file."""
    saved = _keys(done)
    return changed("", saved.axis, calibration=saved.points, **saved.values)


@dataclass(frozen=True, slots=True)
class _Keys:
    axis: str
    points: tuple[tuple[float, float], ...] | None
    values: dict[str, float | bool]


def _keys(done: Saved) -> _Keys:
    match done:
        case Commissioned(axis, points, min_deg, max_deg):
            limits: dict[str, float | bool] = {"min_deg": min_deg, "max_deg": max_deg, "direction_checked": True}
            return _Keys(axis.value, points, limits)
        case Found(offset_deg):
            return _Keys(Axis.AZIMUTH.value, None, {"offset_deg": offset_deg})


def _guide(config: Config, axis: Axis) -> Asking:
    table = config.axis(axis)
    if config.in_degrees(axis):
        known = Known(
            axis,
            table.min_deg,
            table.max_deg,
            -math.inf,
            math.inf,
            *_reach_deg(config, axis),
            grain=DEGREES,
            settle_s=0.0 if config.rotor.switched else SETTLE_S,
        )
        shift_deg = build_offsets(config).of(axis)
        return DegreesGuide(
            known, Kind(config.rotor.type, source(config, axis), shift_deg, config.kind.first_move(axis))
        )
    if not config.rotor.switched:
        raise HardwareError(
            f"{axis.value}: this rotor is told angles, so it can be turned only when its {table.sensor.kind} is "
            "calibrated: turn it by hand or by its own control box, and write `calibration` into the file "
            "(docs/calibration.md#by-hand)"
        )
    known = Known(axis, table.min_deg, table.max_deg, table.lowest_reading, table.highest_reading, *SCALES_DEG[axis])
    return Guide(known, config.adc.supply_v if config.has_pot(axis) else None)


def _reach_deg(config: Config, axis: Axis) -> tuple[float, float]:
    """Where its limits can be, on the rotor's own scale."""
    low_deg, high_deg = config.reach_deg(axis)
    lowest_deg, highest_deg = SCALES_DEG[axis]
    return lowest_deg if low_deg is None else low_deg, highest_deg if high_deg is None else high_deg


def _unlimited(config: Config, axis: Axis) -> Config:
    """A motor that goes to an angle by itself goes no further than its limits; these have still to be found."""
    if config.rotor.switched:
        return config
    low_deg, high_deg = _reach_deg(config, axis)
    table = config.axis(axis).model_copy(update={"min_deg": low_deg, "max_deg": high_deg})
    return config.model_copy(update={axis.value: table})
