"""Places on the earth: Maidenhead locators, degrees-minutes-seconds, distances and bearings.

Knows a spherical earth with 111.2 km to the degree, as Hamlib does. Does not know rotors or protocols. Longitude is
degrees east, latitude is degrees north.
"""

from __future__ import annotations

import math

KM_PER_DEG = 111.2
MOST_PAIRS = 6
_BASES = (18, 10, 24, 10, 24, 10)
"""The number of parts into which each pair of characters divides the square before: fields, squares, subsquares, ..."""
_NUDGE_DEG = 1e-6
"""Added so that a corner written with six decimals belongs to the square that begins there."""
_COINCIDENT_DEG = 1e-6


def to_locator(longitude_deg: float, latitude_deg: float, pairs: int) -> str:
    """The locator of a place in 1 to 6 pairs of characters; three pairs are the usual `FN42SH`."""
    east = (longitude_deg / 2 + 90 + _NUDGE_DEG) % 180 / 10
    north = (latitude_deg + 90 + _NUDGE_DEG) % 180 / 10
    text = ""
    for base in _BASES[:pairs]:
        for part in (east, north):
            text += _character(int(part), base)
        finer = 24 if base == 10 else 10
        east, north = east % 1 * finer, north % 1 * finer
    return text


def from_locator(text: str) -> tuple[float, float]:
    """Longitude and latitude of the middle of a locator's square. Raises ValueError.

    Half a pair at the end is ignored, and so are characters after the sixth pair.
    """
    pairs = [text[at : at + 2].upper() for at in range(0, len(text) - 1, 2)][:MOST_PAIRS]
    if not pairs:
        raise ValueError(f'"{text}" is no locator: it has fewer than two characters')
    east = north = 0.0
    side_deg = 180.0
    for pair, base in zip(pairs, _BASES, strict=False):
        side_deg /= base
        east += _value(pair[0], base) * side_deg
        north += _value(pair[1], base) * side_deg
    return (east + side_deg / 2) * 2 - 180, north + side_deg / 2 - 90


def from_dms(degrees: float, minutes: float, seconds: float, *, south_or_west: bool) -> float:
    """Decimal degrees; the signs of the parts do not count."""
    decimal_deg = abs(degrees) + abs(minutes) / 60 + abs(seconds) / 3600
    return -decimal_deg if south_or_west else decimal_deg


def to_dms(decimal_deg: float) -> tuple[int, int, float, bool]:
    """Degrees, minutes, seconds, and whether it is south or west; within half a turn, rounded to 1e-6 seconds."""
    turned_deg = _within_half_a_turn(decimal_deg)
    degrees, rest_s = divmod(round(abs(turned_deg) * 3600, 6), 3600)
    minutes, seconds = divmod(rest_s, 60)
    return int(degrees), int(minutes), seconds, -180 < turned_deg < 0


def to_dmm(decimal_deg: float) -> tuple[int, float, bool]:
    """Degrees, decimal minutes, and whether it is south or west."""
    turned_deg = _within_half_a_turn(decimal_deg)
    degrees, minutes = divmod(round(abs(turned_deg) * 60, 6), 60)
    return int(degrees), minutes, -180 < turned_deg < 0


def distance_and_bearing(from_deg: tuple[float, float], to_deg: tuple[float, float]) -> tuple[float, float]:
    """The short way between two places (longitude, latitude): km, and the whole degrees to point the antenna to.

    Raises ValueError for coordinates off the earth. Where every bearing is right (same place, antipodes) it is 0.
    """
    for longitude_deg, latitude_deg in (from_deg, to_deg):
        if abs(longitude_deg) > 180 or abs(latitude_deg) > 90:
            raise ValueError(f"longitude {longitude_deg:g}, latitude {latitude_deg:g} is no place on the earth")
    lon_a, lat_a, lon_b, lat_b = map(math.radians, (*from_deg, *to_deg))
    turn = lon_b - lon_a
    eastward = math.cos(lat_b) * math.sin(turn)
    northward = math.cos(lat_a) * math.sin(lat_b) - math.sin(lat_a) * math.cos(lat_b) * math.cos(turn)
    along = math.sin(lat_a) * math.sin(lat_b) + math.cos(lat_a) * math.cos(lat_b) * math.cos(turn)
    arc_deg = math.degrees(math.atan2(math.hypot(eastward, northward), along))
    if not _COINCIDENT_DEG < arc_deg < 180 - _COINCIDENT_DEG:
        return arc_deg * KM_PER_DEG, 0.0
    return arc_deg * KM_PER_DEG, float(math.floor(math.degrees(math.atan2(eastward, northward)) % 360 + 0.5))


def long_path_bearing(short_path_deg: float) -> float:
    """The other way round the earth. Raises ValueError outside 0 to 360."""
    if not 0 <= short_path_deg <= 360:
        raise ValueError(f"{short_path_deg:g} is no bearing from 0 to 360")
    return (short_path_deg + 180) % 360


def long_path_km(short_path_km: float) -> float:
    """The distance the other way round the earth."""
    return 360 * KM_PER_DEG - short_path_km


def _within_half_a_turn(angle_deg: float) -> float:
    return (angle_deg + 180) % 360 - 180


def _character(value: int, base: int) -> str:
    return str(value) if base == 10 else chr(ord("A") + value)


def _value(character: str, base: int) -> int:
    value = ord(character) - ord("0" if base == 10 else "A")
    if not 0 <= value < base:
        raise ValueError(f'"{character}" cannot stand there in a locator')
    return value
