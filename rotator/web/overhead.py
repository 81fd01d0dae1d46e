"""The live sky for the page: what is up now and how it moves, and where the antenna cannot point.

Knows the command `rotator sky up --json`: a process of the least priority computes it, once for all browsers. Does not
know orbits.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Literal

from aiohttp import web
from typing_extensions import TypedDict

from rotator.control.sky.mount import Mount
from rotator.control.sky.unreached import Area, unreached
from rotator.web.computed import Computed, of_the_program
from rotator.web.entrance import computed
from rotator.web.route import COMPUTING, Route, get
from rotator.web.schema import Pair, the

KEPT_S = 240.0
_Seconds = Annotated[float | None, the("since 1970; null: up for more than a day before, or after")]


class _Up(TypedDict):
    name: str
    short: Annotated[str, the("its usual name, for a small place")]
    number: Annotated[int | None, the("in the catalogue; null: Sun or Moon")]
    rank: Annotated[Literal["followed", "body", "amateur", ""], the("how much it counts for a person")]
    aos_s: _Seconds
    los_s: _Seconds
    tca_s: Annotated[float, the("when it is highest")]
    max_el_deg: float
    from_s: Annotated[float, the("when it is at the first of the points")]
    step_s: Annotated[float, the("from a point to the next")]
    points: Annotated[list[Pair], the("azimuth and elevation, over the whole pass")]


class _Sky(TypedDict):
    utc_s: float
    until_s: Annotated[float, the("what rises later is not in it; when this is over, ask again")]
    up: Annotated[list[_Up], the("what counts most first")]
    left_out: Annotated[int, the("how many more there are, of those that count least")]
    satellites: Annotated[int, the("how many are known, up or not")]
    why_none: Annotated[str, the("what to do where no satellite is known; else empty")]
    unfetched: Annotated[bool, the("none is known because none has been fetched yet")]


_Areas = TypedDict("_Areas", {"areas": Annotated[list[Area], the("azimuth from and to, elevation from and to")]})


def overhead(path: Path | None, clock: Callable[[], float], elements: Callable[[], object]) -> Computed:
    """`path`: of the configuration; None: it has no file, or no place."""
    words = of_the_program("sky", "up", "--json", "--config", str(path)) if path else None
    return Computed(words, clock, elements, named="the sky", kept_s=KEPT_S, shaped=dict)


class OverheadApi:
    def __init__(self, sky: Computed, mount: Mount) -> None:
        self._sky = sky
        self._mount = mount
        self._areas: asyncio.Task[list[Area]] | None = None

    def routes(self) -> Sequence[Route]:
        up = "What is up now or rises in the next minutes, with its path", _Sky
        return (
            get("/api/sky", lambda _: computed(self._sky.latest()), up, more=COMPUTING),
            get("/api/unreached", self._unreached, ("Where in the sky the antenna cannot point", _Areas)),
        )

    async def _unreached(self, _request: web.Request) -> _Areas:
        """Found once, in a thread of its own, when somebody asks: it takes a while on a small computer."""
        if self._areas is None:
            self._areas = asyncio.create_task(asyncio.to_thread(unreached, self._mount), name="page: unreached")
        return {"areas": await asyncio.shield(self._areas)}
