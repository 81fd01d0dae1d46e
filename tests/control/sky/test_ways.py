"""The way through a whole pass: no unwinding where the range holds it, and the best moment for it where it does not."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.angles import turn_deg
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import LOST_DEG, STEP_S, Speeds
from rotator.control.sky.ways import EVEN_S, Route, best_route
from rotator.rehearsal.passes import SHIPPED, read_pass
from tests.tables import every_row

G5500 = Speeds(6.0, 2.7)
FULL = Mount(Range(0, 450), Range(0, 180))
SINGLE = Mount(Range(0, 360), Range(0, 90))
OVER = Mount(Range(0, 360), Range(0, 180), flip=True)
NORTH = ("north-1-iss", "north-2-so-50", "north-3-rs-44")
EVERY = sorted(path.stem for path in SHIPPED.glob("*.csv"))


def path_of(name: str, *, mirrored: bool = False) -> KnownPath:
    rows = read_pass(SHIPPED / f"{name}.csv").rows
    return KnownPath(tuple((t_s, -az_deg % 360 if mirrored else az_deg, el_deg) for t_s, az_deg, el_deg in rows))


def routed(mount: Mount, path: KnownPath, from_deg: tuple[float, float] = (0.0, 0.0), early_s: float = 120.0) -> Route:
    return best_route(mount, path.directions(path.begin_s, STEP_S), from_deg, early_s, G5500)


def fits(path: KnownPath) -> bool:
    """Whether one turn of 450° holds the whole pass."""
    azimuth_deg, turned_deg = path.rows[0][1], [0.0]
    for _, each_deg, _ in path.rows:
        turned_deg.append(turned_deg[-1] + turn_deg(azimuth_deg, each_deg))
        azimuth_deg = each_deg
    low_deg, high_deg = path.rows[0][1] + min(turned_deg), path.rows[0][1] + max(turned_deg)
    return any(low_deg + turn >= 0 and high_deg + turn <= 450 for turn in (-360, 0, 360))


@pytest.mark.long
@every_row("mirrored", [False, True])
@every_row("name", EVERY)
def test_no_pass_is_unwound_that_fits_into_450_degrees(name: str, mirrored: bool) -> None:
    path = path_of(name, mirrored=mirrored)
    route = routed(FULL, path)
    if fits(path):
        assert (len(route.legs), route.lost_s) == (1, pytest.approx(0.0, abs=0.5))
    else:
        assert name in NORTH
        assert route.lost_s < 62


@pytest.mark.long
@every_row("mirrored", [False, True])
@every_row("name", NORTH)
def test_over_the_top_no_pass_through_north_is_unwound(name: str, mirrored: bool) -> None:
    route = routed(OVER, path_of(name, mirrored=mirrored))
    assert [leg.flown.way.flipped for leg in route.legs] == [True]
    assert route.lost_s == pytest.approx(0.0, abs=0.5)


@pytest.mark.parametrize("name", NORTH[:2])
def test_an_unwind_takes_one_turn_and_its_seconds_count_as_lost(name: str) -> None:
    """A turn takes 60 s at 6°/s; before and after it the antenna waits at an end of its range."""
    route = routed(SINGLE, path_of(name))
    assert len(route.legs) == 2
    assert 30 < route.lost_s < 62


SPEEDS = st.builds(Speeds, st.floats(0.5, 60), st.floats(0.5, 60))
RANGES = st.tuples(st.floats(-180, 360), st.floats(10, 540)).map(lambda ends: Range(ends[0], ends[0] + ends[1]))
MOUNTS = st.builds(
    lambda azimuth, high_deg, flip: Mount(azimuth, Range(0, high_deg), flip=flip),
    RANGES,
    st.sampled_from([90.0, 180.0]),
    st.booleans(),
)
WANDERING = st.lists(
    st.tuples(st.sampled_from([0.0, 90.0, 180.0, 270.0, 359.0]) | st.floats(0, 359), st.floats(-10, 90)),
    min_size=2,
    max_size=40,
)


@given(mount=MOUNTS, directions=WANDERING, speeds=SPEEDS, from_deg=st.tuples(st.floats(0, 360), st.floats(0, 90)))
def test_a_route_comes_to_an_end_for_any_path_of_the_target(
    mount: Mount, directions: list[tuple[float, float]], speeds: Speeds, from_deg: tuple[float, float]
) -> None:
    """Also where two ways wait at the same limit, and a change between them takes no time."""
    route = best_route(mount, directions, from_deg, 10.0, speeds)
    arrivals = [0, *(leg.arrival for leg in route.legs[1:])]
    assert all(before <= leg.look < leg.arrival for before, leg in zip(arrivals, route.legs[1:], strict=False))
    assert 0 <= route.lost_s <= STEP_S * (len(directions) + 1e-6)


def test_it_unwinds_while_the_target_is_behind_trees() -> None:
    """From 300° through north to 60°, a minute of it behind a wood at 350° to 10°: there the turn costs nothing."""
    wood = Mount(Range(0, 360), Range(0, 90), horizon=((0.0, 40.0), (12.0, 0.0), (348.0, 0.0), (350.0, 40.0)))
    path = KnownPath(tuple((10.0 * step, (300 + step * 2.0) % 360, 20.0) for step in range(61)))
    seen, hidden = routed(SINGLE, path), routed(wood, path)
    assert hidden.lost_s < seen.lost_s / 4
    assert 0 < STEP_S * (hidden.legs[1].look - 45) < 60


def test_it_unwinds_around_the_culmination_of_a_pass_that_crosses_north_high_up() -> None:
    """From the west to the east by 82° in the north: there a turn right round leads the antenna 16° away at most."""
    rows = []
    for step in range(121):
        along, tilt = math.radians(1.5 * step), math.radians(82.0)
        east, north, up = -math.cos(along), math.sin(along) * math.cos(tilt), math.sin(along) * math.sin(tilt)
        rows.append((5.0 * step, math.degrees(math.atan2(east, north)) % 360, math.degrees(math.asin(min(1.0, up)))))
    route = routed(SINGLE, KnownPath(tuple(rows)))
    (_, turn) = route.legs
    assert turn.look < 60 < turn.arrival
    assert route.lost_s < 40


def test_a_pass_that_ends_just_beyond_north_is_not_unwound() -> None:
    """The last 20 s are lost by a few degrees: less than a turn would cost."""
    path = KnownPath(tuple((10.0 * step, (300 + step * 1.0) % 360, 20.0) for step in range(66)))
    assert len(routed(SINGLE, path).legs) == 1


def test_a_pass_that_crosses_north_by_less_than_ten_degrees_loses_nothing_at_the_stop() -> None:
    route = routed(SINGLE, path_of("north-3-rs-44"))
    assert (len(route.legs), route.lost_s) == (1, 0.0)


@given(
    beyond_deg=st.floats(0.5, 25.0),
    rate_dps=st.floats(0.05, 0.6),
    elevation_deg=st.floats(0.0, 30.0),
    comes_back=st.booleans(),
    mount=st.sampled_from((SINGLE, Mount(Range(0, 450), Range(0, 90)))),
)
def test_at_the_stop_it_loses_the_seconds_beyond_ten_degrees_or_a_turn_if_that_is_less(
    beyond_deg: float, rate_dps: float, elevation_deg: float, comes_back: bool, mount: Mount
) -> None:
    """From 150° to a little beyond north, where the rotor has its stop; perhaps back again."""
    count = int((150.0 + beyond_deg) / rate_dps / STEP_S) + 1
    azimuths_deg = [150.0 - rate_dps * STEP_S * step for step in range(count)]
    azimuths_deg += reversed(azimuths_deg) if comes_back else ()
    path = KnownPath(tuple((STEP_S * at, deg % 360, elevation_deg) for at, deg in enumerate(azimuths_deg)))
    route = routed(mount, path, from_deg=(150.0, elevation_deg))
    off_deg = [-deg * math.cos(math.radians(elevation_deg)) for deg in azimuths_deg]
    standing_s = STEP_S * sum(deg > LOST_DEG for deg in off_deg)
    assert route.lost_s <= standing_s
    if standing_s < 45.0:  # a turn right round costs 60 s, and no flip is allowed
        assert len(route.legs) == 1


@pytest.mark.parametrize(("early_s", "begins_deg"), [(120.0, 20.0), (0.0, 380.0)])
def test_an_antenna_in_the_overlap_stays_there_when_there_is_no_time_to_unwind(
    early_s: float, begins_deg: float
) -> None:
    """From 20° to 97° on a rotor of 450°: only the first turn holds all of it."""
    path = KnownPath(tuple((10.0 * step, 20.0 + step, 30.0) for step in range(78)))
    route = routed(FULL, path, from_deg=(380.0, 30.0), early_s=early_s)
    assert route.legs[0].flown.way.azimuth_deg == begins_deg


SATELLITES = st.builds(
    lambda begin_deg, rate_dps, seconds, high_deg: KnownPath(
        tuple(
            (
                5.0 * step,
                (begin_deg + rate_dps * 5.0 * step) % 360,
                high_deg * 4 * (step / seconds) * (1 - step / seconds),
            )
            for step in range(seconds + 1)
        )
    ),
    st.floats(0, 359),
    st.floats(-1.5, 1.5),
    st.integers(20, 120),
    st.floats(5, 80),
)


@pytest.mark.long
@given(path=SATELLITES, from_deg=st.tuples(st.floats(0, 360), st.floats(0, 90)), early_s=st.floats(0, 300))
def test_no_way_loses_more_than_staying_on_the_one_it_begins_with(
    path: KnownPath, from_deg: tuple[float, float], early_s: float
) -> None:
    for mount in (FULL, SINGLE, OVER):
        route = routed(mount, path, from_deg, early_s)
        flown = route.legs[0].flown
        # It arrives at the first look at which the motors have had the time to come to the moving target.
        arrived_s = next(
            STEP_S * look
            for look, place_deg in enumerate(zip(flown.azimuths_deg, flown.elevations_deg, strict=True))
            if abs(place_deg[0] - from_deg[0]) <= G5500.azimuth_dps * STEP_S * look
            and abs(place_deg[1] - from_deg[1]) <= G5500.elevation_dps * STEP_S * look
        )
        assert route.lost_s <= flown.lost_s[-1] + arrived_s + 2 * EVEN_S
        looks = [leg.look for leg in route.legs]
        assert looks == sorted(set(looks))
