"""The sky over the station that a configuration names: its place, its satellites, the system's clock.

Knows where elements are read from, and where they are fetched to. Does not know what a target is, nor when it passes.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

from rotator.config.model import Config
from rotator.config.sky import StationTable
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.element_files import Read, read_file
from rotator.orbits.locator import from_locator
from rotator.store import uploads
from rotator.store.fetches import FOLDER, file_of

if TYPE_CHECKING:
    from rotator.orbits.celestial import Sky


def build_site(station: StationTable) -> Site | None:
    """The site of the station; None where the file names no place."""
    longitude_deg, latitude_deg = station.longitude_deg, station.latitude_deg
    if station.locator is not None:
        longitude_deg, latitude_deg = from_locator(station.locator)
    if longitude_deg is None or latitude_deg is None:
        return None
    return Site(latitude_deg, longitude_deg, station.altitude_m, refraction=station.refraction)


def build_sky(station: StationTable) -> Sky | None:
    """The sky over the station, by the system's clock; None where the file names no place."""
    site = build_site(station)
    if site is None:
        return None
    from rotator.orbits.celestial import Sky  # noqa: PLC0415 - slow to load

    return Sky(site, time.time)


def build_catalogue(config: Config) -> Catalogue:
    """Files that cannot be read are among its faults."""
    return Catalogue(config.sky.elements, fetched=fetched_files(config), to_come=[uploaded_folder(config)])


def build_later_catalogue(config: Config, read: Read = read_file) -> Catalogue:
    """The same, and nothing is read before its first `refresh`."""
    fetched, uploaded = fetched_files(config), [uploaded_folder(config)]
    return Catalogue(config.sky.elements, fetched=fetched, to_come=uploaded, read=read, later=True)


def uploaded_folder(config: Config) -> Path:
    """The folder of the files that a person has sent by the page."""
    return Path(config.state.path).with_name(uploads.FOLDER)


def fetched_files(config: Config) -> list[Path]:
    """The file of each address of `[sky] fetch`, there or not."""
    return [file_of(address, fetched_folder(config)) for address in config.sky.fetch]


def fetched_folder(config: Config) -> Path:
    return Path(config.state.path).with_name(FOLDER)
