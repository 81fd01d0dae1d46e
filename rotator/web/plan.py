"""The sky for the page: the passes of the next day with their plan, the next pass, and the order of the targets.

Knows the output of `rotator sky passes --json`. The order that a person drags is stored beside the configuration, which
does not change. Does not know how a plan is made.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from functools import partial
from typing import Annotated, Any

from aiohttp import web
from typing_extensions import TypedDict

from rotator.config.sky import FollowTable
from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.protocols.methods import WrongValuesError
from rotator.store.priorities import Priorities
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.ranking import ranked
from rotator.web.entrance import computed, error, values_of
from rotator.web.passes import ManyPasses, Pass, Passes
from rotator.web.route import COMPUTING, Route, get, post
from rotator.web.schema import Body, Pair, Sent, the

Fields = dict[str, Any]
LONGEST_ORDER = 16_384
LEAST_DEG = 10.0
"""Degrees: without a plan the next pass is the first that rises this high."""
POINTS = 40
"""Points of the path of the next pass."""


class _Next(Pass):
    points: Annotated[list[Pair], the("azimuth and elevation")]


class _None(TypedDict):
    """There is none."""


class _Followed(TypedDict):
    name: Annotated[str, the("as in the file")]
    target: Annotated[str, the("its own name")]
    priority: float
    written: Annotated[float, the("the priority of the file")]
    least_deg: Annotated[float, the("lower passes are not flown")]
    fault: Annotated[str, the("why it is not known; empty: it is")]


_FollowedList = TypedDict("_FollowedList", {"followed": list[_Followed]})


class _Order(Sent):
    order: Annotated[list[str] | None, the("each name once; null: as the file says")]


_ORDER = Body((_Order, {"order": None}), hint="the order of the file; or each name of /api/followed once")


class Plan:
    """`changed` is called when the order has changed. `utc` gives seconds since 1970."""

    def __init__(
        self,
        follow: Sequence[FollowTable],
        sky: KnownSky,
        priorities: Priorities,
        passes: Passes,
        *,
        changed: Callable[[], None],
        utc: Callable[[], float],
    ) -> None:
        self._follow = follow
        self._sky = sky
        self._priorities = priorities
        self._passes = passes
        self._changed = changed
        self._utc = utc
        self._next: tuple[str, Fields] = ("", {})
        """The next pass as last sent, by its name and rise."""

    def routes(self) -> Sequence[Route]:
        async def passes(_request: web.Request) -> web.StreamResponse:
            return computed(self._passes.answer())

        async def upcoming(_request: web.Request) -> web.StreamResponse:
            return computed(self.upcoming())

        async def followed(_request: web.Request) -> web.StreamResponse:
            return web.json_response({"followed": self.followed()})

        async def order(request: web.Request) -> web.StreamResponse:
            names = _ORDER.read(await values_of(request, LONGEST_ORDER))["order"]
            change = self.as_written if names is None else partial(self.reorder, names)
            reason = await asyncio.to_thread(change)
            self._changed()
            return error(409, reason) if reason else web.json_response({"ok": True})

        day = "The passes of the next day, as `rotator sky passes --json`", ManyPasses
        anew = "What is followed in a new order: what stands first counts most"
        return (
            get("/api/passes", passes, day, more=COMPUTING),
            get("/api/next", upcoming, ("The next pass, with its path", _Next | _None), more=COMPUTING),
            get("/api/followed", followed, ("What the file follows, the highest priority first", _FollowedList)),
            post("/api/followed", order, anew, _ORDER, most_body=LONGEST_ORDER),
        )

    # --- what is followed

    def followed(self) -> list[_Followed]:
        """The targets of the configuration, the highest priority first."""
        rows = [self._row(each) for each in self._follow]
        return sorted(rows, key=lambda row: -row["priority"])

    def _row(self, each: FollowTable) -> _Followed:
        target, fault = "", ""
        try:
            wanted = self._sky.find(each.name)
            target = "" if isinstance(wanted, Aim) else wanted.target().name
        except (Unknown, NotThere) as reason:
            fault = str(reason)
        return {
            "name": each.name,
            "target": target or each.name,
            "priority": self._priorities.of(each.name, each.priority),
            "written": each.priority,
            "least_deg": each.min_culmination_deg,
            "fault": fault,
        }

    def reorder(self, names: Sequence[str]) -> str:
        """Set the priorities by this order, the most important first. Returns why not; empty: done."""
        written = {each.name: each.priority for each in self._follow}
        if sorted(names) != sorted(written):
            raise WrongValuesError("order must name each followed target once: GET /api/followed lists them")
        inforce = [self._priorities.of(name, priority) for name, priority in written.items()]
        return self._put(dict(zip(names, ranked(inforce), strict=True)), written)

    def as_written(self) -> str:
        """Restore the priorities of the configuration."""
        written = {each.name: each.priority for each in self._follow}
        return self._put(written, written)

    def _put(self, priorities: Mapping[str, float], written: Mapping[str, float]) -> str:
        kept = self._priorities.change(priorities, written)
        return "" if kept else "the order counts, but it cannot be kept: the log tells why"

    # --- the next pass

    def upcoming(self) -> Fields | None:
        """The next pass of the plan, or the next good one without a plan, with its path; {}: none; None: ask again."""
        if not self._sky.elements and not self._follow:
            return {}
        passes = self._passes.known
        if passes is None:
            return None
        found = next_pass(passes, self._utc())
        if found is None:
            return {}
        key = f"{found['name']} {found['aos']}"
        if key != self._next[0]:
            self._next = key, {**found, "points": self._path(found)}
        return self._next[1]

    def _path(self, found: Fields) -> list[list[float]]:
        """The directions of the pass; empty if its elements are no longer known."""
        begin_s, end_s = (datetime.fromisoformat(found[key]).timestamp() for key in ("aos", "los"))
        try:
            wanted = self._sky.find(found["name"])
            if isinstance(wanted, Aim):
                return []
            target = wanted.target()
            moments_s = [begin_s + (end_s - begin_s) * index / POINTS for index in range(POINTS + 1)]
            sights = [target.sight(moment_s) for moment_s in moments_s]
        except (Unknown, NotThere):
            return []
        return [[round(sight.azimuth_deg, 1), round(max(0.0, sight.elevation_deg), 1)] for sight in sights]


def next_pass(passes: Sequence[Fields], now_s: float) -> Fields | None:
    """The first pass to come in the plan. If nothing is planned: the first that rises high enough."""
    now = datetime.fromtimestamp(now_s).astimezone()
    to_come = [each for each in passes if each["aos"] and each["los"] and datetime.fromisoformat(each["aos"]) > now]
    planned = [each for each in to_come if each["plan"] and each["plan"]["flown"]]
    high = [each for each in to_come if each["max_el_deg"] >= LEAST_DEG]
    return min(planned or high, key=lambda each: str(each["aos"]), default=None)
