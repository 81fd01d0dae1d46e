"""A simulated mount that stands askew, and a box that knows it, or does not."""

from __future__ import annotations

from typing import Any

import pytest

from firmware_sim.clock import SimClock
from rotator.config.model import Config
from rotator.control.sky.angles import great_circle_deg
from rotator.exchange.orders import Park
from rotator.exchange.sources import Source
from rotator.rehearsal.plants import BoxPlant

ASKEW = {"ia_deg": 4, "ie_deg": -3, "an_deg": 3, "aw_deg": -2, "ca_deg": 2, "npae_deg": -1.5}
EXACT = {"rotor": {"type": "moteus"}, "elevation": {"min_deg": -10, "max_deg": 180}}


def flown_to(azimuth_deg: float, elevation_deg: float, **mount: Any) -> BoxPlant:
    clock = SimClock()
    config = Config.model_validate({**EXACT, "sim": {"mount": ASKEW}, "mount": mount})
    box = BoxPlant(config, clock, (0.0, 0.0), "rotctld")
    box.run_until(clock() + 2.0)
    box.order(azimuth_deg, elevation_deg)
    box.run_until(clock() + 40.0)
    return box


@pytest.mark.long
@pytest.mark.parametrize("order", [(100.0, 30.0), (2.0, 10.0), (358.0, 60.0), (200.0, 150.0)])
def test_the_boom_points_where_it_is_ordered_and_the_program_is_told_so(order: tuple[float, float]) -> None:
    box = flown_to(*order, model=ASKEW)
    assert great_circle_deg(*box.pointing()[:2], *order) < 0.1
    status = box.status
    assert status.azimuth.points_deg is not None
    assert status.elevation.points_deg is not None
    assert great_circle_deg(status.azimuth.points_deg, status.elevation.points_deg, *order) < 0.1
    assert (status.elevation.points_deg > 90) is (order[1] > 90)


def test_without_its_model_the_boom_is_as_far_off_as_the_mount() -> None:
    assert great_circle_deg(*flown_to(100.0, 30.0).pointing()[:2], 100.0, 30.0) > 2.0


@pytest.mark.long
def test_park_is_a_place_of_the_axes() -> None:
    box = flown_to(100.0, 30.0, model=ASKEW, park_azimuth_deg=50, park_elevation_deg=20)
    box.post(Source("console"), Park())
    box.run_until(80.0)
    angles = box.status.azimuth.angle_deg, box.status.elevation.angle_deg
    assert angles == pytest.approx((50, 20), abs=0.2)
