"""Both kinds of axis answer the same questions; what one kind cannot do it refuses with a reason for a person."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import AngleSource, Axis
from rotator.control.axis.build import build_axis
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.port import ControlledAxis
from rotator.control.axis.readings import ANYTHING
from rotator.control.axis.settings import AxisSettings, PositionedSettings, SwitchedSettings
from rotator.control.refused import Refused
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Motor

MEASURED = SwitchedSettings(Axis.AZIMUTH, Range(0, 450), 4.0, Motor(6.0, 1.0), ANYTHING, None)
COUNTED = replace(MEASURED, source=AngleSource.COUNTED, homing=HomingSettings(0.8, 75.0, 0.5, 0.0))
POSITIONED = PositionedSettings(Axis.AZIMUTH, Range(0, 450), 1.0, 30.0, ANYTHING, None)


def built(settings: AxisSettings) -> ControlledAxis:
    return build_axis(settings, lease_s=0.25, period_s=0.05)


@pytest.mark.parametrize(
    ("settings", "has_relays", "homeable"),
    [(MEASURED, True, False), (COUNTED, True, True), (POSITIONED, False, False)],
    ids=["measured", "counted", "positioned"],
)
def test_each_kind_says_what_it_has(settings: AxisSettings, has_relays: bool, homeable: bool) -> None:
    axis = built(settings)
    assert (axis.has_relays, axis.homeable) == (has_relays, homeable)
    assert (axis.homing, axis.waits, axis.busy) == (False, False, False)


def test_a_positioned_axis_has_no_ends_and_no_relays() -> None:
    axis = built(POSITIONED)
    with pytest.raises(Refused, match="it needs no ends"):
        axis.calibrate_end(high_end=True)
    with pytest.raises(Refused, match="azimuth has no relays"):
        axis.checked()
