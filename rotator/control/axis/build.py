"""From settings to the axis of that kind: switched by relays, or positioned by its drive.

The only place that names all kinds. Knows no configuration file and no hardware.
"""

from __future__ import annotations

from rotator.control.axis.absent import AbsentAxis
from rotator.control.axis.port import ControlledAxis
from rotator.control.axis.positioned import PositionedAxis
from rotator.control.axis.settings import AbsentSettings, AxisSettings, PositionedSettings, SwitchedSettings
from rotator.control.axis.switched import SwitchedAxis


def build_axis(settings: AxisSettings, *, lease_s: float, period_s: float) -> ControlledAxis:
    match settings:
        case SwitchedSettings():
            return SwitchedAxis(settings, lease_s=lease_s, period_s=period_s)
        case PositionedSettings():
            return PositionedAxis(settings, lease_s=lease_s)
        case AbsentSettings():
            return AbsentAxis(settings)
