"""A path that runs faster than its motor, as azimuth does near the zenith: the motor sets off before it and ends later.

Knows the angles of one axis at even moments, and how far its motor turns between two of them. Does not know the sky.
"""

from __future__ import annotations

from collections.abc import Sequence


def led(angles_deg: Sequence[float], travel_deg: float) -> list[float]:
    """The same path where the motor can follow it. Where it cannot, an even turn with as much of it before as after."""
    led_deg, last = list(angles_deg), len(angles_deg) - 1
    moment = 0
    while moment < last:
        if not _too_fast(angles_deg, moment, travel_deg):
            moment += 1
            continue
        begin, end = moment, moment + 1
        while end < last and _too_fast(angles_deg, end, travel_deg):
            end += 1
        while abs(angles_deg[end] - angles_deg[begin]) > travel_deg * (end - begin) and (begin or end < last):
            begin, end = max(begin - 1, 0), min(end + 1, last)
        by_deg = (angles_deg[end] - angles_deg[begin]) / (end - begin)
        for at in range(begin, end + 1):
            led_deg[at] = angles_deg[begin] + by_deg * (at - begin)
        moment = end
    return led_deg


def _too_fast(angles_deg: Sequence[float], moment: int, travel_deg: float) -> bool:
    return abs(angles_deg[moment + 1] - angles_deg[moment]) > travel_deg
