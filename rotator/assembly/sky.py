"""The sky over the station that a configuration names: its place, its satellites, the system's clock."""

from __future__ import annotations

import time

from rotator.config.sky import SkyTable
from rotator.config.station import StationTable
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.orbits.locator import from_locator


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
