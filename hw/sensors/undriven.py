"""The changes of a cam contact while no relay is on: whether they come at the even pace of a motor under power.

Knows the cam, and the times of the latest of these changes. Knows no shaft and no count. Does not know why a motor has
power: its relay has welded, or it has another supply. Has no clock: times are arguments, in seconds.
"""

from __future__ import annotations

from collections import deque
from itertools import pairwise

from hw.sensors.cam import FASTER, Cam

LEAST_CHANGES = 4
"""Changes at rest, as far apart as at full speed, that show a motor still under power."""
SLOWEST, EVEN = 0.3, 1.5
"""A motor turns evenly at this share of its configured speed or more, if its measured speeds differ by at most this
factor."""


class UndrivenChanges:
    """Call `note` for each change of the contact while no relay is on, and `forget` when a relay closes or opens."""

    def __init__(self, cam: Cam) -> None:
        self._cam = cam
        self._latest: deque[tuple[float, bool]] = deque(maxlen=LEAST_CHANGES)
        """For each change: its time, and whether the contact closed."""

    def note(self, at_s: float, *, closed: bool) -> None:
        self._latest.append((at_s, closed))

    def forget(self) -> None:
        self._latest.clear()

    def show_motor(self, now_s: float) -> bool:
        """Whether the latest changes, and the time since the last one, are those of a motor that runs."""
        if len(self._latest) < LEAST_CHANGES:
            return False
        # Wind can rock the antenna about an edge. Then the contact changes as often, but never as evenly.
        shares = [
            self._cam.crossing_s(closed=closed) / max(later_s - earlier_s, 1e-6)
            for (earlier_s, closed), (later_s, _) in pairwise([*self._latest, (now_s, False)])
        ]
        *crossed, present = shares
        slowest, fastest = min(crossed), max(crossed)
        even = slowest >= SLOWEST and fastest <= EVEN * slowest
        return fastest <= FASTER and (even or slowest >= 1 / FASTER) and present >= min(1.0, slowest) / FASTER
