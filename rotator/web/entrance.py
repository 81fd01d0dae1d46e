"""The entrance of the page: which requests are accepted, who sends them, and how large they may be.

Knows networks, the names of the box, headers, cookies and tokens, and the answers of a refusal. The headers Host,
Origin and Sec-Fetch-Site keep out a foreign page in a visitor's browser, which cannot forge them. Does not know what a
request is for.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Awaitable, Callable, Iterable, Sequence
from inspect import isawaitable
from typing import Any

from aiohttp import web

from rotator.exchange.foreign import json_of
from rotator.exchange.sources import PAGE, Source
from rotator.links.listening import PRIVATE, Allowed
from rotator.protocols.methods import WrongValuesError
from rotator.store.paired import Paired
from rotator.web import assets
from rotator.web.connections import Connections
from rotator.web.pairing import LASTS_S, NotPairedError, Pairings
from rotator.web.route import MOST_BODY, Route
from rotator.web.schema import ZIP

_HOST = re.compile(r"(\[[0-9a-fA-F:.]+\]|[A-Za-z0-9.-]{1,253})(?::[0-9]{1,5})?")


class Doors:
    """`names`: of this computer. `allow`: the networks that may connect; None: private ones."""

    def __init__(self, names: Iterable[str], allow: Sequence[str] | None = None) -> None:
        self._names = {name.lower().rstrip(".") for name in names} | {"localhost"}
        self._names |= {f"{name}.local" for name in self._names if "." not in name and name != "localhost"}
        self._allowed = Allowed(PRIVATE if allow is None else allow)

    def lets_in(self, address: str) -> bool:
        """Whether a machine with this address may connect."""
        return self._allowed(address)

    def knows(self, host: str) -> bool:
        """Whether this is an address of the box, as the header Host names it.

        An IP address always is: a foreign page can point its own name at the box, but not an IP address.
        """
        found = _HOST.fullmatch(host)
        if found is None:
            return False
        name = found[1].lower().rstrip(".")
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return name in self._names
        return True

    @staticmethod
    def is_own(host: str, origin: str | None, site: str | None) -> bool:
        """Whether a request that changes something comes from the box's own page, or from no page at all.

        `origin`, `site`: the headers Origin and Sec-Fetch-Site; None: missing, as from curl.
        """
        if site is not None and site not in ("same-origin", "none"):
            return False
        return origin is None or origin.lower() in (f"http://{host.lower()}", f"https://{host.lower()}")


COOKIE = "rotator"
Serve = Callable[[web.Request], Awaitable[web.StreamResponse]]
_SENDER = web.RequestKey("sender", Paired)
_TOO_LONG = "this request has a body of at most {} bytes"


class RefusedError(Exception):
    """The request is understood, but the box cannot do it now. The text says why; `status`: of HTTP."""

    def __init__(self, why: str, status: int = 409) -> None:
        super().__init__(why)
        self.status = status


class Entrance:
    """`reading_open`: reading without pairing is allowed."""

    def __init__(self, doors: Doors, pairings: Pairings, connections: Connections, *, reading_open: bool) -> None:
        self._doors = doors
        self._pairings = pairings
        self._connections = connections
        self.reading_open = reading_open

    @web.middleware
    async def guarded(self, request: web.Request, handler: Serve) -> web.StreamResponse:
        self._connections.begin(request.transport)
        try:
            if refused := self._refused(request):
                return error(403, refused)
            return await handler(request)
        except web.HTTPMethodNotAllowed:
            return error(405, f"there is no {request.method} {request.path[:60]!a}: /api/ lists all there is")
        except web.HTTPBadRequest:
            # The library raises this only for a WebSocket.
            return error(400, f"{request.path} is a WebSocket: ask for it as one")
        except web.HTTPException as answer:
            return error(answer.status, answer.reason)
        except NotPairedError as reason:
            return error(403, str(reason))
        except RefusedError as reason:
            return error(reason.status, str(reason))
        except WrongValuesError as reason:
            return error(400, str(reason))
        finally:
            self._connections.end(request.transport)

    def _refused(self, request: web.Request) -> str:
        """Why this request is refused; empty: it is accepted."""
        host = request.headers.get("Host", "")
        if not self._doors.knows(host):
            return "the box has another name: open the page by its number, or write [page] names into its file"
        does = request.method not in ("GET", "HEAD") or "upgrade" in request.headers.get("Connection", "").lower()
        origin, site = request.headers.get("Origin"), request.headers.get("Sec-Fetch-Site")
        if does and not self._doors.is_own(host, origin, site):
            return "another site's page may not do that"
        return ""

    def who(self, request: web.Request) -> Paired | None:
        """The paired browser or program that sends the request; None: not paired."""
        scheme, _, bearer = request.headers.get("Authorization", "").partition(" ")
        token = bearer.strip() if scheme.lower() == "bearer" else request.cookies.get(COOKIE, "")
        return self._pairings.known(token) if token else None

    def guarding(self, route: Route) -> Serve:
        """Serves a route to those who may ask for it as it describes itself, with no longer bodies.

        Before the first byte is read: a stranger's file must not take memory.
        """
        security = route.described["security"]
        open_to_all = not security or (self.reading_open and {} in security)

        async def serve(request: web.Request) -> web.StreamResponse:
            if route.most_body and (request.content_length or 0) > route.most_body:
                return error(413, _TOO_LONG.format(route.most_body))
            if not open_to_all:
                who = self.who(request)
                if who is None:
                    raise web.HTTPUnauthorized(reason="not paired: only a paired browser or program may do that")
                request[_SENDER] = who
            given = [] if route.body is None else [route.body.read(await values_of(request, route.most_body))]
            made = route.serve(request, *given)
            return _answer(await made if isawaitable(made) else made)

        return serve

    def lasts(self, request: web.Request) -> None:
        """This connection has become a WebSocket, and has no time limit now."""
        self._connections.live(request.transport)

    def renew_cookie(self, request: web.Request, answer: web.Response) -> None:
        """A pairing counts from the latest visit; its cookie too."""
        token = request.cookies.get(COOKIE, "")
        if token and self._pairings.known(token):
            set_cookie(answer, token)


def _answer(made: Any) -> web.StreamResponse:
    if isinstance(made, web.StreamResponse):
        return made
    return web.json_response({"ok": True} if made is None else made)


def paired(request: web.Request) -> Paired:
    """The browser or program that has asked for a route with `PAIRED`."""
    return request[_SENDER]


def set_cookie(answer: web.Response, token: str) -> None:
    answer.set_cookie(COOKIE, token, max_age=int(LASTS_S), path="/", httponly=True, samesite="Strict")


def source_of(who: Paired | None) -> Source:
    return Source(PAGE, who.number if who else 0)


async def values_of(request: web.Request, most: int = MOST_BODY) -> dict[str, object]:
    """The request's JSON object; empty without a body. Raises WrongValuesError, HTTPRequestEntityTooLarge."""
    try:
        text = (await bytes_of(request, most)).decode("utf-8")
        values = json_of(text) if text.strip() else {}
    except ValueError:
        raise WrongValuesError("the body must be a JSON object") from None
    if not isinstance(values, dict):
        raise WrongValuesError("the body must be a JSON object")
    return values


