"""One pass of the ISS over each continent, for a demonstration: always the same one, without network, clock and place.

Knows a set of elements of the ISS, a pass over the middle of each continent, and which continent a time zone belongs
to. Does not know the rotor that flies it.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.satellite import Satellite

MARK = ", demo"
"""Stands in the name of a demo pass, and of no other target."""
FAST = 10
"""So many times as fast as life a demo pass may be. An ordinary rotor can follow these passes then: none is high."""
ROW_S = 10.0
"""Seconds of life between two rows. A curve is laid between them."""
_ISS = Elements(
    "ISS",
    25544,
    epoch_utc_s=1_740_747_588.2,  # 28 February 2025
    mean_motion_rev_per_day=15.495972,
    eccentricity=0.0006135,
    inclination_deg=51.6353,
    ascending_node_deg=125.1519,
    perigee_argument_deg=326.8326,
    mean_anomaly_deg=33.2278,
    drag_per_earth_radius=0.00040176,
    mean_motion_dot=0.00022226,
)


@dataclass(frozen=True, slots=True)
class DemoPass:
    """A pass over one place. `begin_s`: its rise, after the epoch of the elements; `lasts_s`: until it sets."""

    over: str
    site: Site
    begin_s: float
    lasts_s: float

    def named(self, times: int) -> str:
        """The name of its flight, this many times as fast as life."""
        return f"ISS over {self.over}{MARK}{f' {times}×' if times > 1 else ''}"

    def rows(self, times: int) -> tuple[tuple[float, float, float], ...]:
        """The directions: seconds from the rise as it is flown, azimuth, elevation."""
        seen = Satellite(_ISS, self.site)
        moments_s = [ROW_S * at for at in range(int(self.lasts_s / ROW_S))] + [self.lasts_s]
        sights = [(at_s / times, seen.sight(_ISS.epoch_utc_s + self.begin_s + at_s)) for at_s in moments_s]
        return tuple((at_s, sight.azimuth_deg, sight.elevation_deg) for at_s, sight in sights)


PASSES = {
    "Europe": DemoPass("Europe", Site(50, 10), 123_226, 600),
    "North America": DemoPass("North America", Site(40, -95), 145_303, 626),
    "South America": DemoPass("South America", Site(-15, -55), 38_301, 604),
    "Africa": DemoPass("Africa", Site(5, 20), 194_723, 603),
    "Asia": DemoPass("Asia", Site(30, 100), 11_363, 622),
    "Australia": DemoPass("Australia", Site(-25, 134), 166_433, 612),
}
_ZONES = {"america": "North America", "us": "North America", "canada": "North America", "africa": "Africa"} | {
    "asia": "Asia", "indian": "Asia", "australia": "Australia", "pacific": "Australia"
}  # fmt: skip
_IN_SOUTH_AMERICA = (
    *("araguaina", "argentina", "asuncion", "bahia", "belem", "boa_vista", "bogota", "buenos_aires", "campo_grande"),
    *("caracas", "cayenne", "cuiaba", "fortaleza", "guayaquil", "guyana", "la_paz", "lima", "maceio", "manaus"),
    *("montevideo", "paramaribo", "porto_velho", "punta_arenas", "recife", "santarem", "santiago", "sao_paulo"),
)


def demo_pass(zone: str) -> DemoPass:
    """The pass over the continent of this time zone, such as `Europe/Prague`; one that is not known: over Europe."""
    area, _, place = zone.casefold().partition("/")
    south = area == "america" and place.startswith(_IN_SOUTH_AMERICA)
    return PASSES["South America" if south else _ZONES.get(area, "Europe")]
