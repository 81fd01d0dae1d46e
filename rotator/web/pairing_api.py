"""The routes of pairing: show a code at the box, pair a browser with it, list all pairings, end one.

Knows HTTP. Codes and tokens are in `pairing`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Any

from aiohttp import web

from rotator.protocols.methods import WrongValuesError
from rotator.store.paired import LONGEST_NAME, Paired
from rotator.web.connections import machine
from rotator.web.entrance import Entrance, error, set_cookie, source_of, values_of
from rotator.web.pairing import Pairings
from rotator.web.route import FREE, PAIRED, Route, get, post
from rotator.web.schema import NUMBER, TEXT, WHOLE, YES, body_of, list_of, object_of, or_null, the

HELLO = object_of(
    {
        "paired": the("may give orders", YES),
        "name": or_null(TEXT),
        "number": or_null(WHOLE),
        "source": the("as the log and the status name it", TEXT),
    }
)
_PAIRED = object_of(
    {
        "paired": list_of(
            object_of(
                {"number": WHOLE, "name": TEXT, "since_s": the("seconds ago", NUMBER), "seen_s": NUMBER},
            )
        )
    }
)


class PairingApi:
    """`utc` gives seconds since 1970."""

    def __init__(self, entrance: Entrance, pairings: Pairings, utc: Callable[[], float]) -> None:
        self._entrance = entrance
        self._pairings = pairings
        self._utc = utc

    def routes(self) -> Sequence[Route]:
        me = "Who asks: whether this browser or token may give orders", HELLO
        code = {"type": "string", "pattern": "^[0-9]{6}$"}
        name = {"type": "string", "maxLength": LONGEST_NAME}
        enter = body_of({"code": code, "name": name}, example={"code": "123456", "name": "Anna's phone"})
        number = body_of({"number": {"type": "integer", "minimum": 1}}, example={"number": 99})
        show, pair = "Show a code of six digits on the box's display", "Pair this browser by the code: a cookie"
        return (
            get("/api/me", self._me, me, access=FREE),
            get("/api/paired", self._list, ("All that are paired", _PAIRED), access=PAIRED),
            post("/api/pair/begin", self._begin, show, access=FREE),
            post("/api/pair", self._pair, pair, enter, answer=HELLO, access=FREE),
            post("/api/revoke", self._revoke, "Pair this one no more", number),
        )

    async def _me(self, request: web.Request) -> web.StreamResponse:
        return web.json_response(hello(self._entrance.who(request)))

    async def _begin(self, _request: web.Request) -> web.StreamResponse:
        self._pairings.ask()
        return web.json_response({"ok": True})

    async def _pair(self, request: web.Request) -> web.StreamResponse:
        match await values_of(request):
            case {"code": str() as code, "name": str() as name, **others} if len(code) <= LONGEST_NAME and not others:
                typed, peer = code.strip().replace(" ", ""), machine(request.remote or "")
                token, who = await asyncio.to_thread(self._pairings.enter, typed, name, peer)
            case _:
                raise WrongValuesError('send {"code": "123456", "name": "the name of this browser"}')
        answer = web.json_response(hello(who))
        set_cookie(answer, token)
        return answer

    async def _list(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        now_s = self._utc()
        paired = [
            {
                "number": one.number,
                "name": one.name,
                "since_s": now_s - one.since_s,
                "seen_s": now_s - (one.seen_s or one.since_s),
            }
            for one in self._pairings.all()
        ]
        return web.json_response({"paired": paired})

    async def _revoke(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        match await values_of(request):
            case {"number": int() as number, **others} if not isinstance(number, bool) and not others:
                refused = await asyncio.to_thread(self._pairings.revoke, number)
            case _:
                raise WrongValuesError('send {"number": 1}: /api/paired lists them')
        return error(409, refused) if refused else web.json_response({"ok": True})


def hello(who: Paired | None) -> dict[str, Any]:
    """The answer to a browser about its own pairing."""
    return {
        "paired": who is not None,
        "name": who.name if who else None,
        "number": who.number if who else None,
        "source": str(source_of(who)),
    }
