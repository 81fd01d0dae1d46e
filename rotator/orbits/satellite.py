"""A satellite in the sky of a station: its elements propagated by sgp4, turned with the earth, seen from the ground.

Knows the frame of SGP4 (TEME), how far the earth has turned, and how elements grow old. Does not know where they came
from.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from typing import TYPE_CHECKING

from rotator.orbits.earth import Horizon, Site
from rotator.orbits.elements import Elements
from rotator.orbits.moments import DAY_S, J2000_S
from rotator.orbits.refraction import through_air
from rotator.orbits.sight import NotThere, Sight

if TYPE_CHECKING:
    from sgp4.api import Satrec

_SGP4_EPOCH_UTC_S = -631_238_400.0
"""31 December 1949, from which sgp4 counts days, in seconds since 1970."""
_OF_NO_NUMBER = 1
"""A number in place of the real one: sgp4 allows only five characters, and computes nothing from them."""
_EARTH_GM_KM3_S2 = 398_600.8
"""As in WGS 72, which SGP4 is made for."""

UT1_MINUS_UTC = ((2024, 0.0), (2025, 0.04), (2026, 0.06), (2028, 0.13), (2030, 0.13), (2032, 0.1), (2034, 0.03))
"""Years, and seconds by which the earth's rotation is ahead of the clocks: measured; from 2026 on predicted by the IERS
and by long-term curves. A tenth of a second is 0.005° for a satellite 500 km overhead."""
_YEAR_S = 365.25 * DAY_S

ALONG_KM_FRESH = 0.7
ALONG_KM_A_DAY = 0.8
DRAG_UNCERTAIN = 0.2
"""Error of an element set along the orbit: at its epoch, its growth each day, and its share of the effect of drag."""


class Satellite:
    """Raises NotThere when sgp4 refuses the elements."""

    def __init__(self, elements: Elements, site: Site) -> None:
        self.elements = elements
        self._site, self._horizon = site, Horizon(site)
        self._record = _record(elements)
        revolutions = elements.mean_motion_rev_per_day
        self._axis_km: float = (_EARTH_GM_KM3_S2 * (DAY_S / revolutions / math.tau) ** 2) ** (1 / 3)
        self._speed_km_s = math.sqrt(_EARTH_GM_KM3_S2 / self._axis_km)

    @property
    def name(self) -> str:
        return self.elements.name

    @property
    def period_s(self) -> float:
        """Seconds of one revolution."""
        return DAY_S / self.elements.mean_motion_rev_per_day

    def sight(self, utc_s: float) -> Sight:
        error, place_km, _ = self._record.sgp4_tsince((utc_s - self.elements.epoch_utc_s) / 60.0)
        if error or not all(map(math.isfinite, place_km)):
            raise _refused(self.name, error)
        turned = _earth_turned_rad(utc_s)
        x, y, z = place_km
        cos, sin = math.cos(turned), math.sin(turned)
        seen = self._horizon.sight(((x * cos + y * sin) * 1000, (y * cos - x * sin) * 1000, z * 1000))
        return through_air(seen, self._site)

    def late_s(self, utc_s: float) -> float:
        days = self.elements.age_days(utc_s)
        # Half the derivative times the time squared: the revolutions that drag has added since the epoch.
        dragged_km = abs(self.elements.mean_motion_dot) * days * days * math.tau * self._axis_km
        along_km = ALONG_KM_FRESH + ALONG_KM_A_DAY * days + DRAG_UNCERTAIN * dragged_km
        return along_km / self._speed_km_s


def _record(elements: Elements) -> Satrec:
    from sgp4.api import WGS72, Satrec  # noqa: PLC0415 - a box without satellites does without it

    record = Satrec()
    per_day_in_rad_min = math.tau / 1440.0
    record.sgp4init(
        WGS72,
        "i",
        _OF_NO_NUMBER,
        (elements.epoch_utc_s - _SGP4_EPOCH_UTC_S) / DAY_S,
        elements.drag_per_earth_radius,
        elements.mean_motion_dot * per_day_in_rad_min / 1440.0,
        elements.mean_motion_ddot * per_day_in_rad_min / 1440.0**2,
        elements.eccentricity,
        math.radians(elements.perigee_argument_deg),
        math.radians(elements.inclination_deg),
        math.radians(elements.mean_anomaly_deg),
        elements.mean_motion_rev_per_day * per_day_in_rad_min,
        math.radians(elements.ascending_node_deg),
    )
    if record.error:
        raise _refused(elements.name, record.error)
    return record


def _refused(name: str, error: int) -> NotThere:
    from sgp4.api import SGP4_ERRORS  # noqa: PLC0415 - only a refusal needs them

    return NotThere(f"{name}: {SGP4_ERRORS.get(error, 'its elements give no place')}")


def _earth_turned_rad(utc_s: float) -> float:
    """Greenwich mean sidereal time of 1982, the angle between TEME and the earth (Vallado 2006, equation C-5)."""
    ut1_s = utc_s + _ut1_minus_utc_s(utc_s)
    centuries = (ut1_s - J2000_S) / DAY_S / 36_525.0
    sidereal_s = 67_310.54841 + centuries * (
        876_600 * 3600 + 8_640_184.812866 + centuries * (0.093104 - 6.2e-6 * centuries)
    )
    return math.radians(sidereal_s % DAY_S / 240.0)


def _ut1_minus_utc_s(utc_s: float) -> float:
    year = 2000.0 + (utc_s - J2000_S) / _YEAR_S
    at = bisect_right(UT1_MINUS_UTC, year, key=lambda point: point[0])
    if at in (0, len(UT1_MINUS_UTC)):
        return UT1_MINUS_UTC[min(at, len(UT1_MINUS_UTC) - 1)][1]
    (year_a, a_s), (year_b, b_s) = UT1_MINUS_UTC[at - 1], UT1_MINUS_UTC[at]
    return a_s + (year - year_a) / (year_b - year_a) * (b_s - a_s)
