"""An axis that was never commissioned: it says UNCALIBRATED, obeys jog alone, and two seconds a press."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Aim, Calibrate, Jog, LoadTimed, Order, Park, Release, RunTimed, Stop
from rotator.exchange.sources import Source
from tests.search import some

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
RESTING = {AZ: OFF, EL: OFF}
FRESH = dict.fromkeys(Axis, (Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK))
BARE_POTS = dict.fromkeys(Axis, (Missing.CALIBRATION,))


@pytest.fixture
def fresh(new_desk: Any) -> Any:
    """A box just screwed together."""
    desk = new_desk(missing=FRESH)
    desk.step()
    return desk


def test_it_says_what_is_missing(fresh: Any) -> None:
    assert fresh.status.azimuth.uncalibrated == "calibration, limits, direction check"
    assert fresh.status.azimuth.angle_deg is None
    assert fresh.status.azimuth.raw == pytest.approx(0.25)


@pytest.mark.parametrize("missing", [Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK])
@pytest.mark.parametrize("order", [Aim(235, 60), Aim(235, None), Park(), LoadTimed(1.0, ((235, 60), (30, 0)))], ids=str)
def test_any_one_thing_missing_keeps_it_from_being_aimed(new_desk: Any, order: Order, missing: Missing) -> None:
    desk = new_desk(missing=dict.fromkeys(Axis, (missing,)))
    desk.step()
    assert desk.step(order, RunTimed()) == RESTING
    assert desk.run(5.0) == set()


@pytest.mark.parametrize("asked_s", [None, 2.0, 60.0])
def test_a_press_turns_it_for_two_seconds(fresh: Any, asked_s: float | None) -> None:
    assert fresh.step(Jog(AZ, PLUS, asked_s)) == {AZ: PLUS, EL: OFF}
    assert fresh.run(1.9) == {(AZ, PLUS)}
    assert fresh.runs[AZ].until_s == pytest.approx(1002.1)
    fresh.run(0.1)
    assert fresh.run(10.0) == set()


def test_the_other_way_is_obeyed_as_soon_as_the_relay_is_seen_to_open(fresh: Any) -> None:
    fresh.step(Jog(AZ, PLUS))
    fresh.run(0.5)
    assert fresh.step(Jog(AZ, MINUS)) == RESTING
    assert fresh.run(1.0) == {(AZ, MINUS)}


@pytest.mark.search
@pytest.mark.parametrize(
    ("ways", "every"),
    some(list(product([(PLUS,), (PLUS, MINUS), (PLUS, PLUS, MINUS)], [0.05, 0.3, 1.0, 1.9, 2.5, 3.1]))),
    ids=str,
)
def test_a_link_that_presses_for_a_minute_turns_it_two_seconds_at_a_time(
    fresh: Any, every: float, ways: tuple[Direction, ...]
) -> None:
    longest = driven = run = 0
    for step in range(1200):
        pressed = [Jog(AZ, ways[step % len(ways)])] if step % round(every / 0.05) == 0 else []
        on = fresh.step(*pressed)[AZ] is not OFF
        run = run + 1 if on else 0
        longest, driven = max(longest, run), driven + on
    assert longest * 0.05 <= 2.1
    assert driven <= 0.75 * 1200


def test_after_a_stop_it_rests_in_proportion_to_its_turn(fresh: Any) -> None:
    fresh.step(Jog(AZ, PLUS))
    fresh.run(1.0)
    fresh.step(Stop())
    assert fresh.step(Jog(AZ, PLUS)) == RESTING
    fresh.run(0.5)
    assert fresh.step(Jog(AZ, PLUS))[AZ] is PLUS


@pytest.mark.parametrize("person", ["console", "panel", "calibrate"])
def test_a_person_holds_the_key_for_as_long_as_it_suits(fresh: Any, person: str) -> None:
    for _ in range(20):
        fresh.step(Jog(AZ, PLUS), by=Source(person))
        assert fresh.run(0.5) == {(AZ, PLUS)}


def test_a_pot_that_is_not_there_lets_not_even_a_jog_pass(fresh: Any) -> None:
    fresh.instead[AZ] = 0.0
    assert fresh.step(Jog(AZ, PLUS)) == RESTING


def test_one_fresh_axis_keeps_the_other_from_nothing(new_desk: Any) -> None:
    desk = new_desk(missing={EL: (Missing.DIRECTION_CHECK,)})
    desk.step()
    assert desk.step(Aim(235, 60)) == {AZ: PLUS, EL: OFF}


# --- at its stop


def pressed(desk: Any, minutes: float, every_s: float = 1.0, by: Source | None = None) -> float:
    """Seconds of current in azimuth's motor while it is pressed."""
    on = 0
    for step in range(round(minutes * 1200)):
        orders = [Jog(AZ, PLUS)] if step % round(every_s / 0.05) == 0 else []
        on += desk.step(*orders, by=by or desk.LINK)[AZ] is not OFF
    return on * 0.05


