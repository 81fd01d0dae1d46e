"""Whether a relay has been seen to open: what shows it, what shows nothing, and how a doubt ends."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.exchange.motor import ALL_OPEN, Trust, Trusts
from tests.control.axis.watched_motor import STEP_S, WatchedMotor

MINUS, OFF, PLUS = Direction
OPEN, UNSEEN, DOUBTED, WELDED = Trust
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
MID_DEG = 200.0


def of(trusts: Trusts, way: Direction) -> Trust:
    return trusts[0 if way > 0 else 1]


def end_deg(way: Direction, inside_deg: float) -> float:
    """So far inside the limit on that side."""
    return 450.0 - inside_deg if way > 0 else inside_deg


def against(way: Direction) -> Direction:
    return Direction(-way)


# --- what shows that a relay is open


@BOTH_WAYS
@pytest.mark.parametrize("run_s", [0.1, 0.4, 1.0, 3.0])
def test_after_a_run_in_mid_travel_the_opposite_relay_may_close_within_a_second(way: Direction, run_s: float) -> None:
    rotor = WatchedMotor()
    rotor.look(2.0)
    rotor.run(way, run_s)
    assert rotor.watch.forbids(against(way))
    assert not rotor.watch.forbids(way), "the same relay may go on"
    assert 0.05 < rotor.waits_s(against(way)) <= 1.0
    assert rotor.watch.trusts == ALL_OPEN


@BOTH_WAYS
@pytest.mark.parametrize("hangs_s", [0.3, 0.6, 1.5])
def test_where_its_sensor_hung_it_went_on_with_current_until_the_relay_opened(way: Direction, hangs_s: float) -> None:
    rotor = WatchedMotor(speed_dps=30.0, believed_dps=30.0)
    rotor.look(2.0)
    rotor.relays(way)
    rotor.look(2.0)
    rotor.hang(hangs_s)
    rotor.relays(OFF)
    rotor.hang(0.8)
    assert rotor.look(3.0) is None
    assert rotor.watch.trusts == ALL_OPEN
    assert not rotor.watch.forbids(against(way))


@BOTH_WAYS
@pytest.mark.parametrize("noise_deg", [0.03, 0.1])
def test_an_axis_that_coasts_for_long_need_not_come_to_rest_first(way: Direction, noise_deg: float) -> None:
    rotor = WatchedMotor(lag_s=1.0, noise_deg=noise_deg)
    rotor.look(2.0)
    rotor.run(way, 6.0)
    assert rotor.waits_s(against(way)) <= 1.0
    assert of(rotor.watch.trusts, way) is OPEN
    assert abs(rotor.motor.speed_dps) > 1.0, "slower than its run, so it has lost its current"


@BOTH_WAYS
def test_slowing_down_beyond_its_limit_shows_nothing_for_a_stop_may_hold_it(way: Direction) -> None:
    rotor = WatchedMotor(end_deg(way, 10.0))
    rotor.look(2.0)
    rotor.run(way, 2.5)
    rotor.look(3.0)
    assert rotor.at_deg * way > (452.0 if way > 0 else -2.0) * way - 0.1
    assert of(rotor.watch.trusts, way) is DOUBTED


@BOTH_WAYS
@pytest.mark.parametrize(("beyond_deg", "trust"), [(-3.0, OPEN), (0.3, OPEN), (0.8, DOUBTED)])
def test_it_may_come_to_rest_half_a_degree_beyond_its_limit_and_no_more(
    way: Direction, beyond_deg: float, trust: Trust
) -> None:
    """The stop is a degree beyond the limit at least: what rests before it is free, not held."""
    rotor = WatchedMotor(end_deg(way, 6.0 - beyond_deg), noise_deg=0.02, lag_s=0.02)
    rotor.look(2.0)
    rotor.run(way, 1.0)
    rotor.look(4.0)
    assert of(rotor.watch.trusts, way) is trust


@BOTH_WAYS
def test_without_calibrated_limits_every_place_is_inside(way: Direction) -> None:
    rotor = WatchedMotor(end_deg(way, 3.0), placed=False)
    rotor.look(2.0)
    rotor.run(way, 0.7)
    rotor.look(3.0)
    assert rotor.watch.trusts == ALL_OPEN


@BOTH_WAYS
def test_taps_that_are_too_short_to_be_seen_are_trusted_for_most_of_a_second_in_all(way: Direction) -> None:
    rotor = WatchedMotor()
    rotor.motor.stalled = True
    rotor.look(2.0)
    trusts = []
    for _ in range(10):
        rotor.run(way, 0.2)
        rotor.look(3.0)
        trusts.append(of(rotor.watch.trusts, way))
    assert trusts[:3] == [OPEN] * 3
    assert trusts[-1] is DOUBTED


@BOTH_WAYS
def test_taps_that_turn_the_axis_never_add_up(way: Direction) -> None:
    rotor = WatchedMotor(noise_deg=0.05)
    rotor.look(2.0)
    for _ in range(15):
        rotor.run(way, 0.2)
        rotor.look(2.0)
        assert rotor.watch.trusts == ALL_OPEN


# --- what shows nothing


@BOTH_WAYS
def test_held_in_mid_travel_the_relay_is_in_doubt(way: Direction) -> None:
    """Ice: with a welded relay the motor would stand there just the same."""
    rotor = stalled(way)
    assert of(rotor.watch.trusts, way) is DOUBTED
    assert rotor.watch.forbids(against(way))
    accused = rotor.watch.accuse(against(way))
    assert accused is not None
    assert float(accused.measured.split("stands at ")[1].split("°")[0]) == pytest.approx(rotor.at_deg, abs=0.2)


def stalled(way: Direction) -> WatchedMotor:
    """Ice holds it in mid-travel, and its relay opens."""
    rotor = WatchedMotor()
    rotor.look(2.0)
    rotor.relays(way)
    rotor.look(1.0)
    rotor.motor.stalled = True
    rotor.look(1.5)
    rotor.relays(OFF)
    rotor.look(3.0)
    return rotor


def held(way: Direction) -> WatchedMotor:
    """The ice has melted."""
    rotor = stalled(way)
    rotor.motor.stalled = False
    assert of(rotor.watch.trusts, way) is DOUBTED
    return rotor


def ran_into(way: Direction, after_s: float, **motor: float) -> WatchedMotor:
    """Its relay has welded, and something holds it so long after it was switched off."""
    rotor = WatchedMotor(**motor)  # type: ignore[arg-type]
    rotor.look(2.0)
    rotor.motor.welded = int(way)
    rotor.run(way, 3.0)
    room_deg = after_s * rotor.motor.spec.speed_dps
    if way > 0:
        rotor.motor.stop_high_deg = rotor.at_deg + room_deg
    else:
        rotor.motor.stop_low_deg = rotor.at_deg - room_deg
    return rotor


@BOTH_WAYS
@pytest.mark.parametrize("after_s", [0.6, 0.8])
@pytest.mark.parametrize("speed_dps", [2.7, 4.0, 6.0])
def test_what_runs_on_and_stops_dead_in_mid_travel_has_not_coasted(
    way: Direction, after_s: float, speed_dps: float
) -> None:
    """A branch, or a stop that is nearer than the sensor says."""
    rotor = ran_into(way, after_s, speed_dps=speed_dps, believed_dps=6.0)
    rotor.look(5.0)
    assert of(rotor.watch.trusts, way) in (DOUBTED, WELDED)
    assert rotor.watch.accuse(against(way)) is not None


@BOTH_WAYS
def test_a_sensor_that_drifts_while_the_axis_is_held_ends_no_doubt(way: Direction) -> None:
    rotor = ran_into(way, 0.7)
    rotor.look(5.0)
    rotor.drift_dps = -0.1 * way
    rotor.look(40.0)
    for _ in range(3):
        rotor.run(way, 0.2)
        rotor.look(5.0)
    assert of(rotor.watch.trusts, way) in (DOUBTED, WELDED)
    assert rotor.motor.shorted_s == 0.0


@BOTH_WAYS
def test_a_run_of_its_own_that_ends_as_it_should_ends_the_doubt(way: Direction) -> None:
    rotor = held(way)
    assert not rotor.watch.forbids(way)
    rotor.run(way, 1.5)
    rotor.look(2.0)
    assert rotor.watch.trusts == ALL_OPEN
    assert rotor.watch.accuse(against(way)) is None


@BOTH_WAYS
def test_a_tap_that_does_not_leave_the_place_where_it_was_held_ends_no_doubt(way: Direction) -> None:
    rotor = held(way)
    rotor.run(way, 0.1)
    rotor.look(3.0)
    assert abs(rotor.at_deg - MID_DEG) < 8.0
    assert of(rotor.watch.trusts, way) is DOUBTED


@BOTH_WAYS
@pytest.mark.parametrize("share", [-0.3, 0.3])
def test_moved_by_a_hand_from_where_it_was_held_and_standing_there_ends_the_doubt(way: Direction, share: float) -> None:
    """With current it would have gone on, or back to what held it."""
    rotor = held(way)
    rotor.push(share, 3.0)
    rotor.look(3.0)
    assert of(rotor.watch.trusts, way) is OPEN


@BOTH_WAYS
def test_a_person_who_has_looked_ends_every_doubt(way: Direction) -> None:
    rotor = held(way)
    rotor.watch.checked()
    assert rotor.watch.trusts == ALL_OPEN
    rotor.look(5.0)
    assert rotor.watch.trusts == ALL_OPEN, "standing there raises no new one"
    assert not rotor.watch.forbids(against(way))
    rotor.run(against(way), 1.0)
    rotor.look(2.0)
    assert rotor.watch.trusts == ALL_OPEN


@BOTH_WAYS
def test_without_a_supply_standing_shows_nothing(way: Direction) -> None:
    rotor = WatchedMotor(master=True)
    rotor.look(2.0)
    rotor.relays(way)
    rotor.look(2.0)
    rotor.motor.supply = False
    rotor.relays(OFF)
    rotor.look(30.0)
    assert of(rotor.watch.trusts, way) is UNSEEN
    rotor.motor.supply = True
    assert 0.25 <= rotor.waits_s(against(way)) <= 1.0, "seen to stand with a supply"


# --- a relay that is really welded


@BOTH_WAYS
@pytest.mark.parametrize("run_s", [0.1, 0.3, 1.0, 4.0])
@pytest.mark.parametrize("lag_s", [0.05, 0.3])
def test_while_it_turns_on_the_opposite_relay_stays_open(way: Direction, run_s: float, lag_s: float) -> None:
    rotor = WatchedMotor(lag_s=lag_s)
    rotor.look(2.0)
    rotor.motor.welded = int(way)
    rotor.run(way, run_s)
    for _ in range(100):
        rotor.look(STEP_S)
        assert rotor.watch.forbids(against(way))
    assert rotor.fault is not None
    assert of(rotor.watch.trusts, way) is WELDED


@BOTH_WAYS
@pytest.mark.parametrize("believed_dps", [4.0, 6.0, 9.0])
def test_running_on_to_its_stop_and_held_there_it_is_found_welded(way: Direction, believed_dps: float) -> None:
    """It stands within a second: only that it did not slow down before shows the weld."""
    rotor = WatchedMotor(end_deg(way, 25.5), believed_dps=believed_dps)
    rotor.look(2.0)
    rotor.motor.welded = int(way)
    rotor.run(way, 4.0)
    rotor.look(6.0)
    assert rotor.fault is not None
    assert rotor.fault.name == "relay welded"
    assert rotor.watch.forbids(against(way))


@BOTH_WAYS
def test_no_supply_and_standing_does_not_acquit_a_relay_found_welded(way: Direction) -> None:
    rotor = WatchedMotor(master=True)
    rotor.look(2.0)
    rotor.motor.welded = int(way)
    rotor.run(way, 3.0)
    rotor.look(2.0)
    rotor.motor.supply = False
    rotor.look(10.0)
    assert of(rotor.watch.trusts, way) is WELDED
    rotor.motor.supply, rotor.motor.welded = True, 0
    rotor.look(10.0)
    assert of(rotor.watch.trusts, way) is WELDED, "a person may have cut the supply by hand"
    rotor.run(way, 1.5)
    rotor.look(2.0)
    assert rotor.watch.trusts == ALL_OPEN


# --- it was not driven yet


@BOTH_WAYS
def test_before_the_first_relay_of_a_run_it_is_seen_to_stand(way: Direction) -> None:
    rotor = WatchedMotor(look=True)
    assert rotor.watch.looks
    assert rotor.watch.forbids(way)
    assert 0.25 <= rotor.waits_s(way) <= 1.0
    assert not rotor.watch.looks


@BOTH_WAYS
def test_an_axis_that_turns_at_the_start_is_not_driven(way: Direction) -> None:
    rotor = WatchedMotor(100.0, look=True)
    rotor.motor.pushed = 1.0
    assert rotor.waits_s(way, most_s=5.0) >= 5.0


@BOTH_WAYS
def test_what_turns_it_by_itself_may_be_that_relay_until_it_stands(way: Direction) -> None:
    rotor = WatchedMotor()
    rotor.look(2.0)
    rotor.push(0.6 * way, 0.5)
    assert rotor.watch.forbids(against(way))
    assert not rotor.watch.forbids(way)
    rotor.look(3.0)
    assert rotor.watch.trusts == ALL_OPEN


@BOTH_WAYS
def test_a_motor_that_has_just_begun_to_turn_it_keeps_the_opposite_relay_open(way: Direction) -> None:
    """A master that closes, and the relay was welded long before: nothing else has shown it yet."""
    rotor = WatchedMotor(noise_deg=0.02)
    rotor.look(2.0)
    rotor.motor.welded = int(way)
    rotor.look(0.45)
    assert rotor.watch.forbids(against(way))


@BOTH_WAYS
@pytest.mark.parametrize(("trust", "later"), [(UNSEEN, OPEN), (DOUBTED, DOUBTED), (WELDED, WELDED), (OPEN, OPEN)])
def test_what_an_earlier_run_of_the_program_knew_counts(way: Direction, trust: Trust, later: Trust) -> None:
    trusts = (trust, OPEN) if way > 0 else (OPEN, trust)
    rotor = WatchedMotor(trusts=trusts, look=True)
    rotor.look(3.0)
    assert of(rotor.watch.trusts, way) is later
    assert of(rotor.watch.trusts, against(way)) is OPEN
    rotor.run(way, 1.5)
    rotor.look(2.0)
    assert rotor.watch.trusts == ALL_OPEN
