"""From two angles in degrees to an order, for every protocol that sends degrees.

Knows how programs write an angle. Does not know which angles the box obeys: `rotator.control.admission` does.
"""

from __future__ import annotations

import re

from hw.ports import Axis
from rotator.control.admission import SENT_DEG
from rotator.exchange.orders import Aim

_DEGREES = re.compile(r"[+-]?[0-9]{1,3}(?:[.,][0-9]{0,9})?")


def degrees(text: str) -> float | None:
    """An angle as programs write it, with a decimal point or comma. None: the text is not one number."""
    return float(text.replace(",", ".")) if _DEGREES.fullmatch(text) else None


def aim(azimuth_deg: float | None, elevation_deg: float | None) -> Aim:
    """The order for these angles; an axis that is None keeps its target.

    A negative azimuth is a direction. From zero on an azimuth can also name a turn of the overlap. Numbers outside
    the range that the box takes are passed on as they are: the box refuses them, and the log names number and range.
    """
    if azimuth_deg is not None and SENT_DEG[Axis.AZIMUTH][0] <= azimuth_deg < 0:
        azimuth_deg %= 360
    return Aim(azimuth_deg, elevation_deg)


def may_be_sent(azimuth_deg: float, elevation_deg: float) -> bool:
    """Whether these angles are within the range that the box takes."""
    angles_deg = {Axis.AZIMUTH: azimuth_deg, Axis.ELEVATION: elevation_deg}
    return all(SENT_DEG[axis][0] <= angle_deg <= SENT_DEG[axis][1] for axis, angle_deg in angles_deg.items())
