"""Streams of orders as tracking programs send them, and as anything else may that moves in the sky."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.orbits.recognition import Departed, Recognised, StreamWatch
from rotator.orbits.sight import Sight, Target

PROGRAM = Source("gs232b")
Path = Callable[[float], tuple[float, float]]
"""Azimuth and elevation at so many seconds since 1970."""


def whole(angle_deg: float) -> float:
    """As most programs round."""
    return math.floor(angle_deg + 0.5)


def orders(path: Path, from_s: float, seconds: int, rounds: Callable[[float], float] = whole) -> Iterator[Aim]:
    for second in range(seconds):
        azimuth_deg, elevation_deg = path(from_s + second)
        yield Aim(rounds(azimuth_deg) % 360, rounds(max(0.0, elevation_deg)))


def path_of(satellite: Target) -> Path:
    def at(utc_s: float) -> tuple[float, float]:
        sight = satellite.sight(utc_s)
        return sight.azimuth_deg, sight.elevation_deg

    return at


@dataclass(frozen=True, slots=True)
class News:
    """After so many orders."""

    orders: int
    what: Recognised | Departed


def heard(watch: StreamWatch, path: Path, from_s: float, seconds: int, *, ahead_s: float = 0.0) -> list[News]:
    """A program sends whole degrees once a second; its clock is ahead by so much. `from_s`: by its own clock."""
    news = []
    for count, aim in enumerate(orders(path, from_s, seconds)):
        if (what := watch.hear(PROGRAM, aim, from_s - ahead_s + count)) is not None:
            news.append(News(count + 1, what))
    return news


def great_circle(begin: Sight, course_deg: float, speed_dps: float, from_s: float) -> Path:
    """From there on straight across the sky. A course of 0 goes up, of 90 to the right."""
    az, el, course = (math.radians(deg) for deg in (begin.azimuth_deg, begin.elevation_deg, course_deg))
    ahead = math.cos(el) * math.sin(az), math.cos(el) * math.cos(az), math.sin(el)
    right = math.cos(az), -math.sin(az), 0.0
    up = -math.sin(el) * math.sin(az), -math.sin(el) * math.cos(az), math.cos(el)

    def at(utc_s: float) -> tuple[float, float]:
        gone = math.radians(speed_dps * (utc_s - from_s))
        east, north, high = (
            a * math.cos(gone) + (r * math.sin(course) + u * math.cos(course)) * math.sin(gone)
            for a, r, u in zip(ahead, right, up, strict=True)
        )
        return math.degrees(math.atan2(east, north)) % 360.0, math.degrees(math.asin(max(-1.0, min(1.0, high))))

    return at
