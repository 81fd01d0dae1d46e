"""The sky over the station that a configuration names: its place, the satellites known, and the system's clock."""

from __future__ import annotations

import time

from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.model import Config
from rotator.config.sky import SkyTable
from rotator.config.station import StationTable
from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.sectors import Place
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.orbits.locator import from_locator
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import Fixed, find
from rotator.tracking.planned import Followed


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


def build_followed(sky: SkyTable, site: Site, catalogue: Catalogue) -> tuple[list[Followed], list[str]]:
    """What `[[sky.follow]]` names, and a sentence for each table whose target is not known or never rises."""
    followed: dict[str, Followed] = {}
    faults = []
    for number, table in enumerate(sky.follow):
        where = f"sky.follow[{number}]"
        try:
            target = find(table.name, site, catalogue)
        except (Unknown, NotThere) as reason:
            faults.append(f"{where}: {reason}")
            continue
        if isinstance(target, Fixed):
            faults.append(f'{where}: "{table.name}" is a fixed direction: it has no passes')
        elif target.name in followed:
            faults.append(f'{where}: "{table.name}" is {target.name}, which is followed already')
        else:
            followed[target.name] = Followed(target, table.priority, table.min_culmination_deg)
    return list(followed.values()), faults


def build_antenna(config: Config, stands_deg: Place | None = None) -> Antenna:
    """As a plan sees it: at the park position, unless told where it stands."""
    mount = build_mount(config)
    azimuth, elevation = planned_motors(config)
    return Antenna(mount, azimuth, elevation, stands_deg or (mount.park_azimuth_deg, mount.park_elevation_deg))
