"""What is above the horizon now or in the next minutes, each with the path of its present pass, for a picture.

Knows targets and their passes. Does not know the rotor, nor how the sky is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

from rotator.orbits.passes import LOOK_S, Pass, passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Sight, Target

NEAR_S, NEAR_DEG = 120, -6.0
"""Seconds between two looks: what is lower at both does not rise and set again between them."""
SLOW_S, SLOW_LOOK_S = 20_000.0, 600.0
"""What takes longer than this for one revolution stays up for hours: fewer looks find its rise and its set."""
LEGS = 40
"""Straight pieces of a path."""


@dataclass(frozen=True, slots=True)
class Overhead:
    """`path`: the directions from `from_s` on, `step_s` seconds apart."""

    found: Pass
    from_s: float
    step_s: float
    path: list[Sight]


def overhead(target: Target, now_s: float, until_s: float) -> Iterator[Overhead]:
    """Each pass of it that is up at some moment between the two times. A satellite that has decayed has none."""
    slow = not isinstance(target, Satellite) or target.period_s > SLOW_S
    with suppress(NotThere):
        looks_s = (*range(int(now_s), int(until_s), NEAR_S), until_s)
        if not any(target.sight(look_s).elevation_deg > NEAR_DEG for look_s in looks_s):
            return
        for found in passes(target, now_s, until_s, every_s=SLOW_LOOK_S if slow else LOOK_S):
            from_s = now_s if found.aos_s is None else found.aos_s
            step_s = ((until_s if found.los_s is None else found.los_s) - from_s) / LEGS
            yield Overhead(found, from_s, step_s, [target.sight(from_s + step_s * leg) for leg in range(LEGS + 1)])
