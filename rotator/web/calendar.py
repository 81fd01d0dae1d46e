"""The plan of the next days as a calendar to subscribe to, as RFC 5545 has it.

Knows the command `rotator sky plan --json`, and the lines of iCalendar. Does not know how a plan is made.
"""

from __future__ import annotations

import asyncio
import re
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from aiohttp import web

from rotator.web.computed import Computed, of_the_program
from rotator.web.entrance import RefusedError
from rotator.web.route import Route, get, refusals
from rotator.web.schema import ICS

HOURS = 72
"""Some calendars ask once a day."""
TAKES_S = 15.0
"""Longest wait of a request for a plan: a connection is cut a little later."""
LINE_BYTES = 75
SAME_S = 1200
"""New elements shift a pass by much less, so that it nearly always keeps its name."""


def calendar(plan: Iterable[Mapping[str, Any]], utc_s: float) -> str:
    """`plan`: as `rotator sky plan --json` prints it. What is left out is not in it."""
    lines = ["BEGIN:VCALENDAR", "VERSION:2.0", "PRODID:-//gs232-rotator//EN", "X-WR-CALNAME:Antenna rotator"]
    lines.append("REFRESH-INTERVAL;VALUE=DURATION:PT1H")
    seen: Counter[str] = Counter()
    for each in plan:
        if not each["flown"]:
            continue
        begin_s, end_s, top_s, leaves_s = (
            datetime.fromisoformat(each[key]).timestamp() for key in ("from", "until", "tca", "set_off")
        )
        key = f"{re.sub('[^A-Za-z0-9]+', '-', each['name'])}-{round(top_s / SAME_S)}"
        seen[key] += 1
        told = f"The antenna sets off at {datetime.fromtimestamp(leaves_s, UTC):%H:%M} UTC."
        told += f" Flown in part: {each['reason']}." if each["reason"] else ""
        lines += [
            *("BEGIN:VEVENT", f"UID:{key}-{seen[key]}@gs232-rotator", f"DTSTAMP:{_utc(utc_s)}"),
            *(f"DTSTART:{_utc(begin_s)}", f"DTEND:{_utc(end_s)}", "TRANSP:TRANSPARENT"),
            f"SUMMARY:{_text(each['name'])}\\, {each['max_el_deg']:.0f}° high",
            *(f"DESCRIPTION:{_text(told)}", "END:VEVENT"),
        ]
    return "".join(f"{piece}\r\n" for line in [*lines, "END:VCALENDAR"] for piece in _folded(line))


def plan_command(path: Path) -> tuple[str, ...]:
    return of_the_program("sky", "plan", "--json", "--hours", str(HOURS), "--config", str(path))


def calendar_route(plan: Computed) -> Route:
    """`plan`: by `plan_command`."""

    async def serve(_request: web.Request) -> web.Response:
        try:
            async with asyncio.timeout(TAKES_S):
                answer = plan.latest() or await plan.newest()
        except TimeoutError:
            raise RefusedError("the plan is still computed: ask again", 503) from None
        if "error" in answer:
            raise RefusedError(answer["error"])
        return web.Response(text=calendar(answer["passes"], time.time()), content_type="text/calendar")

    says = f"The passes that the antenna flies in the next {HOURS} hours, to subscribe to (iCalendar)", ICS
    return get("/api/passes.ics", serve, says, more=refusals(409, 503))


def _utc(utc_s: float) -> str:
    return f"{datetime.fromtimestamp(utc_s, UTC):%Y%m%dT%H%M%SZ}"


def _text(text: str) -> str:
    return re.sub(r"([\\;,])", r"\\\1", text).replace("\n", "\\n")


def _folded(line: str) -> Iterator[str]:
    """Pieces of 75 bytes at most, none of which cuts a character. Each but the first begins with a blank."""
    piece = ""
    for char in line:
        if len((piece + char).encode()) > LINE_BYTES:
            yield piece
            piece = " "
        piece += char
    yield piece
