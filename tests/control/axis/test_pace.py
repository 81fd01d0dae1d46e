"""Where an axis that goes to an angle by itself may be, and where it would come to rest."""

from __future__ import annotations

import itertools
import random

import pytest

from hw.ports import AngleSource, Axis
from rotator.control.axis.pace import SLOWEST_SHARE, Pace
from rotator.control.axis.readings import Window
from rotator.control.axis.settings import PositionedSettings
from rotator.control.sky.mount import Range

SPEED_DPS, ACCEL_DPS2, STEP_S = 30.0, 20.0, 0.02


def pace(source: AngleSource, accel_dps2: float | None = None) -> Pace:
    limits = Range(0.0, 180.0)
    return Pace(
        PositionedSettings(
            Axis.ELEVATION,
            limits,
            tolerance_deg=1.0,
            speed_dps=SPEED_DPS,
            window=Window(-10.0, 190.0),
            calibration=None,
            source=source,
            accel_dps2=accel_dps2,
        )
    )


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("share", [SLOWEST_SHARE, 0.6, 1.0])
def test_a_servo_behind_its_model_is_where_it_may_be_also_after_the_model_has_turned_back(
    seed: int, share: float
) -> None:
    """The servo turns at `share` of the model's speed, to places that change while it is on its way."""
    draw, of_a_servo = random.Random(seed), pace(AngleSource.MODELLED)
    model_deg = shaft_deg = place_deg = 90.0
    for step in range(1500):
        if step % 40 == 0 and draw.random() < 0.6:
            place_deg = draw.uniform(0.0, 180.0)
        most_deg = SPEED_DPS * STEP_S
        model_deg += max(-most_deg, min(most_deg, place_deg - model_deg))
        shaft_deg += max(-share * most_deg, min(share * most_deg, model_deg - shaft_deg))
        of_a_servo.see(step * STEP_S, model_deg)
        assert of_a_servo.span(step * STEP_S).holds(shaft_deg), step * STEP_S


def test_a_servo_at_rest_is_known_to_stand_there_after_the_time_that_a_slow_one_takes() -> None:
    of_a_servo, spans = pace(AngleSource.MODELLED), []
    for step in range(200):
        of_a_servo.see(step * STEP_S, min(30.0, SPEED_DPS * step * STEP_S))
        spans.append(of_a_servo.span(step * STEP_S))
    assert all(span.max_deg == pytest.approx(30.5) for span in spans[50:])
    assert spans[50].min_deg == pytest.approx(0.3 * 30.0 - 0.5)
    assert spans[160].min_deg < 29.0
    assert spans[170].min_deg == pytest.approx(29.5), "it turns at 0.3 of its speed at least"


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_a_motor_that_has_passed_its_place_by_a_hair_still_comes_to_rest_there(way: int) -> None:
    of_a_moteus = pace(AngleSource.MEASURED, ACCEL_DPS2)
    place_deg, speed_dps, angle_deg = 90.0 + way * 27.0, way * 12.0, 90.0 + way * 23.4
    of_a_moteus.see(-STEP_S, angle_deg - speed_dps * STEP_S)
    of_a_moteus.see(0.0, angle_deg)
    for step in itertools.count(1):
        now_s = step * STEP_S
        of_a_moteus.sent(now_s, place_deg)
        speed_dps = way * max(0.0, abs(speed_dps) - ACCEL_DPS2 * STEP_S)
        angle_deg += speed_dps * STEP_S + (way * 0.01 if speed_dps == 0.0 else 0.0)
        of_a_moteus.see(now_s, angle_deg)
        if (angle_deg - place_deg) * way > 0.05:
            break
    span = of_a_moteus.span(now_s)
    assert (span.max_deg if way > 0 else span.min_deg) == pytest.approx(place_deg + way * 0.5)


# --- a measured angle


def turning(speed_dps: float, accel_dps2: float | None, at_deg: float = 90.0) -> Pace:
    """It has turned evenly for half a second, and is at `at_deg` at 0 s."""
    axis = pace(AngleSource.MEASURED, accel_dps2)
    for step in range(-25, 1):
        axis.see(step * STEP_S, at_deg + speed_dps * step * STEP_S)
    return axis


