"""Skyfield with its own data, no network: another program's word on where satellites, Sun, Moon and planets are."""

from __future__ import annotations

import warnings
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from skyfield.api import EarthSatellite, Loader, wgs84
from skyfield_data import get_skyfield_data_path

from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.omm import message
from rotator.orbits.sight import Sight

TLE = Path(__file__).parent / "elements-2025.tle"
PLANETS = ("mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto")


@cache
def _loader() -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # its table of the earth's turning is a year old
        return Loader(get_skyfield_data_path(), expire=False, verbose=False)


@cache
def _timescale() -> Any:
    return _loader().timescale(builtin=True)


@cache
def _planets() -> Any:
    return _loader()("de421.bsp")


def satellite(name: str) -> Any:
    lines = TLE.read_text(encoding="utf-8").splitlines()
    at = lines.index(name)
    return EarthSatellite(lines[at + 1], lines[at + 2], name, _timescale())


def of_satellite(name: str, site: Site, utc_s: float) -> Sight:
    return _sight((satellite(name) - _place(site)).at(_time(utc_s)))


def of_elements(elements: Elements, site: Site, utc_s: float) -> Sight:
    """Of a satellite that is in no file, by the fields of an OMM."""
    unused = {"CLASSIFICATION_TYPE": "U", "OBJECT_ID": "", "EPHEMERIS_TYPE": 0, "ELEMENT_SET_NO": 1, "REV_AT_EPOCH": 1}
    made = EarthSatellite.from_omm(_timescale(), {**unused, **message(elements)})
    return _sight((made - _place(site)).at(_time(utc_s)))


def of_body(name: str, site: Site, utc_s: float) -> Sight:
    target = _planets()[name if name in ("sun", "moon", "mercury", "venus", "mars") else f"{name} barycenter"]
    return _sight((_planets()["earth"] + _place(site)).at(_time(utc_s)).observe(target).apparent())


def _place(site: Site) -> Any:
    return wgs84.latlon(site.latitude_deg, site.longitude_deg, site.altitude_m)


def _time(utc_s: float) -> Any:
    return _timescale().from_datetime(datetime.fromtimestamp(utc_s, UTC))


def _sight(seen: Any) -> Sight:
    elevation, azimuth, distance = seen.altaz()
    return Sight(float(azimuth.degrees), float(elevation.degrees), float(distance.km))
