"""One servo's next pulse: the jump of the first one, then no faster than its slew rate. Moments are arguments."""

from __future__ import annotations

import math

import pytest

from hw.drives.servo_axis import ServoAxis, ServoSpec
from hw.ports import HardwareError

JUMP_S = 3.0
"""From 180° to its start at 60°, at 40°/s."""
SPEC = ServoSpec(0, ((0.0, 500.0), (180.0, 2500.0)), start_deg=60.0, slew_dps=40.0)


def fresh(start_deg: float = 60.0) -> ServoAxis:
    return ServoAxis("azimuth servo", ServoSpec(0, SPEC.pulses_us, start_deg, SPEC.slew_dps))


def jumping() -> ServoAxis:
    """Its first pulse was sent at 100 s."""
    axis = fresh()
    axis.aim(90.0, 0.0, 100.0, 100.5)
    axis.wake(100.0)
    axis.stepped(60.0, 100.0)
    return axis


def settled() -> ServoAxis:
    """Its jump is over, and it was stepped at 104 s."""
    axis = jumping()
    axis.stepped(60.0, 104.0)
    axis.hold(104.0)
    return axis


# --- the jump of the first pulse


def test_without_a_command_nothing_is_due() -> None:
    axis = fresh()
    assert (axis.due_s(), axis.under_way, axis.pulsing) == (math.inf, False, False)
    assert (axis.settled_s, axis.moved_s, axis.angle_deg) == (math.inf, -math.inf, 60.0)


@pytest.mark.parametrize(("start_deg", "jump_s"), [(60.0, 3.0), (0.0, 4.5), (120.0, 3.0), (180.0, 4.5)])
def test_the_first_pulse_is_due_at_once_and_the_servo_may_come_from_its_farther_end(
    start_deg: float, jump_s: float
) -> None:
    axis = fresh(start_deg)
    axis.aim(90.0, 0.0, 100.0, 100.5)
    assert axis.due_s() == -math.inf
    assert axis.next_deg(100.0) == start_deg
    axis.wake(100.0)
    axis.stepped(start_deg, 100.0)
    assert (axis.pulsing, axis.moved_s) == (True, 100.0)
    assert axis.settled_s == pytest.approx(100.0 + jump_s)


def test_during_the_jump_only_the_end_of_the_command_is_due() -> None:
    axis = jumping()
    assert axis.due_s() == 100.5
    axis.aim(90.0, 0.0, 100.4, 110.0)
    assert axis.due_s() == 100.0 + JUMP_S


@pytest.mark.parametrize("way", ["hold", "expire"])
def test_a_stop_during_the_jump_takes_the_pulses_and_the_next_jump_takes_what_is_left(way: str) -> None:
    axis = jumping()
    if way == "hold":
        axis.hold(100.5)
    else:
        axis.expire(100.4)
        assert not axis.limp
        axis.expire(100.5)
    assert (axis.limp, axis.under_way, axis.due_s()) == (True, False, -math.inf)
    axis.stop_jump(101.0)
    assert (axis.limp, axis.pulsing, axis.settled_s) == (False, False, math.inf)
    axis.aim(90.0, 0.0, 200.0, 200.5)
    axis.wake(200.0)
    assert axis.settled_s == pytest.approx(200.0 + JUMP_S - 1.0)
    axis.hold(200.1)
    axis.stop_jump(210.0)
    axis.wake(300.0)
    assert axis.settled_s == 300.0, "never less than no time"


def test_a_new_aim_ends_a_stop_that_was_not_carried_out_yet() -> None:
    axis = jumping()
    axis.hold(100.1)
    axis.aim(90.0, 0.0, 100.2, 100.7)
    assert (axis.limp, axis.under_way) == (False, True)


def test_after_the_jump_a_stop_keeps_the_pulses() -> None:
    axis = jumping()
    axis.hold(100.0 + JUMP_S)
    assert (axis.limp, axis.pulsing, axis.due_s()) == (False, True, math.inf)


# --- motion


@pytest.mark.parametrize(("target_deg", "way"), [(90.0, 1), (10.0, -1)])
def test_a_step_is_as_long_as_the_time_since_the_last_one_but_for_two_frames_at_most(
    target_deg: float, way: int
) -> None:
    axis = settled()
    axis.aim(target_deg, 0.0, 104.0, 104.5)
    assert axis.due_s() == pytest.approx(104.02)
    for seconds, step_deg in ((0.01, 0.4), (0.02, 0.8), (0.04, 1.6), (0.4, 1.6)):
        assert axis.next_deg(104.0 + seconds) == pytest.approx(60.0 + way * step_deg)


def test_it_goes_no_further_than_the_course_and_not_beyond_its_table() -> None:
    axis = settled()
    axis.aim(60.5, 0.0, 104.0, 104.5)
    assert axis.next_deg(104.04) == 60.5
    axis.aim(60.0, 10.0, 104.0, 104.5)
    assert axis.next_deg(104.04) == pytest.approx(60.4)
    axis.stepped(179.9, 104.0)
    axis.aim(180.0, 10.0, 104.0, 104.5)
    assert axis.next_deg(104.04) == 180.0
    with pytest.raises(HardwareError, match=r"azimuth servo: 181.0° is outside"):
        axis.aim(181.0, 0.0, 104.0, 104.5)


def test_arrived_only_the_end_of_the_command_is_due() -> None:
    axis = settled()
    axis.aim(60.0, 0.0, 104.0, 104.5)
    assert axis.due_s() == 104.5
    axis.aim(60.0, 1.0, 104.0, 104.5)
    assert axis.due_s() == pytest.approx(104.02), "a target that moves on is never reached"
    axis.aim(61.0, 0.0, 104.0, 104.01)
    assert axis.due_s() == 104.01, "the command ends before the next step"


def test_when_the_pulse_last_changed_is_known_and_a_pulse_that_stays_is_no_change() -> None:
    axis = settled()
    axis.stepped(60.8, 104.02)
    axis.stepped(60.8, 104.04)
    assert (axis.moved_s, axis.angle_deg) == (104.02, 60.8)
    assert axis.width_us == pytest.approx(500 + 60.8 / 180 * 2000)


# --- no pulses


def test_a_servo_that_was_put_to_sleep_at_rest_goes_on_without_a_jump() -> None:
    axis = settled()
    axis.stepped(70.0, 104.02)
    axis.sleep(lost=False)
    assert (axis.pulsing, axis.settled_s) == (False, 100.0 + JUMP_S)
    axis.aim(80.0, 0.0, 110.0, 110.5)
    assert axis.next_deg(110.0) == 70.0
    axis.wake(110.0)
    assert axis.settled_s == 100.0 + JUMP_S


def test_a_servo_that_was_limp_may_stand_anywhere() -> None:
    axis = settled()
    axis.stepped(150.0, 104.02)
    axis.sleep(lost=True)
    assert (axis.pulsing, axis.limp, axis.settled_s) == (False, False, math.inf)
    axis.wake(110.0)
    assert axis.settled_s == pytest.approx(110.0 + 150.0 / 40.0)


def test_the_end_of_a_command_that_was_replaced_ends_nothing() -> None:
    axis = settled()
    axis.aim(90.0, 0.0, 104.0, 104.5)
    axis.aim(90.0, 0.0, 104.2, 104.7)
    axis.expire(104.5)
    assert axis.under_way
    axis.expire(104.7)
    assert not axis.under_way
