"""A heading from the field: how the board lies, the iron that was learnt, what pulls it, and on which turn it is."""

from __future__ import annotations

import math

import pytest

from hw.ports import Ellipse, HardwareError
from hw.sensors.heading import HeadingSensor
from hw.sensors.mounting import Mounting

LEVEL_UT = 20.0
CIRCLE = Ellipse((0.0, 0.0), (20.0, 20.0))


class Chip:
    """A board with its x forward and its z up."""

    name = "QMC5883L at 0x0d"

    def __init__(self) -> None:
        self.heading_deg = 0.0
        self.iron_ut = (0.0, 0.0)
        self.share = 1.0

    def field_ut(self) -> tuple[float, float, float]:
        heading = math.radians(self.heading_deg)
        # North is so far to the left of a boom that points so far east of it.
        x, y = LEVEL_UT * self.share * math.cos(heading), LEVEL_UT * self.share * math.sin(heading)
        return x + self.iron_ut[0], y + self.iron_ut[1], -44.0


@pytest.fixture
def chip() -> Chip:
    return Chip()


@pytest.mark.parametrize("heading_deg", [0.0, 30.0, 90.0, 179.0, 181.0, 270.0, 350.0])
def test_clockwise_from_magnetic_north(chip: Chip, heading_deg: float) -> None:
    chip.heading_deg = heading_deg
    assert HeadingSensor(chip, 180.0).read() == pytest.approx(heading_deg)


@pytest.mark.parametrize(
    ("mounting", "field_ut"),
    [
        # The boom points east: north is to its left.
        (Mounting("+x", "+z"), (0.0, 20.0, -44.0)),
        (Mounting("+y", "+z"), (-20.0, 0.0, -44.0)),
        (Mounting("-x", "-z"), (0.0, 20.0, 44.0)),
        (Mounting("+x", "-z"), (0.0, -20.0, 44.0)),
        (Mounting("+z", "+y"), (20.0, -44.0, 0.0)),
        (Mounting("+x", "+y"), (0.0, -44.0, -20.0)),
    ],
)
def test_a_board_may_lie_in_any_way(mounting: Mounting, field_ut: tuple[float, float, float]) -> None:
    class Lies(Chip):
        def field_ut(self) -> tuple[float, float, float]:
            return field_ut

    assert HeadingSensor(Lies(), 180.0, mounting=mounting).read() == pytest.approx(90.0)


def test_iron_that_was_learnt_is_taken_away(chip: Chip) -> None:
    chip.iron_ut = (25.0, -8.0)
    sensor = HeadingSensor(chip, 180.0, ellipse=Ellipse((25.0, -8.0), (20.0, 20.0)))
    for heading_deg in (10.0, 100.0, 200.0, 300.0):
        chip.heading_deg = heading_deg
        assert sensor.read() == pytest.approx(heading_deg)


@pytest.mark.parametrize("share", [0.4, 1.6])
def test_a_field_that_is_not_the_learnt_one_is_no_heading(chip: Chip, share: float) -> None:
    sensor = HeadingSensor(chip, 180.0, ellipse=CIRCLE)
    chip.share = share
    with pytest.raises(HardwareError, match=rf"QMC5883L at 0x0d: the field is {share * 100:.0f} % of what it was"):
        sensor.read()


@pytest.mark.parametrize(("middle_deg", "seen_deg"), [(180.0, 190.0), (360.0, 190.0), (0.0, -170.0), (400.0, 550.0)])
def test_the_angle_is_the_one_within_the_range(chip: Chip, middle_deg: float, seen_deg: float) -> None:
    chip.heading_deg = seen_deg % 360.0
    assert HeadingSensor(chip, middle_deg).read() == pytest.approx(seen_deg)


def test_noise_a_little_beyond_an_end_is_no_jump_by_a_turn(chip: Chip) -> None:
    sensor = HeadingSensor(chip, 180.0, ellipse=CIRCLE)
    for heading_deg in (20.0, 5.0, 1.0, -1.0, 1.0, -10.0):
        chip.heading_deg = heading_deg
        assert sensor.read() == pytest.approx(heading_deg)
    chip.heading_deg = -30.0
    assert sensor.read() == pytest.approx(330.0), "so far beyond its end it cannot have turned"
