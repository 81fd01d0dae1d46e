"""Where a drive that goes to an angle by itself is sent: to a place, along with a target, on with a jog, to a limit."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.positioned_law import SOON_S, PositionedLaw, Sent
from rotator.control.axis.readings import ANYTHING
from rotator.control.axis.settings import PositionedSettings
from rotator.control.commands import Steer
from rotator.control.sky.goal import EVEN
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import OFFSETS_S, Path

MINUS, OFF, PLUS = Direction
LIMITS = Range(0.0, 450.0)
SPEED_DPS, NEAR_DEG, BRAKING_DEG, LEASE_S = 30.0, 0.5, 5.0, 0.25
UNTIL_S = 77.0
LAW_SETTINGS = PositionedSettings(
    Axis.AZIMUTH, LIMITS, 1.0, SPEED_DPS, ANYTHING, Calibration(((0.0, 0.0), (450.0, 450.0)))
)
LAW = PositionedLaw(LAW_SETTINGS, BRAKING_DEG, LEASE_S)


@pytest.mark.parametrize(
    ("target_deg", "place_deg"), [(100.0, 100.0), (450.0, 450.0), (450.5, 450.0), (0.0, 0.0), (-3.0, 0.0)]
)
def test_a_target_that_stands_is_met_within_the_limits(target_deg: float, place_deg: float) -> None:
    assert LAW.aim(target_deg, UNTIL_S) == Steer(place_deg, 0.0, UNTIL_S)


@pytest.mark.parametrize(
    ("at_deg", "rate_dps", "place_deg", "moves_on_dps"),
    [
        (100.0, 2.0, 100.0, 2.0),
        (100.0, -2.0, 100.0, -2.0),
        (450.0, 2.0, 450.0, 0.0),
        (450.0, -2.0, 450.0, -2.0),
        (451.0, -2.0, 450.0, 0.0),
        (0.0, -2.0, 0.0, 0.0),
        (0.0, 2.0, 0.0, 2.0),
        (-1.0, 2.0, 0.0, 0.0),
    ],
)
def test_it_moves_on_with_its_target_and_waits_at_a_limit(
    at_deg: float, rate_dps: float, place_deg: float, moves_on_dps: float
) -> None:
    path = Path(1000.0, [at_deg + rate_dps * (offset_s - 1.0) for offset_s in OFFSETS_S], EVEN)
    steer = LAW.follow(1001.0, path, UNTIL_S)
    assert (steer.angle_deg, steer.rate_dps, steer.until_s) == pytest.approx((place_deg, moves_on_dps, UNTIL_S))


@pytest.mark.parametrize("way", [PLUS, MINUS])
@pytest.mark.parametrize("rate_dps", [1.0, 6.0, 30.0, 300.0])
def test_along_a_path_it_is_sent_to_its_limit_where_it_can_just_brake(way: Direction, rate_dps: float) -> None:
    """From 30°/s it takes 5°, at 6°/s a twenty-fifth of that; no target is faster than the motor."""
    share = min(1.0, rate_dps / SPEED_DPS)
    brakes_deg = share**2 * BRAKING_DEG + share * SPEED_DPS * SOON_S
    limit_deg = LIMITS.max_deg if way > 0 else LIMITS.min_deg
    for room_deg, stops in ((brakes_deg - 1e-3, True), (brakes_deg + 1e-3, False)):
        at_deg = limit_deg - way * room_deg
        path = Path(1000.0, [at_deg + way * rate_dps * (offset_s - 1.0) for offset_s in OFFSETS_S], EVEN)
        steer = LAW.follow(1001.0, path, UNTIL_S)
        if stops:
            assert steer == Steer(limit_deg, 0.0, UNTIL_S)
        else:
            assert (steer.angle_deg, steer.rate_dps) == pytest.approx((at_deg, way * rate_dps))


def test_what_stops_at_once_needs_no_room_before_its_limit() -> None:
    """A servo."""
    law = PositionedLaw(LAW_SETTINGS, 0.0, LEASE_S)
    path = Path(1000.0, [449.99 + 5.0 * (offset_s - 1.0) for offset_s in OFFSETS_S], EVEN)
    steer = law.follow(1001.0, path, UNTIL_S)
    assert (steer.angle_deg, steer.rate_dps) == pytest.approx((449.99, 5.0))


# --- jogs


@pytest.mark.parametrize(("way", "from_deg"), [(PLUS, 444.9), (MINUS, 5.1)])
def test_a_jog_begins_where_the_axis_is_at_its_speed(way: Direction, from_deg: float) -> None:
    for angle_deg in (100.0, from_deg):
        steer = LAW.jog(10.0, angle_deg, way, UNTIL_S, None, settling=False)
        assert steer == Steer(angle_deg, SPEED_DPS * way, UNTIL_S)


@pytest.mark.parametrize(("way", "from_deg", "limit_deg"), [(PLUS, 445.0, 450.0), (MINUS, 5.0, 0.0)])
def test_where_it_can_just_brake_it_goes_to_its_limit(way: Direction, from_deg: float, limit_deg: float) -> None:
    assert LAW.jog(10.0, from_deg, way, UNTIL_S, None, settling=False) == Steer(limit_deg, 0.0, UNTIL_S)


@pytest.mark.parametrize(
    ("angle_deg", "way", "over"),
    [(449.5, PLUS, True), (449.4, PLUS, False), (0.5, MINUS, True), (0.6, MINUS, False), (449.5, MINUS, False)],
)
def test_at_its_limit_no_jog_begins(angle_deg: float, way: Direction, over: bool) -> None:
    assert (LAW.jog(10.0, angle_deg, way, UNTIL_S, None, settling=False) is None) is over


@pytest.mark.parametrize(("angle_deg", "way"), [(0.0, MINUS), (-40.0, MINUS), (450.0, PLUS)])
def test_an_axis_that_does_not_know_its_place_is_jogged_past_its_limits(angle_deg: float, way: Direction) -> None:
    steer = LAW.jog(10.0, angle_deg, way, UNTIL_S, None, settling=False, lost=True)
    assert steer == Steer(angle_deg, SPEED_DPS * way, UNTIL_S)


def test_a_jog_that_has_reached_its_limit_is_held_there() -> None:
    """`hold` would let it come to rest beyond."""
    sent = Sent(Steer(450.0, 0.0, UNTIL_S), 9.0, PLUS)
    assert LAW.jog(10.0, 449.9, PLUS, UNTIL_S, sent, settling=False) == Steer(450.0, 0.0, UNTIL_S)


@pytest.mark.parametrize(
    ("jog", "settling", "from_deg"),
    [(PLUS, False, 130.0), (PLUS, True, 122.0), (MINUS, False, 122.0), (OFF, False, 122.0)],
)
def test_a_jog_goes_on_from_where_it_was_sent_while_the_axis_follows(
    jog: Direction, settling: bool, from_deg: float
) -> None:
    """Sent from 100° a second ago, at 30°/s; the axis is at 122°."""
    sent = Sent(Steer(100.0, SPEED_DPS, UNTIL_S), 9.0, jog)
    steer = LAW.jog(10.0, 122.0, PLUS, UNTIL_S, sent, settling=settling)
    assert steer == Steer(from_deg, SPEED_DPS, UNTIL_S)


@pytest.mark.parametrize(("angle_deg", "over"), [(100.0, False), (119.5, False), (119.6, True), (120.4, True)])
def test_a_jog_with_an_end_is_over_when_the_axis_is_there(angle_deg: float, over: bool) -> None:
    assert LAW.jog_to(120.0, angle_deg, UNTIL_S) == (None if over else Steer(120.0, 0.0, UNTIL_S))


# --- the direction of a command


@pytest.mark.parametrize(
    ("rate_dps", "angle_deg", "way"),
    [
        (0.0, 100.0, PLUS),
        (0.0, 140.0, MINUS),
        (0.0, 120.4, OFF),
        (0.0, 119.5, PLUS),
        (0.04, 120.2, OFF),
        (0.05, 120.2, PLUS),
        (1.0, 120.2, PLUS),
        (-1.0, 119.8, MINUS),
        (1.0, 120.5, MINUS),
        (1.0, 130.0, MINUS),
        (0.0, None, OFF),
    ],
)
def test_the_way_to_a_place_and_along_with_it_once_it_is_there(
    rate_dps: float, angle_deg: float | None, way: Direction
) -> None:
    assert LAW.towards(Steer(120.0, rate_dps, UNTIL_S), angle_deg) is way


@pytest.mark.parametrize(
    ("angle_deg", "rate_dps", "switches", "blocked"),
    [
        (100.0, 0.0, (PLUS,), PLUS),
        (100.0, 0.0, (MINUS,), None),
        (100.0, 0.0, (), None),
        (140.0, 0.0, (PLUS, MINUS), MINUS),
        (119.5, 0.0, (PLUS,), PLUS),
        (119.6, 0.0, (PLUS,), None),
        (120.0, 4.0, (PLUS,), PLUS),
        (120.0, -4.0, (MINUS,), MINUS),
        (120.0, 1.0, (PLUS,), None),
    ],
)
def test_a_limit_switch_blocks_a_command_in_its_direction(
    angle_deg: float, rate_dps: float, switches: tuple[Direction, ...], blocked: Direction | None
) -> None:
    """As far as the command leads before it expires; half a degree may be the play of the gear."""
    assert LAW.blocked(Steer(120.0, rate_dps, UNTIL_S), angle_deg, switches) is blocked
