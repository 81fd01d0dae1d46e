"""Rises and sets: at each the true elevation is zero, none is missed, and a target that never sets has no set."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits.celestial import Body
from rotator.orbits.earth import Site
from rotator.orbits.moments import DAY_S
from rotator.orbits.passes import EXACT_S, passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Sight
from tests.orbits import skyfield_oracle
from tests.orbits.test_satellite import FLYING, PARIS

PROMISED_S = 0.2
SITES = st.builds(Site, st.floats(-85, 85), st.floats(-180, 180), st.floats(0, 4000))


@given(name=st.sampled_from(sorted(FLYING)), site=SITES, days=st.floats(-3, 20))
def test_skyfield_sees_the_horizon_within_two_tenths_of_a_second(name: str, site: Site, days: float) -> None:
    from_s = FLYING[name].epoch_utc_s + days * DAY_S
    for each in passes(Satellite(FLYING[name], site), from_s, from_s + 3 * 3600):
        for at_s in (each.aos_s, each.los_s):
            assert at_s is not None
            early, late = (skyfield_oracle.of_satellite(name, site, at_s + off) for off in (-PROMISED_S, PROMISED_S))
            assert early.elevation_deg * late.elevation_deg <= 0
        top = skyfield_oracle.of_satellite(name, site, each.tca_s)
        assert top.elevation_deg == pytest.approx(each.highest.elevation_deg, abs=0.01)


@given(name=st.sampled_from(sorted(FLYING)), site=SITES, hours=st.floats(0, 48))
def test_no_moment_above_the_horizon_is_outside_a_pass(name: str, site: Site, hours: float) -> None:
    satellite = Satellite(FLYING[name], site)
    from_s = FLYING[name].epoch_utc_s + 3600 * hours
    found = list(passes(satellite, from_s, from_s + 4 * 3600))
    for second in range(0, 4 * 3600, 11):
        at_s = from_s + second
        up = any((each.aos_s or -math.inf) <= at_s <= (each.los_s or math.inf) for each in found)
        assert up is (satellite.sight(at_s).elevation_deg > 0)


@dataclass(frozen=True)
class Swinging:
    """A target whose elevation swings: the highest is `top_deg`, once a period."""

    period_s: float
    top_deg: float
    shift_s: float = 0.0
    name: str = "swinging"

    def sight(self, utc_s: float) -> Sight:
        swing = math.cos(math.tau * (utc_s - self.shift_s) / self.period_s)
        return Sight(90.0, self.top_deg - 40.0 * (1 - swing), 1000.0)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


@given(top_deg=st.floats(1e-4, 0.05), shift_s=st.floats(100, 5300))
def test_a_pass_of_a_few_seconds_is_found(top_deg: float, shift_s: float) -> None:
    grazing = Swinging(5400.0, top_deg, shift_s)
    assert len(list(passes(grazing, 0.0, 5400.0))) == 1


@given(top_deg=st.floats(-1, 30), shift_s=st.floats(0, 5400))
def test_passes_are_as_many_as_the_geometry_has(top_deg: float, shift_s: float) -> None:
    half_s = math.acos(max(-1.0, 1 - max(0.0, top_deg) / 40)) / math.tau * 5400.0
    for each in passes(Swinging(5400.0, top_deg, shift_s), 0.0, 40_000.0):
        assert each.aos_s is not None
        assert each.los_s is not None
        assert each.los_s - each.aos_s == pytest.approx(2 * half_s, abs=0.05)
        assert each.highest.elevation_deg == pytest.approx(top_deg, abs=1e-3)


def test_a_pass_that_is_on_is_given_with_its_whole_length() -> None:
    whole = list(passes(Satellite(FLYING["ISS"], PARIS), FLYING["ISS"].epoch_utc_s, FLYING["ISS"].epoch_utc_s + DAY_S))
    first = whole[0]
    assert first.los_s is not None
    (again,) = list(passes(Satellite(FLYING["ISS"], PARIS), first.tca_s, first.los_s))
    assert again.aos_s == pytest.approx(first.aos_s, abs=0.05)
    assert again.los_s == pytest.approx(first.los_s, abs=0.05)


def test_a_geostationary_satellite_neither_rises_nor_sets() -> None:
    still = replace(
        FLYING["ISS"],
        mean_motion_rev_per_day=1.0027,
        eccentricity=0.0001,
        inclination_deg=0.01,
        drag_per_earth_radius=0.0,
        mean_motion_dot=0.0,
    )
    for mean_anomaly_deg in range(0, 360, 30):
        satellite = Satellite(replace(still, mean_anomaly_deg=float(mean_anomaly_deg)), PARIS)
        found = list(passes(satellite, still.epoch_utc_s, still.epoch_utc_s + DAY_S))
        up = satellite.sight(still.epoch_utc_s).elevation_deg > 0
        assert [(each.aos_s, each.los_s, each.aos) for each in found] == ([(None, None, None)] if up else [])


def test_the_polar_sun_stays_for_half_a_year() -> None:
    june_s, december_s = 1_782_000_000.0, 1_797_800_000.0
    (midsummer,) = passes(Body("sun", Site(89.0, 0.0)), june_s, june_s + DAY_S)
    assert (midsummer.aos_s, midsummer.los_s) == (None, None)
    assert midsummer.highest.elevation_deg == pytest.approx(24.4, abs=0.1)
    assert list(passes(Body("sun", Site(89.0, 0.0)), december_s, december_s + DAY_S)) == []


@dataclass(frozen=True)
class Falling(Swinging):
    fell_s: float = 0.0

    def sight(self, utc_s: float) -> Sight:
        if utc_s >= self.fell_s:
            raise NotThere(f"{self.name} has decayed")
        return super().sight(utc_s)


@given(fell_s=st.floats(-900, 900))
def test_the_last_pass_of_a_satellite_ends_as_it_comes_down(fell_s: float) -> None:
    (last,) = passes(Falling(5400.0, 30.0, fell_s=fell_s), -2000.0, 2000.0)
    assert last.los_s == pytest.approx(fell_s, abs=EXACT_S)
    assert last.tca_s == pytest.approx(min(fell_s, 0.0), abs=2.0)


def test_low_passes_can_be_left_out() -> None:
    satellite, from_s = Satellite(FLYING["SO-50"], PARIS), FLYING["SO-50"].epoch_utc_s
    every = list(passes(satellite, from_s, from_s + DAY_S))
    high = list(passes(satellite, from_s, from_s + DAY_S, least_deg=30.0))
    assert high == [each for each in every if each.highest.elevation_deg >= 30.0]
    assert 0 < len(high) < len(every)
