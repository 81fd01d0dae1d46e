"""Where an axis that goes to an angle by itself may be, and where it would come to rest."""

from __future__ import annotations

import itertools
import random

import pytest

from hw.ports import AngleSource, Axis
from rotator.control.axis.pace import SLOWEST, Pace
from rotator.control.axis.sensing import Window
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
@pytest.mark.parametrize("share", [SLOWEST, 0.6, 1.0])
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


def test_a_motor_that_has_passed_its_place_by_a_hair_still_comes_to_rest_there() -> None:
    of_a_moteus = pace(AngleSource.MEASURED, ACCEL_DPS2)
    place_deg, speed_dps, angle_deg = 117.0, 12.0, 113.4
    of_a_moteus.see(-STEP_S, angle_deg - speed_dps * STEP_S)
    of_a_moteus.see(0.0, angle_deg)
    for step in itertools.count(1):
        now_s = step * STEP_S
        of_a_moteus.sent(now_s, place_deg)
        speed_dps = max(0.0, speed_dps - ACCEL_DPS2 * STEP_S)
        angle_deg += speed_dps * STEP_S + (0.01 if speed_dps == 0.0 else 0.0)
        of_a_moteus.see(now_s, angle_deg)
        if angle_deg > place_deg + 0.05:
            break
    assert of_a_moteus.span(now_s).max_deg == pytest.approx(117.5)