@pytest.mark.parametrize("seed", range(10))
def test_a_moteus_that_is_stopped_anywhere_rests_within_its_span(seed: int) -> None:
    """It gathers speed and brakes at 20°/s² as it likes; it obeys after 0.1 s, and then brakes."""
    draw, axis = random.Random(seed), pace(AngleSource.MEASURED, ACCEL_DPS2)
    angle_deg, speed_dps, wanted_dps = 90.0, 0.0, 0.0
    for step in range(1000):
        if step % 25 == 0:
            wanted_dps = draw.choice((0.0, SPEED_DPS, -SPEED_DPS, draw.uniform(-SPEED_DPS, SPEED_DPS)))
        more_dps = ACCEL_DPS2 * STEP_S
        speed_dps += max(-more_dps, min(more_dps, wanted_dps - speed_dps))
        angle_deg += speed_dps * STEP_S
        axis.see(step * STEP_S, angle_deg)
        span = axis.span(step * STEP_S)
        assert span.holds(angle_deg)
        assert span.holds(angle_deg + 0.1 * speed_dps + abs(speed_dps) * speed_dps / (2.0 * ACCEL_DPS2)), step


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_the_span_of_a_moteus_is_no_wider_than_its_braking_asks_for(way: int) -> None:
    """From 20°/s, and perhaps 3°/s more by now: 0.1 s at 23°/s, and 23²/40 = 13.2°. At rest it may have begun."""
    span = turning(way * 20.0, ACCEL_DPS2).span(0.0)
    ahead_deg, behind_deg = (span.max_deg - 90.0, 90.0 - span.min_deg)[::way]
    assert (ahead_deg, behind_deg) == (pytest.approx(2.3 + 13.225), 0.0)
    span = turning(0.0, ACCEL_DPS2).span(0.0)
    assert (span.min_deg, span.max_deg) == (pytest.approx(90.0 - 0.525), pytest.approx(90.0 + 0.525))


def test_the_older_its_latest_reading_the_further_it_may_be() -> None:
    axis = turning(20.0, ACCEL_DPS2)
    assert axis.span(0.2).max_deg - axis.span(0.0).max_deg == pytest.approx(0.2 * 23.0)


def test_a_motor_that_stops_at_once_runs_on_until_its_drive_obeys_and_no_further() -> None:
    """Half as fast again as the file says, for 0.1 s."""
    ends_deg = [(span.min_deg, span.max_deg) for span in (turning(way * 30.0, None).span(0.0) for way in (1, -1))]
    assert ends_deg == [(90.0, pytest.approx(90.0 + 0.1 * 45.0)), (pytest.approx(90.0 - 0.1 * 45.0), 90.0)]
    assert turning(1.0, None).span(0.0) == Range(90.0, 90.0), "so slow is the noise of an axis at rest"


def test_a_motor_that_has_only_just_begun_to_turn_is_taken_for_turning() -> None:
    axis = turning(0.0, None)
    for step, angle_deg in enumerate((90.3, 91.0, 91.9), 1):
        axis.see(step * STEP_S, angle_deg)
    assert axis.span(3 * STEP_S).max_deg > 95.0
    axis = turning(30.0, None)
    for step in range(1, 10):
        axis.see(step * STEP_S, 90.0)
    assert axis.span(9 * STEP_S) == Range(90.0, 90.0), "what it did before counts no more"


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_sent_to_a_place_where_it_can_rest_it_goes_no_further_until_that_place_moves(way: int) -> None:
    axis = turning(way * 20.0, ACCEL_DPS2)
    axis.sent(0.0, 90.0 + way * 30.0)

    def ahead_deg() -> float:
        axis.see(STEP_S, 90.0 + way * 20.0)
        span = axis.span(STEP_S)
        return (span.max_deg - 90.0) if way > 0 else (90.0 - span.min_deg)

    assert ahead_deg() == pytest.approx(30.5)
    axis.moves_on()
    assert ahead_deg() > 35.0


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_sent_to_a_place_where_it_can_rest_no_more_it_goes_beyond(way: int) -> None:
    axis = turning(way * 20.0, ACCEL_DPS2)
    axis.sent(0.0, 90.0 + way * 60.0)
    axis.sent(0.0, 90.0 + way * 3.0)
    span = axis.span(0.0)
    assert (span.max_deg - 90.0 if way > 0 else 90.0 - span.min_deg) == pytest.approx(2.3 + 13.225)
