"""The sky over the station that a configuration names: its place, satellites, the clock, a tracker."""

from __future__ import annotations

import time

from rotator.assembly.settings import planned_motors
from rotator.config.model import Config
from rotator.config.sky import SkyTable
from rotator.config.station import StationTable
from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.mount import Mount
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.orbits.locator import from_locator
from rotator.orders import Order
from rotator.runtime.loop import ControlLoop
from rotator.status import Status
from rotator.tracking import system_clock
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.planner import ProcessPlanner
from rotator.tracking.thread import TrackingThread
from rotator.tracking.tracker import TRACK, Tracker


def build_site(station: StationTable) -> Site | None:
    """None where the file names no place."""
    longitude_deg, latitude_deg = station.longitude_deg, station.latitude_deg
    if station.locator is not None:
        longitude_deg, latitude_deg = from_locator(station.locator)
    if longitude_deg is None or latitude_deg is None:
        return None
    return Site(latitude_deg, longitude_deg, station.altitude_m)


def build_sky(station: StationTable) -> Sky | None:
    """By the system's clock; None where the file names no place."""
    site = build_site(station)
    return None if site is None else Sky(site, time.time)


def build_catalogue(sky: SkyTable) -> Catalogue:
    """Files that cannot be read are among its faults."""
    return Catalogue(sky.elements)


def build_tracking(config: Config, loop: ControlLoop, mount: Mount) -> TrackingThread | None:
    """Not started yet; None where the file names no place."""
    site = build_site(config.station)
    if site is None:
        return None
    sky, planner = KnownSky(site, build_catalogue(config.sky)), ProcessPlanner()
    # A simulated rotor may live at any time.
    trusted = system_clock.is_set if config.rotor.hardware == "pi" else lambda: True
    return TrackingThread(Tracker(sky, planner, TrackedBox(config, loop, mount), trusted), sky, planner)


class TrackedBox:
    """The box as its tracker sees it: `rotator.tracking.tracker.Box`."""

    def __init__(self, config: Config, loop: ControlLoop, mount: Mount) -> None:
        self._loop = loop
        self._mount = mount
        self._motors = planned_motors(config)

    def status(self) -> Status:
        return self._loop.status

    def antenna(self) -> Antenna | None:
        azimuth_deg, elevation_deg = self._loop.status.azimuth.angle_deg, self._loop.status.elevation.angle_deg
        if azimuth_deg is None or elevation_deg is None:
            return None
        return Antenna(self._mount, *self._motors, (azimuth_deg, elevation_deg))

    def order(self, order: Order) -> None:
        self._loop.post(TRACK, order)
