"""The commands of rotctld that need no rotor: locators, degrees and distances.

Knows their arguments and the labels of their answers. Does not know the calculation (`locator` does), nor the box.
"""

from __future__ import annotations

from rotator.orbits import locator
from rotator.protocols.rotctld import INVALID_PARAMETER, Answer, BadRequest, Request, number, whole_number

NAMES = frozenset((
    *("lonlat2loc", "loc2lonlat", "dms2dec", "dec2dms", "dmmm2dec"),
    *("dec2dmmm", "qrb", "a_sp2a_lp", "d_sp2d_lp"),
))  # fmt: skip


def answer(request: Request) -> Answer:
    """The answer to one of NAMES. Raises BadRequest."""
    try:
        return Answer(records=_records(request))
    except BadRequest:
        raise
    except ValueError as fault:
        raise BadRequest(INVALID_PARAMETER) from fault


def _records(request: Request) -> tuple[tuple[str, str], ...]:
    words = request.arguments
    match request.name:
        case "lonlat2loc":
            pairs = min(whole_number(words[2]) // 2, locator.MOST_PAIRS)
            if pairs < 1:
                raise BadRequest(INVALID_PARAMETER)
            return (("Locator", locator.to_locator(number(words[0]), number(words[1]), pairs)),)
        case "loc2lonlat":
            longitude_deg, latitude_deg = locator.from_locator(words[0])
            return (("Longitude", _six(longitude_deg)), ("Latitude", _six(latitude_deg)))
        case "dms2dec":
            degrees, minutes, seconds = whole_number(words[0]), whole_number(words[1]), number(words[2])
            decimal_deg = locator.from_dms(degrees, minutes, seconds, south_or_west=whole_number(words[3]) == 1)
            return (("Dec Degrees", _six(decimal_deg)),)
        case "dec2dms":
            degrees, minutes, seconds, is_negative = locator.to_dms(number(words[0]))
            parts = (("Degrees", f"{degrees}"), ("Minutes", f"{minutes}"), ("Seconds", _six(seconds)))
            return (*parts, ("S/W", f"{is_negative:d}"))
        case "dmmm2dec":
            degrees, decimal_minutes = whole_number(words[0]), number(words[1])
            decimal_deg = locator.from_dms(degrees, decimal_minutes, 0, south_or_west=whole_number(words[2]) == 1)
            return (("Dec Deg", _six(decimal_deg)),)
        case "dec2dmmm":
            degrees, decimal_minutes, is_negative = locator.to_dmm(number(words[0]))
            return (("Degrees", f"{degrees}"), ("Dec Minutes", _six(decimal_minutes)), ("S/W", f"{is_negative:d}"))
        case "qrb":
            lon_a, lat_a, lon_b, lat_b = map(number, words)
            km, bearing_deg = locator.distance_and_bearing((lon_a, lat_a), (lon_b, lat_b))
            return (("QRB Distance", _six(km)), ("QRB Azimuth", _six(bearing_deg)))
        case "a_sp2a_lp":
            return (("Long Path Deg", _six(locator.long_path_bearing(number(words[0])))),)
        case _:
            return (("Long Path km", _six(locator.long_path_km(number(words[0])))),)


def _six(value: float) -> str:
    return f"{value:.6f}"
