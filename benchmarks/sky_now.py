"""Satellites made for this moment over a station, as a file of elements: for pictures and tests in real time.

Real elements age, and a real pass is seldom there when it is needed. These have a real orbit's shape, the epoch of now,
and the place in it that lets the satellite rise, or set, when it shall.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Sequence
from dataclasses import replace

from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.omm import message
from rotator.orbits.satellite import Satellite

LIKE = Elements("LIKE ISS", 90_001, 0.0, 15.3, 0.0005, 65.0, 0.0, 0.0, 0.0, 0.0001)


def satellite(name: str, number: int, utc_s: float, site: Site, wanted: Callable[[Satellite], bool]) -> Elements:
    """The first of the orbits with this shape in which the satellite does what is wanted."""
    for node_deg in range(0, 360, 5):
        for anomaly_deg in range(0, 360, 2):
            each = replace(
                LIKE,
                name=name,
                catalogue_number=number,
                epoch_utc_s=utc_s,
                ascending_node_deg=float(node_deg),
                mean_anomaly_deg=float(anomaly_deg),
            )
            if wanted(Satellite(each, site)):
                return each
    raise ValueError(f"no orbit lets {name} do that")


def crowd(utc_s: float, count: int, site: Site) -> list[Elements]:
    """Satellites that are up now, at any place of the sky, and a minute later."""
    draw, found = random.Random(7), list[Elements]()
    while len(found) < count:
        node_deg, anomaly_deg = draw.uniform(0, 360), draw.uniform(0, 360)
        each = replace(
            LIKE,
            name=f"CROWD {len(found)}",
            catalogue_number=91_000 + len(found),
            epoch_utc_s=utc_s,
            ascending_node_deg=node_deg,
            mean_anomaly_deg=anomaly_deg,
        )
        if all(Satellite(each, site).sight(utc_s + later_s).elevation_deg > 2 for later_s in (0, 60)):
            found.append(each)
    return found


def rises_in(utc_s: float, wait_s: float, highest_deg: float = 30.0) -> Callable[[Satellite], bool]:
    """It rises within half a minute after the wait, and gets at least so high four minutes later."""

    def wanted(each: Satellite) -> bool:
        down = each.sight(utc_s + wait_s).elevation_deg < 0 < each.sight(utc_s + wait_s + 30.0).elevation_deg
        return down and each.sight(utc_s + wait_s + 270.0).elevation_deg > highest_deg

    return wanted


def sets_in(utc_s: float, left_s: float) -> Callable[[Satellite], bool]:
    """It is up, and sets within 15 seconds after the time that is left."""

    def wanted(each: Satellite) -> bool:
        still, gone = each.sight(utc_s + left_s).elevation_deg, each.sight(utc_s + left_s + 15.0).elevation_deg
        return still > 0 > gone and each.sight(utc_s).elevation_deg > 2.0

    return wanted


def as_json(sets: Sequence[Elements]) -> str:
    """A file that the program reads."""
    return json.dumps([message(each) for each in sets])