@pytest.mark.parametrize("every_s", [0.1, 0.5, 1.0, 2.5, 7.0])
def test_a_program_that_presses_an_axis_which_does_not_move_is_obeyed_three_times(fresh: Any, every_s: float) -> None:
    fresh.instead[AZ] = 0.97
    assert pressed(fresh, 2.0, every_s) <= 3 * 2.05 + 2.05
    assert [notice.lcd for notice in fresh.status.azimuth.notices] == ["NOT TURNING"]
    assert fresh.status.azimuth.fault is None


def test_then_it_takes_a_person_who_turns_it_or_says_resume(fresh: Any) -> None:
    fresh.instead[AZ] = 0.97
    pressed(fresh, 1.0)
    fresh.run(120.0)
    assert pressed(fresh, 0.1) == 0.0, "time alone is no reason"
    assert pressed(fresh, 0.1, by=Source("console")) > 1.0
    fresh.step(Stop())
    fresh.run(15.0)
    assert pressed(fresh, 0.1) == 0.0, "neither is a stop"
    fresh.step(Release(), by=Source("console"))
    assert pressed(fresh, 1.0) > 1.0
    assert [notice.lcd for notice in fresh.status.azimuth.notices] == ["NOT TURNING"]
    fresh.instead.clear()
    fresh.place(AZ, 300.0)
    assert fresh.step(Jog(AZ, MINUS), by=Source("console"))[AZ] is MINUS
    fresh.run(15.0)
    assert [notice.lcd for notice in fresh.status.azimuth.notices] == ["JUMPED"], "it was carried to 300 degrees"
    assert pressed(fresh, 0.1) > 1.0


# --- calibrating at the two ends


def calibrate(desk: Any, axis: Axis, angle_deg: float, *, high_end: bool) -> None:
    desk.place(axis, angle_deg)
    desk.step(Calibrate(axis, high_end=high_end))
    desk.step()


@pytest.mark.parametrize("high_first", [False, True])
def test_two_ends_commission_an_axis_that_lacked_only_them(new_desk: Any, high_first: bool) -> None:
    desk = new_desk(missing=BARE_POTS)
    for high_end in (high_first, not high_first):
        assert desk.status.azimuth.uncalibrated == "calibration"
        calibrate(desk, AZ, 450.0 if high_end else 0.0, high_end=high_end)
    assert desk.status.azimuth.uncalibrated == ""
    assert desk.status.azimuth.calibration == (pytest.approx((0.05, 0.0)), pytest.approx((0.95, 450.0)))
    desk.place(AZ, 100.0)
    assert desk.status.azimuth.angle_deg == pytest.approx(100.0)
    assert desk.step(Aim(235, None))[AZ] is PLUS


@pytest.mark.parametrize("high_end", [False, True])
def test_no_end_is_taken_further_out(new_desk: Any, high_end: bool) -> None:
    desk = new_desk(azimuth=(90.0, 270.0), at=(180.0, 10.0))
    before = desk.status.azimuth.calibration
    calibrate(desk, AZ, 273.0 if high_end else 87.0, high_end=high_end)
    assert desk.status.azimuth.calibration == before
    assert "only `rotator calibrate` takes an end further out" in desk.controller.troubles[0]


def test_an_end_taken_further_in_may_be_put_back_and_no_more(new_desk: Any) -> None:
    desk = new_desk(azimuth=(90.0, 270.0), at=(180.0, 10.0))
    before = desk.status.azimuth.calibration
    for angle_deg in (200.0, 270.0, 273.0):
        calibrate(desk, AZ, angle_deg, high_end=True)
    assert [raw for raw, _ in desk.status.azimuth.calibration] == pytest.approx([raw for raw, _ in before])


def test_while_anything_moves_it_keeps_its_calibration(desk: Any) -> None:
    before = desk.status.azimuth.calibration
    desk.step(Aim(100, 60))
    for order in (Stop(), Calibrate(AZ, high_end=True)):  # stopped, but still coasting
        desk.step(order)
    assert desk.status.azimuth.calibration == before
    assert desk.controller.troubles == ["azimuth cannot be calibrated while the antenna moves"]


def test_a_calibration_forgets_where_the_axis_was_to_point(desk: Any) -> None:
    # the target was meant on the old scale
    desk.step(Aim(100, 10))
    calibrate(desk, AZ, 100.0, high_end=False)
    assert desk.status.azimuth.angle_deg == pytest.approx(0.0)
    assert desk.run(5.0) == set()
    assert desk.status.azimuth.target_deg is None


def test_with_a_broken_pot_it_keeps_its_calibration(desk: Any) -> None:
    desk.instead[AZ] = 0.0
    desk.step()
    desk.step(Calibrate(AZ, high_end=False))
    assert desk.controller.troubles == ["azimuth keeps its calibration: the sensor has no believable reading"]
