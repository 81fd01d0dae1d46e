"""Where a switched axis stands next on its way behind a target that moves: price of a start against pointing error."""

from __future__ import annotations

import pytest

from rotator.control.sky.plan import OFFSETS_S, PRICE, Path, next_place_deg

EVEN = (1.0,) * len(OFFSETS_S)


def steady(rate_dps: float, from_deg: float = 100.0, weights: tuple[float, ...] = EVEN) -> Path:
    return Path(500.0, [from_deg + rate_dps * offset_s for offset_s in OFFSETS_S], weights)


def test_a_path_is_looked_at_for_a_minute() -> None:
    assert OFFSETS_S[0] == 0.0
    assert OFFSETS_S[19:22] == (9.5, 10.0, 12.0)
    assert OFFSETS_S[-1] == 60.0


@pytest.mark.parametrize("after_s", [0.0, 0.25, 0.5, 9.4, 9.5, 9.9, 10.0, 11.0, 33.3, 59.0, 60.0])
def test_between_the_looks_it_is_a_straight_line(after_s: float) -> None:
    bent = Path(500.0, [0.1 * offset_s**2 for offset_s in OFFSETS_S], [1.0 - offset_s / 100 for offset_s in OFFSETS_S])
    assert bent.angle_deg(500.0 + after_s) == pytest.approx(0.1 * after_s**2, abs=0.11)
    assert bent.weight(500.0 + after_s) == pytest.approx(1.0 - after_s / 100)
    if after_s in OFFSETS_S:
        assert bent.angle_deg(500.0 + after_s) == pytest.approx(0.1 * after_s**2)


def test_before_and_after_its_time_a_path_stands() -> None:
    path = steady(1.0)
    assert path.angle_deg(400.0) == 100.0
    assert path.angle_deg(900.0) == 160.0
    assert path.weight(900.0) == 1.0


@pytest.mark.parametrize("rate_dps", [-1.5, -0.3, 0.3, 1.5])
@pytest.mark.parametrize("tolerance_deg", [1.0, 4.0])
def test_the_window_of_a_steady_target_is_the_cube_root_of_its_rate(rate_dps: float, tolerance_deg: float) -> None:
    """Standing for a while T costs rate² T³ / 12 and one start: least where T³ is 6 starts over rate²."""
    stands_s = (6.0 * PRICE * tolerance_deg**3 / rate_dps**2) ** (1 / 3)
    # A path is looked at each half second at first: a while ends that much early.
    window_deg = abs(rate_dps) * (stands_s - 0.5)
    quick = next_place_deg(steady(rate_dps), 100.0, 1e9, tolerance_deg)
    if stands_s < 50.0:
        assert abs(quick - 100.0) == pytest.approx(window_deg / 2, rel=0.15)
    else:
        assert abs(quick - 100.0) == pytest.approx(abs(rate_dps) * 31.0, rel=0.1), "it sees no further than a minute"
    assert (quick > 100.0) is (rate_dps > 0)


def test_a_slow_motor_aims_at_where_the_target_will_be_when_it_is_half_way() -> None:
    quick, slow = (next_place_deg(steady(1.0), 40.0, speed_dps, 1.0) for speed_dps in (1e9, 6.0))
    half_way_s = (slow - 40.0) / 6.0 / 2
    assert slow - quick == pytest.approx(half_way_s, abs=0.6)


def test_a_target_that_stands_is_where_to_stand() -> None:
    assert next_place_deg(steady(0.0), 20.0, 6.0, 4.0) == pytest.approx(100.0)


def test_where_errors_weigh_little_they_count_little() -> None:
    """Near the zenith azimuth hardly matters: the place is chosen for the time in which it does."""
    weights = tuple(0.01 if offset_s < 5.0 else 1.0 for offset_s in OFFSETS_S)
    even, late = steady(2.0), steady(2.0, weights=weights)
    assert next_place_deg(late, 100.0, 1e9, 1.0) > next_place_deg(even, 100.0, 1e9, 1.0) + 3.0


def test_a_target_that_turns_back_is_waited_for() -> None:
    there_and_back = Path(0.0, [100.0 + min(offset_s, 8.0 - offset_s) for offset_s in OFFSETS_S], EVEN)
    place_deg = next_place_deg(there_and_back, 100.0, 1e9, 4.0)
    assert place_deg < 102.0
