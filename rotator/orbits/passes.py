"""When a target rises and sets: passes, found from its elevation alone.

Knows that elevation has one highest point between two lows, and how far apart to look so that none is missed. Does not
know orbits, masks or the rotor.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rotator.orbits.sight import NotThere, Sight, Target

LOOK_S = 60.0
"""Seconds between two looks. The highs of the lowest orbits are 90 minutes apart; between two looks the elevation is
nearly a parabola."""
EXACT_S = 0.01
LONGEST_S = 86_400.0
"""Seconds: a target that is up for longer has no rise or no set: a geostationary satellite, the polar Sun."""
_GOLDEN = (5**0.5 - 1) / 2


@dataclass(frozen=True, slots=True)
class Pass:
    """From rise to set, in seconds since 1970 (UTC). None: it is up for more than a day before, or after."""

    name: str
    aos_s: float | None
    los_s: float | None
    tca_s: float
    """When the target is highest: the closest approach of a satellite."""
    aos: Sight | None
    los: Sight | None
    highest: Sight


def passes(
    target: Target, from_s: float, until_s: float, least_deg: float = 0.0, *, every_s: float = LOOK_S
) -> Iterator[Pass]:
    """Each pass that lies at least partly between the two times, in order, with its whole length.

    `least_deg`: passes that stay lower are left out. A satellite that has decayed has none, and its last ends there.
    `every_s`: between two looks; what takes hours to cross the sky needs fewer.
    """
    height = _height(target)
    on_s = from_s if height(from_s) > 0 else None
    at_s: float | None = from_s if on_s is None else _last_down_s(height, from_s, every_s)
    if at_s is None:  # it never rose
        found = _pass(target, height, None, from_s, every_s)
        if found.highest.elevation_deg >= least_deg:
            yield found
        at_s = found.los_s
    while at_s is not None:
        rise = _next_rise(height, at_s, until_s, every_s)
        if rise is None:
            return
        aos_s = _crossing_s(height, *rise)
        if aos_s >= until_s:
            return
        found = _pass(target, height, aos_s, rise[1], every_s)
        if found.highest.elevation_deg >= least_deg:
            yield found
        at_s = None if found.los_s is None else found.los_s + EXACT_S


def _next_rise(
    height: Callable[[float], float], from_s: float, until_s: float, every_s: float
) -> tuple[float, float] | None:
    """A time at which it is down and a later one at which it is up, with one rise between them, before `until_s`."""
    look_s, before, here = from_s, height(from_s - every_s), height(from_s)
    while look_s < until_s:
        after = height(look_s + every_s)
        if after > 0:
            return look_s, look_s + every_s
        if here >= max(before, after):  # it may rise and set between two looks
            top_s = _highest_s(height, look_s - every_s, look_s + every_s)
            if top_s > from_s and height(top_s) > 0:
                return (look_s if look_s < top_s else max(from_s, look_s - every_s)), top_s
        look_s, before, here = look_s + every_s, here, after
    return None


def _pass(target: Target, height: Callable[[float], float], aos_s: float | None, up_s: float, every_s: float) -> Pass:
    """The pass that is on at `up_s` and has risen at `aos_s`."""
    looks = [(height(up_s), up_s)]
    while looks[-1][0] > 0 and looks[-1][1] < up_s + LONGEST_S:
        looks.append((height(looks[-1][1] + every_s), looks[-1][1] + every_s))
    los_s = _crossing_s(height, looks[-1][1], looks[-2][1]) if looks[-1][0] <= 0 else None
    highest_look_s = max(looks)[1]
    first_s, last_s = up_s if aos_s is None else aos_s, looks[-1][1] if los_s is None else los_s
    tca_s = _highest_s(height, max(first_s, highest_look_s - every_s), min(last_s, highest_look_s + every_s))
    return Pass(
        name=target.name,
        aos_s=aos_s,
        los_s=los_s,
        tca_s=tca_s,
        aos=None if aos_s is None else target.sight(aos_s),
        los=None if los_s is None else target.sight(los_s),
        highest=target.sight(tca_s),
    )


def _last_down_s(height: Callable[[float], float], from_s: float, every_s: float) -> float | None:
    """A time within the day before at which it was down; None: it was always up."""
    at_s = from_s
    while at_s > from_s - LONGEST_S:
        at_s -= every_s
        if height(at_s) <= 0:
            return at_s
    return None


def _crossing_s(height: Callable[[float], float], down_s: float, up_s: float) -> float:
    """When the target passes the horizon between a moment below it and a moment above, at which it is still there."""
    while abs(up_s - down_s) > EXACT_S:
        middle_s = (down_s + up_s) / 2
        if height(middle_s) > 0:
            up_s = middle_s
        else:
            down_s = middle_s
    return up_s


def _highest_s(height: Callable[[float], float], from_s: float, until_s: float) -> float:
    """The time of the highest elevation in an interval with one high (golden section)."""
    a, b = until_s - _GOLDEN * (until_s - from_s), from_s + _GOLDEN * (until_s - from_s)
    height_a, height_b = height(a), height(b)
    while until_s - from_s > EXACT_S:
        if height_a >= height_b:
            until_s, b, height_b = b, a, height_a
            a = until_s - _GOLDEN * (until_s - from_s)
            height_a = height(a)
        else:
            from_s, a, height_a = a, b, height_b
            b = from_s + _GOLDEN * (until_s - from_s)
            height_b = height(b)
    return a if height_a >= height_b else b


def _height(target: Target) -> Callable[[float], float]:
    """The elevation by time. A satellite that has decayed is always below the horizon."""

    def height(utc_s: float) -> float:
        try:
            return target.sight(utc_s).elevation_deg
        except NotThere:
            return -90.0

    return height
