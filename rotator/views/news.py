"""What a person who does not look at the box has to know: a pass comes, a fault, a stop.

Compares each status with the one before, and tells what is new. Times are arguments. Knows no network.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from rotator.exchange.spoken import spoken
from rotator.exchange.status import Status, time_left
from rotator.views.words import degrees, stopped_by

AGAIN_S = 300.0
"""A fault that comes and goes within it is told once. A pass that is planned again rises at nearly the same moment."""


@dataclass(frozen=True, slots=True)
class Notice:
    """`event`: pass, fault or stop. `title`: a few words. `at_utc_s`: when it was true."""

    event: str
    title: str
    text: str
    at_utc_s: float


class News:
    """`events`: those that are told. `before_s`: so long before its rise a pass is told."""

    def __init__(self, events: Collection[str], before_s: float) -> None:
        self._events = events
        self._before_s = before_s
        self._stopped = ""
        self._told_s: dict[str, float] = {}
        """The faults and passes that were told, each with its latest moment."""

    def step(self, status: Status, upcoming: tuple[str, float] | None, utc_s: float) -> list[Notice]:
        """`upcoming`: the next pass of the plan, and when it rises in seconds since 1970; None: none is known."""
        found, flown = [], status.flown
        if status.latched and status.latched != self._stopped:
            found.append(Notice("stop", stopped_by(status), "Nothing moves before a person lets it.", utc_s))
        self._stopped = status.latched
        for axis in status.fitted:
            if (fault := status.axis(axis).fault) and self._is_new(f"FAULT {axis.value}: {fault.kind.text}", utc_s):
                found.append(Notice("fault", f"FAULT {axis.value}: {fault.kind.text}", spoken(str(fault)), utc_s))
        if flown is not None and flown.begin_s > status.at_s:
            upcoming = flown.name, utc_s + flown.begin_s - status.at_s
        if upcoming and 0.0 < upcoming[1] - utc_s <= self._before_s and self._is_new(*upcoming):
            text = f"The antenna points to azimuth {degrees(status.azimuth.points_deg, 0)}."
            found.append(Notice("pass", f"{upcoming[0]} comes in {time_left(upcoming[1] - utc_s)}", text, utc_s))
        return [each for each in found if each.event in self._events]

    def _is_new(self, name: str, at_s: float) -> bool:
        before_s, self._told_s[name] = self._told_s.get(name, 0.0), at_s
        return abs(at_s - before_s) > AGAIN_S
