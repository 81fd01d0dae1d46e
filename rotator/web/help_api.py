"""The routes that help to find a fault: the doctor, the bytes of the links, and a file for another person.

Knows HTTP, and who may see what. The parts beside this file make the content.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from aiohttp import web
from typing_extensions import TypedDict

from rotator.web.computed import Computed, of_the_program
from rotator.web.entrance import Entrance, computed, error
from rotator.web.redaction import Redaction
from rotator.web.route import COMPUTING, PAIRED, Route, get, live, refusals
from rotator.web.schema import ZIP, in_address, the
from rotator.web.wire_watch import MESSAGES, MOST_WATCHERS, WireWatch
from rotator.web.wires import WireLog

DOCTOR_KEPT_S = 5.0
LONGEST_NUMBER = 18
WIRES = "A WebSocket: the bytes of the links, in the lines of `rotator monitor`"
DIAGNOSTICS = "A zip with what another person needs to see what is wrong, without secrets"
WITH_FAULTS = (0, 1, 2)
"""The exit codes with which `rotator doctor` has printed its report."""


class _Check(TypedDict):
    name: str
    ok: Annotated[bool | None, the("null: left out")]
    found: str
    advice: Annotated[str | None, the("with ok true: a warning")]


class _Report(TypedDict):
    version: Annotated[int, the("of this form")]
    rotator: Annotated[str, the("the program's version")]
    ok: Annotated[bool, the("nothing is to be repaired")]
    checks: list[_Check]
    at_s: Annotated[float, the("seconds since 1970")]


def doctor(
    path: Path, redaction: Redaction, clock: Callable[[], float], utc: Callable[[], float], *, kept_s: float
) -> Computed:
    """The report of `rotator doctor` on this file, without secrets, because reading may be open to all."""

    def shaped(report: dict[str, Any]) -> dict[str, Any]:
        return {**redaction.value(report), "at_s": utc()}

    words = of_the_program("doctor", "--json", "--config", str(path))
    return Computed(words, clock, named="the checks", kept_s=kept_s, shaped=shaped, good=WITH_FAULTS)


class HelpApi:
    """`pack`: makes the diagnostics file, from the doctor's report. It may read files."""

    def __init__(
        self, entrance: Entrance, doctor: Computed, wires: WireLog, pack: Callable[[dict[str, Any]], bytes]
    ) -> None:
        self._entrance = entrance
        self._doctor = doctor
        self._pack = pack
        self._watch = WireWatch(wires)

    def routes(self) -> Sequence[Route]:
        after = {"after": in_address("the `upto` of the last message that you have", "480")}
        return (
            get("/api/doctor", self._examine, ("The checks of `rotator doctor --json`", _Report), more=COMPUTING),
            get("/api/diagnostics", self._diagnose, (DIAGNOSTICS, ZIP), access=PAIRED),
            live("/api/wires", self._serve_wires, (WIRES, MESSAGES), access=PAIRED, query=after, more=refusals(409)),
        )

    async def _examine(self, request: web.Request) -> web.StreamResponse:
        self._entrance.may_read(request)
        return computed(self._doctor.answer())

    async def _diagnose(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        packed = await asyncio.to_thread(self._pack, await self._doctor.newest())
        return download(packed, "rotator-diagnostics.zip")

    async def _serve_wires(self, request: web.Request) -> web.StreamResponse:
        # The lines name machines, and show the bytes of people's programs.
        self._entrance.must_be_paired(request)
        if self._watch.is_full:
            return error(409, f"{MOST_WATCHERS} are watching already")
        socket = web.WebSocketResponse(max_msg_size=64, compress=False, heartbeat=10.0, timeout=1.0)
        await socket.prepare(request)
        self._entrance.lasts(request)
        upto = request.query.get("after", "")
        seen = int(upto) if upto.isdecimal() and len(upto) <= LONGEST_NUMBER else None
        await self._watch.serve(socket, seen, lambda: self._entrance.who(request) is not None)
        return socket


def download(packed: bytes, name: str) -> web.Response:
    """A zip that the browser keeps as a file."""
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return web.Response(body=packed, content_type=ZIP["contentMediaType"], headers=headers)
