"""The sky for the page: the passes of the next day with their plan, the next pass, and the order of the targets.

Knows the command `rotator sky passes --json` and its output. The order that a person drags is stored beside the
configuration, which does not change. Does not know orbits, nor how a plan is made.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from aiohttp import web
from typing_extensions import TypedDict

from rotator.config.sky import FollowTable
from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.protocols.methods import WrongValuesError
from rotator.store.priorities import Priorities, ranked
from rotator.tracking.known_sky import KnownSky
from rotator.web.computed import Computed, of_the_program
from rotator.web.entrance import RefusedError, computed
from rotator.web.route import COMPUTING, PAIRED, Route, get, post
from rotator.web.schema import Body, Pair, Sent, in_address, the

KEPT_S = 1200.0
MOST = 300
HOURS = 24
_Moment = Annotated[str | None, the("with its time zone; null: not within this day")]
_Planned = TypedDict(
    "_Planned",
    {
        "set_off": Annotated[str | None, the("when the antenna goes there")],
        "from": str | None,
        "until": str | None,
        "wait_az_deg": float | None,
        "wait_el_deg": float | None,
        "over_the_top": bool | None,
        "lost_s": Annotated[float | None, the("of the pass, to turns of the antenna")],
        "flown": bool,
        "reason": Annotated[str | None, the("why it is left out, or not flown whole")],
    },
)


class Pass(TypedDict):
    name: str
    aos: _Moment
    los: _Moment
    tca: Annotated[str, the("when it is highest")]
    aos_az_deg: float | None
    los_az_deg: float | None
    max_el_deg: float
    expected_error_deg: float
    plan: Annotated[_Planned | None, the("null: not in the plan")]


ManyPasses = TypedDict("ManyPasses", {"passes": list[Pass]})


def command(path: Path) -> tuple[str, ...]:
    """The command that prints the passes of the configured targets, as JSON."""
    return of_the_program("sky", "passes", "--json", "--hours", str(HOURS), "--config", str(path))


def coming_passes(
    words: Sequence[str] | None, clock: Callable[[], float], elements: Callable[[], object] = lambda: None
) -> Computed:
    """`elements` gives those of the satellites: another object once they are fetched, or copied into the folder."""
    return Computed(
        words, clock, elements, named="the passes", kept_s=KEPT_S, shaped=lambda rows: {"passes": rows[:MOST]}
    )


Fields = dict[str, Any]
LONGEST_ORDER = 16_384
MOST_WORDS = 100
LEAST_DEG = 10.0
"""Degrees: without a plan the next pass is the first that rises this high."""
POINTS = 40
"""Points of the path of the next pass."""


class _Next(Pass):
    points: Annotated[list[Pair], the("azimuth and elevation")]


class _None(TypedDict):
    """There is none."""


class _Bearing(TypedDict):
    place: Annotated[str, the("the country, or the locator")]
    azimuth_deg: Annotated[float, the("by the short path")]
    km: float


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


@dataclass(eq=False)
class Plan:
    """`changed` is called when the order has changed. `utc` gives seconds since 1970."""

    follow: Sequence[FollowTable]
    sky: KnownSky
    priorities: Priorities
    passes: Computed
    _: KW_ONLY
    changed: Callable[[], None]
    utc: Callable[[], float]
    _next: tuple[str, Fields] = field(default=("", {}), init=False)
    """The next pass as last sent, by its name and rise."""

    def routes(self) -> Sequence[Route]:
        async def order(_request: web.Request, sent: _Order) -> None:
            names = sent["order"]
            change = self.as_written if names is None else partial(self.reorder, names)
            reason = await asyncio.to_thread(change)
            self.changed()
            if reason:
                raise RefusedError(reason)

        def bearing(request: web.Request) -> _Bearing | _None:
            found = self.sky.place(request.query.get("to", "")[:MOST_WORDS])
            if found is None:
                return {}
            where = found.where
            return {"place": found.place, "azimuth_deg": round(where.azimuth_deg, 1), "km": round(where.range_km)}

        to = {"to": in_address("a locator, a country, its prefix, or a callsign", "New Zealand")}
        bearings = "Where a place on the earth is, as `track` takes it; {}: the words name none", _Bearing | _None
        following = "The next pass, with its path", _Next | _None
        followed = "What the file follows, the highest priority first", _FollowedList
        day = "The passes of the next day, as `rotator sky passes --json`", ManyPasses
        anew = "What is followed in a new order: what stands first counts most"
        return (
            get("/api/passes", lambda _: computed(self.passes.answer()), day, more=COMPUTING),
            get("/api/next", lambda _: computed(self.upcoming()), following, more=COMPUTING),
            get("/api/followed", lambda _: {"followed": self.followed()}, followed),
            # Who reads it knows where the station is.
            get("/api/bearing", bearing, bearings, access=PAIRED, query=to),
            post("/api/followed", order, anew, _ORDER, most_body=LONGEST_ORDER),
        )

    # --- what is followed

    def followed(self) -> list[_Followed]:
        """The targets of the configuration, the highest priority first."""
        rows = [self._row(each) for each in self.follow]
        return sorted(rows, key=lambda row: -row["priority"])

    def _row(self, each: FollowTable) -> _Followed:
        target, fault = "", ""
        try:
            wanted = self.sky.find(each.name)
            target = "" if isinstance(wanted, Aim) else wanted.target().name
        except (Unknown, NotThere) as reason:
            fault = str(reason)
        return {
            "name": each.name,
            "target": target or each.name,
            "priority": self.priorities.of(each.name, each.priority),
            "written": each.priority,
            "least_deg": each.min_culmination_deg,
            "fault": fault,
        }

    def reorder(self, names: Sequence[str]) -> str:
        """Set the priorities by this order, the most important first. Returns why not; empty: done."""
        written = {each.name: each.priority for each in self.follow}
        if sorted(names) != sorted(written):
            raise WrongValuesError("order must name each followed target once: GET /api/followed lists them")
        inforce = [self.priorities.of(name, priority) for name, priority in written.items()]
        return self._put(dict(zip(names, ranked(inforce), strict=True)), written)

    def as_written(self) -> str:
        """Restore the priorities of the configuration."""
        written = {each.name: each.priority for each in self.follow}
        return self._put(written, written)

    def _put(self, priorities: Mapping[str, float], written: Mapping[str, float]) -> str:
        kept = self.priorities.change(priorities, written)
        return "" if kept else "the order counts, but it cannot be kept: the log tells why"

    # --- the next pass

    def upcoming(self) -> Fields | None:
        """The next pass of the plan, or the next good one without a plan, with its path; {}: none; None: ask again."""
        if not self.sky.elements and not self.follow:
            return {}
        latest = self.passes.latest()
        if latest is None:
            return None
        found = next_pass(latest.get("passes", []), self.utc())
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
            wanted = self.sky.find(found["name"])
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
