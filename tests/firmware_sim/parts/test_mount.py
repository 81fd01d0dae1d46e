"""The simulated mount stands askew in the same way as the box's model says; the two share no code."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from firmware_sim.parts.mount import MountSpec
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.pointing_model import PointingModel

TERMS = ("ia_deg", "ie_deg", "an_deg", "aw_deg", "ca_deg", "npae_deg")
terms = st.fixed_dictionaries({term: st.floats(-10, 10) for term in TERMS})


@given(terms, st.floats(-90, 540), st.floats(-10, 190))
def test_the_box_knows_where_the_simulated_boom_points(
    askew: dict[str, float], azimuth_deg: float, elevation_deg: float
) -> None:
    truth = MountSpec(**askew).direction(azimuth_deg, elevation_deg)
    assert great_circle_deg(*PointingModel(**askew).pointed(azimuth_deg, elevation_deg), *truth) < 1e-6
