"""From text to angles in degrees, from angles to an order, and from an angle to whole numbers, for every protocol.

Knows how programs write a number: the one reader of decimals for all protocols. Numbers are rounded half up, as the
controllers do that the box stands in for. Does not know which angles the box obeys: `rotator.control.admission` does.
"""

from __future__ import annotations

import math
import re

from hw.ports import Axis
from rotator.control.admission import SENT_DEG, WIDEST_DEG
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Refusal


def whole(number: float) -> int:
    """Rounded half up: 0.5 becomes 1, and -0.5 becomes 0."""
    return math.floor(number + 0.5)


def bearing(azimuth_deg: float) -> int:
    """In whole degrees, 0 to 360; on a further turn of the overlap the same direction of the first turn."""
    rounded_deg = whole(azimuth_deg)
    return rounded_deg if 0 <= rounded_deg <= 360 else rounded_deg % 360


NUMBER = r"[+-]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)(?:[eE][+-]?[0-9]+)?"
"""Programs write `1e-05` (Java, C#), 17 digits, `.5` (Visual Basic) and `12,4` (a European desktop)."""
SURE_NUMBER = r"(?:[0-9]+(?:[eE][+-][0-9]+)?|[+-]?(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
"""Where a controller knows whole digits alone: without what one damaged digit can make of them, `-35` or `2e5`."""
_NUMBER = re.compile(rf"[ \t]*({NUMBER}),?[ \t]*")


def degrees(text: str) -> float | None:
    """Any finite decimal number, with a point or a comma, and perhaps a comma behind it. None: it is not one number.

    Unlike C's `scanf` it takes no `nan`, no hexadecimal number, and none with other text behind it: `1x0` is not 1.
    """
    found = _NUMBER.fullmatch(text)
    number = float(found[1].replace(",", ".")) if found else math.inf
    return number if math.isfinite(number) else None


def aim(azimuth_deg: float | None, elevation_deg: float | None) -> Aim:
    """The order for these angles; an axis that is None keeps its target.

    A negative azimuth is a direction. From zero on an azimuth can also name a turn of the overlap. Numbers outside
    the range that the box takes are passed on as they are: the box refuses them, and the log names number and range.
    """
    if azimuth_deg is not None and SENT_DEG[Axis.AZIMUTH][0] <= azimuth_deg < 0:
        azimuth_deg %= 360
    return Aim(azimuth_deg, elevation_deg)


def outside(azimuth_deg: float, top_deg: float) -> Refusal:
    """An azimuth that the protocol does not have."""
    return Refusal(f"azimuth {azimuth_deg:g} is outside 0 to {top_deg:g} degrees", out_of_range=True)


def may_be_sent(azimuth_deg: float, elevation_deg: float) -> bool:
    """Whether some rotor has these angles."""
    angles_deg = {Axis.AZIMUTH: azimuth_deg, Axis.ELEVATION: elevation_deg}
    return all(WIDEST_DEG[axis][0] <= angle_deg <= WIDEST_DEG[axis][1] for axis, angle_deg in angles_deg.items())
