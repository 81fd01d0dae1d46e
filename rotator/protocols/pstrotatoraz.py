"""The web page of PstRotatorAz, through which other programs read and turn a rotor: a plug-in of FM-DX Webserver does.

Knows one request to a connection (`GET /PstRotatorAz.htm?az=235`), the page, and who may turn the antenna: no page of
another web site that a browser has open. Does not know sockets. Sources: what the plug-in and other programs request,
and what they look for in the page (see docs/reference/wire.md).
"""

from __future__ import annotations

import ipaddress
import re
from dataclasses import dataclass, field
from http import HTTPStatus
from urllib.parse import parse_qsl

from rotator.exchange.orders import Order, Stop
from rotator.protocols.aiming import aim, degrees, whole
from rotator.protocols.damaged import is_stop
from rotator.protocols.session import Box, Talk

MAX_REQUEST = 4096
PAGES = ("/", "/PstRotatorAz.htm")
_END = re.compile(rb"\r?\n\r?\n")
_REQUEST = re.compile(rb"GET (/[!-~]*) HTTP/1\.[01]")
_HEADER = re.compile(rb"([!#$%&'*+.^_`|~0-9A-Za-z-]+):[ \t]*+([\x20-\x7e\x80-\xff\t]*)")
_HOST = re.compile(r"(?:\[([0-9a-f:.]+)\]|([a-z0-9._-]+))(?::[0-9]*)?")
_LOCAL = (".local", ".lan", ".home.arpa", ".internal")
_SAME_SITE = ("", "none", "same-origin")


@dataclass(frozen=True, slots=True)
class Request:
    """A whole request: its target, and its headers with names in small letters."""

    target: str
    headers: dict[str, str] = field(default_factory=dict)


def parse(head: bytes) -> Request | None:
    """The request in the bytes up to the empty line; None: it is no GET with well-formed headers."""
    first, *lines = re.split(rb"\r?\n", head)
    asked = _REQUEST.fullmatch(first)
    headers = [_HEADER.fullmatch(line) for line in lines]
    if not asked or not all(headers):
        return None
    named = {found[1].decode().lower(): found[2].decode("latin-1").strip() for found in headers if found}
    return Request(asked[1].decode(), named) if len(named) == len(headers) else None


def is_own(request: Request) -> bool:
    """Whether no other web site has made this request: a page that a browser has open must not turn the antenna.

    A program names the box by its address or by a local name, and sends no origin; a browser says where it comes from.
    """
    headers = request.headers
    host = _HOST.fullmatch(headers.get("host", "").lower())
    if host is None or headers.get("sec-fetch-site", "") not in _SAME_SITE:
        return False
    for where in (headers.get("origin"), headers.get("referer")):
        if where and where.partition("://")[2].partition("/")[0] != headers["host"]:
            return False
    return _is_local(host[1] or host[2])


def _is_local(host: str) -> bool:
    """Another site's name may lead here by its own name server; an address, and a name of the local network, cannot."""
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return "." not in host or host.endswith(_LOCAL)
    return True


def encode(target: str, host: str = "192.168.1.20") -> bytes:
    """A request as the plug-in sends it."""
    return f"GET {target} HTTP/1.1\r\nAccept: */*\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode()


def page(azimuth_deg: float | None) -> str:
    """What programs look for is `Bearing = 235 deg`."""
    bearing = "unknown" if azimuth_deg is None else f"{whole(azimuth_deg) % 360} deg"
    return (
        "<!DOCTYPE html><html><head><title>PstRotatorAz</title></head><body>"
        f"<p>Bearing = {bearing}</p>"
        '<form action="PstRotatorAz.htm" method="get"><input name="az" size="5"><input type="submit" value="GO"></form>'
        '<form action="PstRotatorAz.htm" method="get"><input type="hidden" name="cmd" value="stop">'
        '<input type="submit" value="STOP"></form></body></html>\n'
    )


def response(status: HTTPStatus, body: str) -> bytes:
    """A whole answer, after which the connection ends."""
    kind = "text/html" if body.startswith("<") else "text/plain"
    head = (
        f"HTTP/1.1 {status.value} {status.phrase}\r\nContent-Type: {kind}; charset=utf-8\r\n"
        f"Content-Length: {len(body.encode())}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n"
    )
    return (head + body).encode()


class PstRotatorAzSession(Talk):
    """One connection, one request, one answer."""

    def __init__(self, box: Box) -> None:
        self._box = box
        self._buffer = bytearray()

    def receive(self, data: bytes) -> list[bytes]:
        if self.closed:
            return []
        self._buffer += data[: MAX_REQUEST + 1]
        end = _END.search(self._buffer)
        if end is None and len(self._buffer) <= MAX_REQUEST:
            return []
        self.closed = True
        if is_stop(re.split(rb"[\r\n]", self._buffer)[0].partition(b"?")[2]):
            # However the rest of it is written, and from anywhere: a stop cannot harm.
            self._box.order(Stop())
            return [self._page()]
        request = parse(bytes(self._buffer[: end.start()])) if end and end.end() <= MAX_REQUEST else None
        return [self._answer(request)]

    def finish(self) -> list[bytes]:
        return self.receive(b"\n\n") if self._buffer else []

    def _page(self) -> bytes:
        return response(HTTPStatus.OK, page(self._box.status().azimuth.points_deg))

    def _answer(self, request: Request | None) -> bytes:
        if request is None:
            self._box.note_refused(bytes(self._buffer))
            return response(HTTPStatus.BAD_REQUEST, "only GET, and at most 4096 bytes\n")
        path, _, query = request.target.partition("?")
        if path not in PAGES:
            return response(HTTPStatus.NOT_FOUND, "the page is /PstRotatorAz.htm\n")
        if query:
            order = _order(query)
            if order is None:
                self._box.note_refused(request.target.encode())
                return response(HTTPStatus.BAD_REQUEST, "az=DEGREES or cmd=stop\n")
            if not is_own(request):
                return response(HTTPStatus.FORBIDDEN, "name the box by its address; another web site may not turn it\n")
            if refused := self._box.order(order):
                return response(HTTPStatus.CONFLICT, f"refused: {refused.reason}\n")
        return self._page()


def _order(query: str) -> Order | None:
    """The order of a query; None: it is none, or more than one."""
    match parse_qsl(query, keep_blank_values=True):
        case [("az", value)] if (azimuth_deg := degrees(value)) is not None:
            return aim(azimuth_deg, None)
        case _:
            return None