async def bytes_of(request: web.Request, most: int) -> bytes:
    """The request's body as it is. Raises HTTPRequestEntityTooLarge, however its length was announced."""
    body = bytearray()
    async for piece in request.content.iter_any():
        body += piece
        if len(body) > most:
            raise web.HTTPRequestEntityTooLarge(most, len(body), reason=_TOO_LONG.format(most))
    return bytes(body)


def computed(answer: dict[str, Any] | None) -> web.Response:
    """The answer to a slow request. None: 202, ask again. With `error` in it: 409."""
    if answer is None:
        return web.json_response({"computing": True}, status=202)
    return web.json_response(answer, status=409 if "error" in answer else 200)


def error(status: int, reason: str) -> web.Response:
    answer = web.json_response({"error": reason}, status=status)
    if status == web.HTTPRequestEntityTooLarge.status_code:
        answer.force_close()
    return answer


def download(packed: bytes, name: str) -> web.Response:
    """A zip that the browser keeps as a file."""
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return web.Response(body=packed, content_type=ZIP["contentMediaType"], headers=headers)


async def add_headers(_request: web.Request, answer: web.StreamResponse) -> None:
    """Add the headers of each answer."""
    for name, text in assets.HEADERS.items():
        answer.headers.setdefault(name, text)
    answer.headers.setdefault("Cache-Control", "no-store")
    answer.headers.pop("Server", None)
