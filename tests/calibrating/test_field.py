"""A compass learns its iron: the antenna turns once round by hand, on the simulated chips."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

import pytest

from firmware_sim.chips.hmc5883l import H43
from hw.ports import HardwareError
from rotator.calibrating.field_guide import NotLearnt, fitted
from rotator.calibrating.results import as_toml
from rotator.calibrating.rig import FieldRig
from rotator.config.load import parse
from tests.calibrating.rig import QUIET, Calibration

CHIP = """
[azimuth]
min_deg = 5
max_deg = 355
[azimuth.sensor]
kind = "hmc5883l"
[sim.azimuth]
speed_dps = 30
[mount]
north = "magnetic"
declination_deg = 4.1
"""


class FieldCalibration(Calibration):
    def _build_rig(self, config: Any) -> None:
        self.rig = FieldRig(config, self.station, self.clock)


def begun(text: str = CHIP) -> FieldCalibration:
    return FieldCalibration(parse(text + QUIET, "test"), start_deg=(5.0, 0.0), bad_luck="azimuth-iron-near")


def test_one_turn_tells_what_the_iron_adds() -> None:
    run = begun()
    run.drive("R", 2)
    assert "turn the antenna further round" in run.say("")
    run.drive("R", 5)
    said = run.say("", "y")
    assert "Iron adds 25." in said
    assert run.guide.ended
    centre, radius = run.guide.result.ellipse.centre_ut, run.guide.result.ellipse.radius_ut
    assert centre == pytest.approx((25.0, 0.0), abs=0.3)
    assert radius == pytest.approx((20.0, 20.0), abs=0.3)
    assert as_toml(run.guide.result).startswith("[azimuth.sensor]\ncentre_ut = [2")


def test_the_axis_is_not_set_up_before(calibration: Callable[..., Calibration]) -> None:
    assert H43, "the chip is there"
    with pytest.raises(HardwareError, match="rotator calibrate compass"):
        calibration(CHIP)
    assert calibration(CHIP.replace('"hmc5883l"', '"hmc5883l"\nradius_ut = [20, 20]')).guide.prompt


def test_an_azimuth_with_a_pot_has_nothing_to_learn() -> None:
    with pytest.raises(HardwareError, match="the azimuth has no compass as its sensor"):
        FieldCalibration(parse(QUIET, "test"))


def turned(
    degrees: range, *, radius: tuple[float, float] = (20.0, 18.0), noise_ut: float = 0.0
) -> list[tuple[float, float]]:
    chance = random.Random(1)

    def at(angle_deg: int) -> tuple[float, float]:
        angle = math.radians(angle_deg)
        return (
            -31.0 + radius[0] * math.cos(angle) + chance.gauss(0.0, noise_ut),
            44.0 + radius[1] * math.sin(angle) + chance.gauss(0.0, noise_ut),
        )

    return [at(degree) for degree in degrees]


def test_the_ellipse_of_a_noisy_turn() -> None:
    ellipse, off_deg = fitted(turned(range(5, 355, 3), noise_ut=0.3))
    assert ellipse.centre_ut == pytest.approx((-31.0, 44.0), abs=0.2)
    assert ellipse.radius_ut == pytest.approx((20.0, 18.0), abs=0.2)
    assert off_deg == pytest.approx(math.degrees(0.3 / 19.0), rel=0.3)


@pytest.mark.parametrize(
    ("points", "why"),
    [
        (turned(range(30)), "hardly changed"),
        (turned(range(0, 200, 3)), "of 12 parts of a turn"),
        (turned(range(0, 360, 3), radius=(30.0, 15.0)), "stretches the ring too much"),
        (turned(range(0, 360, 3), noise_ut=5.0), "does not lie on a ring"),
    ],
)
def test_what_shows_no_whole_ring_is_not_learnt(points: list[tuple[float, float]], why: str) -> None:
    with pytest.raises(NotLearnt, match=why):
        fitted(points)
