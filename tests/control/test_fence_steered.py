"""The last line before a sector, for axes that go to an angle by themselves: where a command is cut short, or held."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.positioned import PositionedAxis
from rotator.control.axis.readings import Reading, Window
from rotator.control.axis.settings import PositionedSettings
from rotator.control.commands import HOLD, Command, Steer
from rotator.control.fence import Fence
from rotator.control.sky.mount import Mount, Range, Sector

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
LIMITS = {AZ: Range(0.0, 450.0), EL: Range(0.0, 180.0)}
TOWER = Sector("the tower", Range(100.0, 130.0), Range(0.0, 35.0), 2.0)
STEP_S = 0.05
BOTH_SIDES = pytest.mark.parametrize(
    ("from_deg", "way", "edge_deg"), [(60.0, PLUS, 98.0), (170.0, MINUS, 132.0)], ids=["up to it", "down to it"]
)


class Steered:
    """Two drives that are at the commanded angle at once, and a fence before them."""

    def __init__(self, azimuth_deg: float, elevation_deg: float = 10.0, sectors: tuple[Sector, ...] = (TOWER,)) -> None:
        self.axes = {axis: self._axis(axis) for axis in Axis}
        self.fence = Fence(Mount(LIMITS[AZ], LIMITS[EL], sectors=sectors), self.axes, period_s=STEP_S)
        self.angle_deg = {AZ: azimuth_deg, EL: elevation_deg}
        self.dead: set[Axis] = set()
        """The axes whose sensors do not answer."""
        self.now_s = 10.0
        self.commands: dict[Axis, Command] = {}
        self.step(0.3)

    @staticmethod
    def _axis(axis: Axis) -> PositionedAxis:
        limits = LIMITS[axis]
        line = Calibration(((limits.min_deg, limits.min_deg), (limits.max_deg, limits.max_deg)))
        return PositionedAxis(PositionedSettings(axis, limits, 1.0, 20.0, Window(-10.0, 460.0), line), lease_s=0.25)

    def step(self, seconds: float = STEP_S) -> dict[Axis, Command]:
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            for axis, control in self.axes.items():
                control.see(Reading(self.now_s, None if axis in self.dead else self.angle_deg[axis]), self.now_s)
            wishes = {axis: control.decide(self.now_s).command for axis, control in self.axes.items()}
            self.commands = self.fence.passed(self.now_s, wishes)
            for axis, command in self.commands.items():
                if isinstance(command, Steer):
                    most_deg = 20.0 * STEP_S
                    gone_deg = command.angle_deg - self.angle_deg[axis]
                    self.angle_deg[axis] += max(-most_deg, min(most_deg, gone_deg))
        return self.commands

    def notices(self, axis: Axis) -> list[str]:
        return [notice.text for notice in self.fence.notices(axis, self.now_s)]


@BOTH_SIDES
def test_a_jog_is_led_to_a_place_just_before_the_sector_and_ends_there(
    from_deg: float, way: Direction, edge_deg: float
) -> None:
    steered = Steered(from_deg)
    steered.axes[AZ].jog(way, None, steered.now_s)
    steered.step(5.0)
    assert 0.0 < (edge_deg - steered.angle_deg[AZ]) * way < 2.5
    assert steered.commands[AZ] is HOLD
    assert not steered.axes[AZ].busy


@BOTH_SIDES
def test_beside_the_sector_a_jog_into_it_does_not_begin_and_one_away_does(
    from_deg: float, way: Direction, edge_deg: float
) -> None:
    steered = Steered(edge_deg - 0.8 * way)
    steered.axes[AZ].jog(way, None, steered.now_s)
    assert steered.step()[AZ] is HOLD
    assert steered.notices(AZ) == ["stopped before the tower"]
    assert not steered.axes[AZ].busy
    steered.axes[AZ].jog(Direction(-way), None, steered.now_s)
    assert isinstance(steered.step()[AZ], Steer)


def test_an_axis_whose_angle_is_not_known_holds_the_other_back_and_is_named() -> None:
    steered = Steered(60.0, 60.0)
    steered.dead.add(EL)
    steered.step(1.0)
    steered.axes[AZ].jog(PLUS, None, steered.now_s)
    for _ in range(80):
        steered.step()
        assert steered.angle_deg[AZ] < 98.0, "it may stand at any elevation"
    steered.dead.clear()
    steered = Steered(97.2, 60.0)
    steered.dead.add(EL)
    steered.step(1.0)
    steered.axes[AZ].jog(PLUS, None, steered.now_s)
    steered.step()
    assert steered.notices(AZ) == [
        "does not turn: the angle of elevation is not known, and the tower may be in the way"
    ]
