"""Two entries on one orbit: the station is named, not the ship that is docked to it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rotator.orbits.earth import Site
from rotator.orbits.element_files import parse
from rotator.orbits.elements import Elements
from rotator.orbits.satellite import Satellite
from rotator.orbits.twins import one_of_each
from tests.orbits.skyfield_oracle import TLE

BERLIN = Site(52.52, 13.4, 40.0)
ALL = [each for each in parse(TLE.read_text(encoding="utf-8")) if isinstance(each, Elements)]
(ISS,) = [each for each in ALL if each.name == "ISS"]


def names(*others: Elements) -> list[str]:
    return [each.name for each in one_of_each(Satellite(each, BERLIN) for each in (*others, *ALL))]


def test_satellites_of_their_own_all_stay() -> None:
    assert one_of_each([]) == []
    assert names() == ["RS-44", "SO-50", "ISS"]


def test_of_a_station_and_its_ships_the_lowest_number_stays() -> None:
    ships = [replace(ISS, name=f"SHIP {number}", catalogue_number=60_000 + number) for number in range(3)]
    assert names(*ships) == ["RS-44", "SO-50", "ISS"]


def test_elements_of_another_hour_are_the_same_orbit() -> None:
    """As they are published: a revolution later, the node and the perigee have moved on."""
    turn_s = 86_400.0 / ISS.mean_motion_rev_per_day
    later = replace(
        ISS,
        name="SHIP",
        catalogue_number=60_000,
        epoch_utc_s=ISS.epoch_utc_s + turn_s,
        ascending_node_deg=ISS.ascending_node_deg - 0.3207,
        perigee_argument_deg=ISS.perigee_argument_deg + 0.2391,
        mean_anomaly_deg=ISS.mean_anomaly_deg,
    )
    assert "SHIP" not in names(later)


@pytest.mark.parametrize("ahead_deg", [0.2, 1.0, 180.0, -0.5])
def test_a_ship_on_its_way_is_another(ahead_deg: float) -> None:
    """0.2° on this orbit are 24 km."""
    anomaly_deg = (ISS.mean_anomaly_deg + ahead_deg) % 360.0
    ship = replace(ISS, name="SHIP", catalogue_number=60_000, mean_anomaly_deg=anomaly_deg)
    assert "SHIP" in names(ship)


def test_one_that_crosses_the_orbit_is_another() -> None:
    crossing = replace(ISS, name="SHIP", catalogue_number=60_000, ascending_node_deg=ISS.ascending_node_deg + 0.5)
    assert "SHIP" in names(crossing)


def test_a_crowd_on_one_orbit_is_compared_with_the_station_alone() -> None:
    """Each with each, ten thousand would take an hour."""
    crowd = [replace(ISS, name=f"PART {number}", catalogue_number=60_000 + number) for number in range(10_000)]
    assert names(*crowd) == ["RS-44", "SO-50", "ISS"]
