"""What a plan is told of the motors: play that a person knows is allowed for at each step of a planned pass."""

from __future__ import annotations

import pytest

from rotator.assembly.settings import planned_motors
from rotator.config.model import Config
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range


def places_deg(backlash_deg: float) -> list[float]:
    """Where azimuth steps to on a target that goes to the right and back."""
    config = Config.model_validate({"azimuth": {"backlash_deg": backlash_deg}})
    there = [(float(t), 100.0 + t / 4, 20.0) for t in range(240)]
    back = [(240.0 + t, 160.0 - t / 4, 20.0) for t in range(240)]
    mount = Mount(Range(0, 450), Range(0, 90))
    antenna = Antenna(mount, *planned_motors(config), (100.0, 20.0))
    plan = plan_flight("ISS", KnownPath((*there, *back)), antenna, 0.0)
    return [step.place_deg for step in plan.order.azimuth.steps]


def test_known_play_is_led_by_half_on_the_way_there_and_on_the_way_back() -> None:
    plain, led = places_deg(0.0), places_deg(3.0)
    assert len(led) == len(plain) > 10
    turn = plain.index(max(plain))
    shifts = [after - before for before, after in zip(plain, led, strict=True)]
    assert shifts[1 : turn + 1] == pytest.approx([1.5] * turn)
    assert shifts[turn + 1 :] == pytest.approx([-1.5] * (len(plain) - turn - 1))
