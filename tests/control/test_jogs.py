"""Whose jog turns an axis: one without a time ends with the connection that ordered it, and with no other."""

from __future__ import annotations

from typing import cast

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.port import ControlledAxis
from rotator.control.jogs import Jogs
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Jog
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS = Direction.PLUS
LINK, AGAIN, OTHER = Source("rotctld", 1), Source("rotctld", 2), Source("gs232b", 1)


class TurningAxis:
    """As much of an axis as a jog needs."""

    def __init__(self) -> None:
        self.begun: list[tuple[Direction, float | None, float]] = []
        self.jog_is_held = False
        self.missing: tuple[Missing, ...] = ()
        self.driven = self.pressed_in_vain = False

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        self.begun.append((direction, seconds, now_s))
        self.jog_is_held = held or seconds is None

    def halt(self) -> None:
        self.jog_is_held = False
        self.begun.clear()


@pytest.fixture
def axes() -> dict[Axis, TurningAxis]:
    return {axis: TurningAxis() for axis in Axis}


@pytest.fixture
def jogs(axes: dict[Axis, TurningAxis]) -> Jogs:
    return Jogs(cast(dict[Axis, ControlledAxis], axes))


def test_a_link_s_presses_on_an_axis_that_is_not_commissioned_make_one_turn_of_two_seconds(
    jogs: Jogs, axes: dict[Axis, TurningAxis]
) -> None:
    axes[AZ].missing = (Missing.LIMITS,)
    jogs.begin(Jog(AZ, PLUS, 30.0), LINK, 20.0)
    jogs.note_driven(20.0)
    axes[AZ].driven = True
    jogs.note_driven(21.5)
    jogs.begin(Jog(AZ, PLUS, None), OTHER, 21.5)
    jogs.note_driven(22.0)
    jogs.begin(Jog(AZ, PLUS, 30.0), LINK, 22.0)
    assert [seconds for _, seconds, _ in axes[AZ].begun] == [2.0, 0.5], "and the third press counts no more"
    axes[AZ].driven = False
    jogs.note_driven(22.7)
    jogs.begin(Jog(AZ, PLUS, 1.0), LINK, 22.7)
    assert len(axes[AZ].begun) == 2, "it rests for 0.8 s first"
    jogs.begin(Jog(AZ, PLUS, 1.0), Source("page", 1), 22.7)
    assert len(axes[AZ].begun) == 2, "and so it is for the page, where a program may press"
    jogs.begin(Jog(AZ, PLUS, 1.0), Source("console"), 22.7)
    assert len(axes[AZ].begun) == 3, "a person may press"
    jogs.note_driven(22.9)
    jogs.begin(Jog(AZ, PLUS, 1.0), LINK, 22.9)
    assert len(axes[AZ].begun) == 4


@pytest.mark.parametrize("person", ["console", "panel", "page", "calibrate"])
def test_where_presses_moved_nothing_a_person_may_press_and_a_link_may_not(
    jogs: Jogs, axes: dict[Axis, TurningAxis], person: str
) -> None:
    axes[AZ].missing, axes[AZ].pressed_in_vain = (Missing.CALIBRATION,), True
    for source in (LINK, OTHER):
        jogs.begin(Jog(AZ, PLUS), source, 20.0)
    assert axes[AZ].begun == []
    jogs.begin(Jog(AZ, PLUS), Source(person, 1), 20.0)
    assert len(axes[AZ].begun) == 1
    jogs.begin(Jog(AZ, Direction.OFF), LINK, 20.5)
    assert axes[AZ].begun[-1][0] is Direction.OFF, "to let go is never refused"
