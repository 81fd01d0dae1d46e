"""The routes of pairing: show a code at the box, pair a browser with it, list all pairings, end one.

Knows HTTP. Codes and tokens are in `pairing`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Annotated

from aiohttp import web
from pydantic import Field
from typing_extensions import TypedDict

from rotator.store.paired import LONGEST_NAME, Paired
from rotator.web.connections import machine
from rotator.web.entrance import Entrance, RefusedError, set_cookie, source_of
from rotator.web.pairing import Pairings
from rotator.web.route import FREE, PAIRED, Route, get, post
from rotator.web.schema import Body, Sent, the


class Hello(TypedDict):
    paired: Annotated[bool, the("may give orders")]
    name: str | None
    number: int | None
    source: Annotated[str, the("as the log and the status name it")]


class _Pairing(TypedDict):
    number: int
    name: str
    since_s: Annotated[float, the("seconds ago")]
    seen_s: float


_PairedList = TypedDict("_PairedList", {"paired": list[_Pairing]})


class _Enter(Sent):
    code: Annotated[str, Field(max_length=LONGEST_NAME, json_schema_extra={"pattern": "^[0-9]{6}$"})]
    name: Annotated[str, Field(json_schema_extra={"maxLength": LONGEST_NAME})]
    """A longer one is cut."""


class _Revoke(Sent):
    number: Annotated[int, Field(ge=1)]


_ENTER = Body((_Enter, {"code": "123456", "name": "Anna's phone"}))
_REVOKE = Body((_Revoke, {"number": 99}), hint="/api/paired lists them")


class PairingApi:
    """`utc` gives seconds since 1970."""

    def __init__(self, entrance: Entrance, pairings: Pairings, utc: Callable[[], float]) -> None:
        self._entrance = entrance
        self._pairings = pairings
        self._utc = utc

    def routes(self) -> Sequence[Route]:
        me = "Who asks: whether this browser or token may give orders", Hello
        show, pair = "Show a code of six digits on the box's display", "Pair this browser by the code: a cookie"
        return (
            get("/api/me", lambda request: hello(self._entrance.who(request)), me, access=FREE),
            get("/api/paired", self._list, ("All that are paired", _PairedList), access=PAIRED),
            post("/api/pair/begin", lambda _: self._pairings.ask(), show, access=FREE),
            post("/api/pair", self._pair, pair, _ENTER, answer=Hello, access=FREE),
            post("/api/revoke", self._revoke, "Pair this one no more", _REVOKE),
        )

    async def _pair(self, request: web.Request, sent: _Enter) -> web.StreamResponse:
        typed, peer = sent["code"].strip().replace(" ", ""), machine(request.remote or "")
        token, who = await asyncio.to_thread(self._pairings.enter, typed, sent["name"], peer)
        answer = web.json_response(hello(who))
        set_cookie(answer, token)
        return answer

    def _list(self, _request: web.Request) -> _PairedList:
        now_s = self._utc()
        return {
            "paired": [
                {
                    "number": one.number,
                    "name": one.name,
                    "since_s": now_s - one.since_s,
                    "seen_s": now_s - (one.seen_s or one.since_s),
                }
                for one in self._pairings.all()
            ]
        }

    async def _revoke(self, _request: web.Request, sent: _Revoke) -> None:
        if refused := await asyncio.to_thread(self._pairings.revoke, sent["number"]):
            raise RefusedError(refused)


def hello(who: Paired | None) -> Hello:
    """The answer to a browser about its own pairing."""
    return {
        "paired": who is not None,
        "name": who.name if who else None,
        "number": who.number if who else None,
        "source": str(source_of(who)),
    }
