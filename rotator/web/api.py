"""The page's requests: its files, what is read, and the orders. Other groups of routes join it.

Knows HTTP. The orders themselves are in `rotator.protocols.methods`, what they do in `operating`: the console has the
same. Who may ask for what is in `entrance`.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Coroutine, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from aiohttp import web

from rotator.exchange.orders import Jog, Release, Stop
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.languages import VIEWS, Wanted, module, reader_language
from rotator.protocols.methods import METHODS, GoOn, Method, WrongValuesError
from rotator.protocols.operating import Operating
from rotator.protocols.session import Box, Tracking
from rotator.protocols.status_object import as_object
from rotator.store.paired import Paired
from rotator.web import assets, openapi, tables
from rotator.web.connections import Connections, machine
from rotator.web.entrance import Doors, Entrance, RefusedError, add_headers, source_of, values_of
from rotator.web.facts import BoxFacts, Station, box
from rotator.web.live import LONGEST_SIGN, MESSAGES, MOST_WATCHERS, Holding, Live
from rotator.web.logs import LatestLines, LogLines
from rotator.web.openapi import api_page
from rotator.web.pairing import Pairings
from rotator.web.pairing_api import PairingApi, hello
from rotator.web.past import PastMinutes
from rotator.web.route import FREE, MOST_BODY, PAIRED, READING, Handler, Route, get, live
from rotator.web.scene import FlightPath, Scene
from rotator.web.schema import component

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration

Group = Callable[[Entrance], Sequence[Route]]
"""Routes that need to know the sender."""


@dataclass(frozen=True, slots=True)
class PageParts:
    """The parts behind the page. `client` gives the box as a source sees it. `reading_open`: read without pairing."""

    status: Callable[[], Status]
    client: Callable[[Source], Box]
    tracking: Tracking | None
    station: Station
    scene: Scene
    lines: LogLines
    pairings: Pairings
    doors: Doors
    reading_open: bool
    utc: Callable[[], float]
    """Seconds since 1970."""
    calibration: PageCalibration | None
    """It takes the button that a person holds, for its axis; None: a normal run."""
    groups: Sequence[Group] = ()
    """More routes."""
    works: Sequence[Callable[[], Coroutine[Any, Any, None]]] = ()
    """Tasks that run as long as the page."""
    closes: Sequence[Callable[[], Coroutine[Any, Any, None]]] = ()
    """Called at the end of the page."""
    language: Wanted = "auto"


class Api:
    def __init__(self, parts: PageParts, live: Live, connections: Connections) -> None:
        self._parts = parts
        self._live = live
        self._entrance = Entrance(parts.doors, parts.pairings, connections, reading_open=parts.reading_open)
        self._assets = assets.load()
        self._routes: Sequence[Route] = ()
        self._description: asyncio.Task[dict[str, Any]] | None = None
        self._operating: dict[int, Operating] = {}
        """One for each number of a paired browser; 0: all browsers without pairing, which may only stop."""
        self._pressed: deque[str] = deque(maxlen=MOST_WATCHERS)
        """The keys of the latest presses of STOP."""

    def application(self) -> web.Application:
        itself = ("This description, as OpenAPI 3.1", openapi.ITSELF)
        routes = self._routes = [
            *self._reads(),
            *PairingApi(self._entrance, self._parts.pairings, self._parts.utc).routes(),
            *(openapi.order(each, self._order(each)) for each in METHODS),
            tables.route(self._as, self._parts.scene.with_names),
            *(route for group in self._parts.groups for route in group(self._entrance)),
            get("/api/openapi.json", lambda _: self._described(), itself, access=FREE),
        ]
        app = web.Application(middlewares=[self._entrance.guarded], client_max_size=MOST_BODY)
        app.on_response_prepare.append(add_headers)
        add = {"GET": app.router.add_get, "POST": app.router.add_post}  # HEAD, too, where there is a GET
        for route in routes:
            add[route.method](route.path, self._entrance.guarding(route))
        for path in ("/api", "/api/"):
            app.router.add_get(path, self._api_page)
        app.router.add_get("/{path:.*}", self._asset)
        return app

    # --- what is read

    def _reads(self) -> Sequence[Route]:
        parts = self._parts
        status = "The status, as `rotator where --json` prints it", component("status")
        station = "What does not change while the box runs: ranges, beam, horizon, sectors", BoxFacts
        past = "The last ten minutes, a row each second; null: there was none", PastMinutes
        path = "The pass that is flown or waited for, as directions", FlightPath
        log = "The latest lines of the log, the latest first", LatestLines
        pictures = "A WebSocket: ten pictures of the box a second, STOP, and a button that is held", MESSAGES
        return (
            get("/api/status", lambda _: as_object(parts.status()), status),
            get("/api/box", lambda request: self._box_for(self._entrance.who(request)), station),
            get("/api/past", lambda _: parts.scene.past.rows(), past),
            get("/api/path", lambda _: parts.scene.path(), path),
            # It names people's browsers and machines.
            get("/api/log", self._log, log, access=PAIRED),
            live("/api/live", self._serve_live, pictures, access=READING, query={}, more={}),
        )

    def _box_for(self, who: Paired | None) -> BoxFacts:
        return box(self._parts.station, self._parts.status(), stranger=who is None)

    def _log(self, _request: web.Request) -> LatestLines:
        with_names = self._parts.scene.with_names
        return {"lines": [{**line, "text": with_names(line["text"])} for line in self._parts.lines.latest_first()]}

    async def _serve_live(self, request: web.Request) -> web.StreamResponse:
        socket = web.WebSocketResponse(max_msg_size=LONGEST_SIGN, compress=False, heartbeat=10.0, timeout=1.0)
        await socket.prepare(request)
        self._entrance.lasts(request)
        who = self._entrance.who(request)
        holding = None if who is None else Holding(self._live.pictures, self._jogging(request))
        await self._live.serve(
            socket,
            {**hello(who), "box": self._box_for(who)},
            holding,
            lambda: self._is_still(who, request),
            stop=lambda key: self._stop(self._as(self._entrance.who(request)), key),
            host=machine(request.remote or ""),
        )
        return socket

    def _is_still(self, who: Paired | None, request: web.Request) -> bool:
        """Whether this browser has still the same rights. If its pairing ended, it must connect again."""
        now = self._entrance.who(request)
        return (now and now.number) == (who and who.number) and (now is not None or self._entrance.reading_open)

    def _jogging(self, request: web.Request) -> Callable[[Jog], str]:
        def order(jog: Jog) -> str:
            # Ask at each sign: its pairing may have been revoked.
            who = self._entrance.who(request)
            if who is None:
                return "this browser is paired no more"
            guide = self._parts.calibration
            if guide is not None and guide.axis is jog.axis:
                return guide.hold(jog)
            return self._parts.scene.with_names(self._as(who).do(jog))

        return order

    async def _described(self) -> dict[str, Any]:
        """Made when somebody asks for it first, in a thread of its own: it takes a while on a small Pi."""
        if self._description is None:
            made = asyncio.to_thread(openapi.description, self._routes)
            self._description = asyncio.create_task(made, name="page: description")
        return await asyncio.shield(self._description)

    async def _api_page(self, request: web.Request) -> web.StreamResponse:
        if request.path not in self._assets:
            page = assets.packed(assets.HTML, api_page(await self._described()).encode())
            self._assets["/api"] = self._assets["/api/"] = page
        return await self._asset(request)

    async def _asset(self, request: web.Request) -> web.StreamResponse:
        asset = self._assets.get(request.path) if request.path != "/language.js" else await self._words(request)
        if asset is None:
            raise web.HTTPNotFound(reason=f"there is no {request.path[:60]!a}")
        headers = {
            "ETag": asset.tag,
            "Cache-Control": "no-cache",
            "Content-Type": asset.kind,
            "Vary": "Accept-Encoding, Accept-Language",
        }
        if asset.tag in request.headers.get("If-None-Match", ""):
            answer = web.Response(status=304, headers=headers)
        elif "gzip" in request.headers.get("Accept-Encoding", ""):
            answer = web.Response(body=asset.packed, headers={**headers, "Content-Encoding": "gzip"})
        else:
            answer = web.Response(body=asset.plain, headers=headers)
        if request.path == "/":
            self._entrance.renew_cookie(request, answer)
        return answer

    async def _words(self, request: web.Request) -> assets.Asset:
        """The words in the reader's language: all that many views need, or with `?of=` those of one view. The first of
        each is packed in a thread: a small Pi needs a while."""
        language = reader_language(self._parts.language, request.headers.get("Accept-Language", ""))
        view = next((each for each in VIEWS if each == request.query.get("of")), "")
        if (asset := self._assets.get(f"/language.js {language} {view}")) is None:
            asset = await asyncio.to_thread(lambda: assets.packed(assets.SCRIPT, module(language, view)))
            self._assets[f"/language.js {language} {view}"] = asset
        return asset

    # --- orders

    def _order(self, method: Method) -> Handler:
        async def answer(request: web.Request) -> None:
            who = self._entrance.who(request)
            # A stop counts with any body.
            try:
                command = method.command({} if method.free else await values_of(request))
            except WrongValuesError as reason:
                self._as(who).refuse(str(reason))
                raise
            if isinstance(command, Release | GoOn) and self._has_stopped_since(request):
                raise RefusedError("it has been stopped again meanwhile: look at it, and press once more", 412)
            if isinstance(command, Stop):
                refused = self._stop(self._as(who), request.headers.get("Idempotency-Key", ""))
            else:
                refused = self._as(who).do(command)
            if refused:
                raise RefusedError(self._parts.scene.with_names(refused))

        return answer

    def _stop(self, operating: Operating, key: str) -> str:
        """Stop everything. A press of STOP comes by two ways, each with its `key`: the later one is no second stop,
        which would hold the antenna again after a quick "Let it move again". Returns why it is refused.
        """
        if key and key in self._pressed:
            return ""
        if not (refused := operating.do(Stop(latch=True))):
            self._pressed.append(key)
        return refused

    def _has_stopped_since(self, request: web.Request) -> bool:
        """Whether a stop has overtaken this request: its `If-Match` names the stops that its sender has seen."""
        seen = request.headers.get("If-Match")
        return seen is not None and seen != f'"{self._parts.scene.stops}"'

    def _as(self, who: Paired | None) -> Operating:
        number = who.number if who else 0
        if number not in self._operating:
            source = source_of(who)
            self._operating[number] = Operating(self._parts.client(source), self._parts.tracking, source)
        return self._operating[number]
