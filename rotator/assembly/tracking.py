"""What tracks the sky by itself: the tracker, the plan of many passes, the listener to streams, and their thread.

Knows the parts and what each is given. `assembly.sky` knows the station and its satellites.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import replace

from rotator.assembly.settings import build_mount, planned_motors
from rotator.assembly.sky import build_catalogue, build_later_catalogue, build_site
from rotator.config.mistake import counted
from rotator.config.model import Config
from rotator.config.sky import SkyTable
from rotator.control.admission import refusal
from rotator.control.sky.flight_plan import Antenna, PlannedMotor
from rotator.control.sky.mount import Mount
from rotator.control.sky.sectors import Place
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere, beyond_beam
from rotator.runtime.loop import ControlLoop
from rotator.store.favourites import KeptFavourites
from rotator.store.priorities import Priorities
from rotator.store.state import State
from rotator.tracking.follower import Follower
from rotator.tracking.known_sky import FileReader, KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import WantedOften
from rotator.tracking.planner import ProcessPlanner
from rotator.tracking.ports import TRACK
from rotator.tracking.system_clock import SystemClock
from rotator.tracking.thread import TrackingThread
from rotator.tracking.tracker import NO_PLAN, Tracker

log = logging.getLogger(__name__)


def build_tracking(config: Config, loop: ControlLoop, mount: Mount, state: State) -> TrackingThread:
    """Not started yet. Without a place it tracks directions and tables."""
    reader, planner, box = FileReader(), ProcessPlanner(), TrackedBox(config, loop, mount)
    favourites = KeptFavourites(state)
    sky = KnownSky(build_site(config.station), build_later_catalogue(config, reader.read), favourites.target_of)
    clock, simulated = SystemClock(), config.simulated
    # A simulated rotor needs no right clock: it may track the sky of any moment.
    tracker = Tracker(
        sky,
        planner,
        box,
        lambda: simulated or clock.is_set,
        why_no_plan=lambda: why_no_plan(config.sky, sky),
        rest=lambda: follower.rest,
    )
    priorities = Priorities(state)

    def wanted() -> list[str]:
        return wanted_names(config.sky, sky, priorities.of)

    listener = StreamListener(sky, planner, box, time.time, tracker.clock_trusted, wanted=wanted)
    begun_s = time.monotonic() if config.keeps_files else None
    follower = Follower(tracker, planner, box, lambda: wanted_often(config.sky, sky, priorities.of)[0], begun_s)

    def hear(source: Source, order: Order) -> None:
        listener.hear(source, order)
        tracker.heard(source, order)
        follower.heard(source, order)

    loop.overhear(hear)
    return TrackingThread(
        tracker,
        follower,
        listener,
        sky,
        planner=planner,
        reader=reader,
        clock=clock,
        priorities=priorities,
        favourites=favourites,
    )


def _as_written(_name: str, written: float) -> float:
    return written


def wanted_often(
    table: SkyTable, sky: KnownSky, priority: Callable[[str, float], float] = _as_written
) -> tuple[tuple[WantedOften, ...], list[str]]:
    """What `[[sky.follow]]` names, and a sentence for each table whose target is not known or has no passes.

    `priority` gives the priority in force, for the name of a target and its priority in the file.
    """
    found: dict[str, WantedOften] = {}
    faults = []
    for number, each in enumerate(table.follow):
        where = counted("sky.follow", number)
        try:
            wanted = sky.find(each.name)
            name = "" if isinstance(wanted, Aim) else wanted.target().name
        except (Unknown, NotThere) as reason:
            faults.append(f"{where}: {reason}")
            continue
        if isinstance(wanted, Aim):
            faults.append(f'{where}: "{each.name}" is a fixed direction: it has no passes')
        elif name in found:
            faults.append(f'{where}: "{each.name}" is {name}, which is followed already')
        else:
            found[name] = WantedOften(wanted, priority(each.name, each.priority), each.min_culmination_deg)
    return tuple(found.values()), faults


def why_no_plan(table: SkyTable, sky: KnownSky) -> str:
    """Why there is no plan of many passes; empty: there is one, or may be one when new files of elements are read."""
    found, faults = wanted_often(table, sky)
    if found or (faults and sky.has_news()):
        return ""
    return f"there is no plan: {faults[0]}" if faults else NO_PLAN


def wanted_names(table: SkyTable, sky: KnownSky, priority: Callable[[str, float], float] = _as_written) -> list[str]:
    """The known targets of `[[sky.follow]]`, as their elements call them; the highest priority first."""
    found = sorted(wanted_often(table, sky, priority)[0], key=lambda each: -each.priority)
    return [each.wanted.target().name for each in found]


def build_antenna(config: Config, stands_deg: Place | None = None) -> Antenna:
    """The antenna as a plan sees it. `stands_deg` None: at the park position."""
    mount = build_mount(config)
    azimuth, elevation = planned_motors(config)
    return Antenna(mount, azimuth, elevation, stands_deg or (mount.park_azimuth_deg, mount.park_elevation_deg))


def _as_learnt(motor: PlannedMotor, axis: AxisStatus) -> PlannedMotor:
    """The plan knows one speed for both directions: the mean of what the box has found."""
    if axis.learnt is None:
        return motor
    speed_dps, coast_deg = (
        sum(getattr(each, name) for each in axis.learnt) / len(axis.learnt) for name in ("speed_dps", "coast_deg")
    )
    return replace(motor, speed_dps=speed_dps, coast_s=coast_deg / speed_dps)


class TrackedBox:
    """The box as its tracker sees it: `rotator.tracking.ports.Box`."""

    def __init__(self, config: Config, loop: ControlLoop, mount: Mount) -> None:
        self._loop = loop
        self._mount = mount
        self._motors = planned_motors(config)
        self._beam_deg = config.station.beam_deg

    def status(self) -> Status:
        return self._loop.status

    def antenna(self) -> Antenna | None:
        azimuth, elevation = self._loop.status.azimuth, self._loop.status.elevation
        if azimuth.angle_deg is None or elevation.angle_deg is None:
            return None
        motors = _as_learnt(self._motors[0], azimuth), _as_learnt(self._motors[1], elevation)
        return Antenna(self._mount, *motors, (azimuth.angle_deg, elevation.angle_deg))

    def refusal(self, order: Order) -> str:
        refused = refusal(order, self._loop.status, self._mount)
        return refused.reason if refused else ""

    def order(self, order: Order, source: Source = TRACK) -> None:
        # A program's own stream has shown where the satellite is.
        if isinstance(order, Fly) and order.stream is None:
            error_deg = order.expected_error_deg
            if warning := beyond_beam(error_deg, self._beam_deg):
                log.warning("%s: expect an error of up to %.0f°%s", order.name, error_deg, warning)
            order = replace(order, beyond_beam=bool(warning))
        self._loop.post(source, order)


def build_known_sky(config: Config) -> KnownSky:
    """The sky with its elements read, for programs in simulated time."""
    return KnownSky(build_site(config.station), build_catalogue(config))
