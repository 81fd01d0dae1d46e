"""What helps to find a fault: the doctor, the bytes of the links, a file for another person, and the backup.

Knows HTTP, who may see what, and which secrets the box holds. The parts beside this file make the content.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from aiohttp import web
from typing_extensions import TypedDict

from rotator.config.load import SIMULATED_FILE
from rotator.config.model import Config
from rotator.exchange.sources import PAGE, Source
from rotator.web.api import Group
from rotator.web.backup_api import BackupApi
from rotator.web.box_file import BoxFile
from rotator.web.computed import Computed, of_the_program
from rotator.web.diagnostics import Known, diagnostics, read_text
from rotator.web.entrance import Entrance, RefusedError, computed, download
from rotator.web.live import dropped_if_slow
from rotator.web.logs import LogLines, WireLog
from rotator.web.pairing import Pairings
from rotator.web.redaction import Redaction, secrets_of, spellings_of_place
from rotator.web.route import COMPUTING, PAIRED, Route, get, live, refusals
from rotator.web.schema import ZIP, in_address, the

DOCTOR_KEPT_S = 5.0
LONGEST_NUMBER = 18
WIRES = "A WebSocket: the bytes of the links, in the lines of `rotator monitor`"
DIAGNOSTICS = "A zip with what another person needs to see what is wrong, without secrets"
WITH_FAULTS = (0, 1, 2)
"""The exit codes with which `rotator doctor` has printed its report."""
MOST_AT_ONCE = 200
EVERY_S = 0.2
TAKES_S = 15.0
"""Seconds: a browser that needs longer to take a message is dropped."""
MOST_WATCHERS = 8
MESSAGES = """The box sends, as soon as there are new lines:

    {"lines": ["…", "…"], "upto": 480, "missed": 0}

`lines` are as `rotator monitor` prints them, the oldest first. `upto` is the number of the line after them: after a
lost connection ask for `?after=480`. `missed`: so many lines before these are gone. You send
nothing: the box closes then.
"""


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


class WireWatch:
    """The browsers that watch. `may_look` is called before each message, because a pairing may have ended."""

    def __init__(self, wires: WireLog) -> None:
        self._wires = wires
        self._watchers = 0

    @property
    def is_full(self) -> bool:
        return self._watchers >= MOST_WATCHERS

    async def serve(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        """Serve until the browser leaves or loses its right to look. `upto`: number of its next line; None: all."""
        self._watchers += 1
        sender = asyncio.create_task(self._send(socket, upto, may_look), name="page: wires")
        try:
            async for _ in socket:
                return  # the page never sends a message here
        finally:
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)
            self._watchers -= 1

    async def _send(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        with dropped_if_slow(socket):
            while not socket.closed:
                if not may_look():
                    await socket.close()
                    return
                new = self._wires.after(upto or 0, MOST_AT_ONCE)
                if new.lines or upto is None:
                    # Lines from before its connection do not count as missed.
                    missed = 0 if upto is None else new.missed
                    async with asyncio.timeout(TAKES_S):
                        await socket.send_str(json.dumps({"lines": new.lines, "upto": new.upto, "missed": missed}))
                    upto = new.upto
                if len(new.lines) < MOST_AT_ONCE:
                    await asyncio.sleep(EVERY_S)


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
        report = "The checks of `rotator doctor --json`", _Report
        after = {"after": in_address("the `upto` of the last message that you have", "480")}
        return (
            get("/api/doctor", lambda _: computed(self._doctor.answer()), report, more=COMPUTING),
            get("/api/diagnostics", self._diagnose, (DIAGNOSTICS, ZIP), access=PAIRED),
            live("/api/wires", self._serve_wires, (WIRES, MESSAGES), access=PAIRED, query=after, more=refusals(409)),
        )

    async def _diagnose(self, _request: web.Request) -> web.StreamResponse:
        packed = await asyncio.to_thread(self._pack, await self._doctor.newest())
        return download(packed, "rotator-diagnostics.zip")

    async def _serve_wires(self, request: web.Request) -> web.StreamResponse:
        if self._watch.is_full:
            raise RefusedError(f"{MOST_WATCHERS} are watching already")
        socket = web.WebSocketResponse(max_msg_size=64, compress=False, heartbeat=10.0, timeout=1.0)
        await socket.prepare(request)
        self._entrance.lasts(request)
        upto = request.query.get("after", "")
        seen = int(upto) if upto.isdecimal() and len(upto) <= LONGEST_NUMBER else None
        await self._watch.serve(socket, seen, lambda: self._entrance.who(request) is not None)
        return socket


def help_groups(
    config: Config,
    file: BoxFile,
    place: tuple[float, float] | None,
    *,
    pairings: Pairings,
    lines: LogLines,
    wires: WireLog,
) -> Sequence[Group]:
    """`place`: latitude and longitude of the station; None: not known."""
    secrets = secrets_of(config)
    hidden = secrets | (spellings_of_place(*place) if place else set())

    def pack(examined: dict[str, Any]) -> bytes:
        paired = pairings.all()
        # The file goes to a stranger: it has numbers in place of the names of people's browsers.
        names = {each.name: str(Source(PAGE, each.number)) for each in paired}
        known = Known(config, file.status(), examined, lines.kept(), wires.recording(), len(paired), time.time())
        return diagnostics(known, Redaction(hidden, names), read_text)

    checks = doctor(file.file or SIMULATED_FILE, Redaction(secrets), time.monotonic, time.time, kept_s=DOCTOR_KEPT_S)
    return (
        lambda entrance: HelpApi(entrance, checks, wires, pack).routes(),
        lambda _entrance: BackupApi(file, config, time.time).routes(),
    )
