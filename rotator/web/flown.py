"""The flown passes on the page: each with its picture, the latest ones on the disk.

Knows requests, and when to draw. A thread of its own draws and writes a picture, because a disk may be slow. Does not
know how a pass is recorded.
"""

from __future__ import annotations

import asyncio
import base64
import hashlib
import logging
import re
from collections.abc import Callable, Sequence
from dataclasses import asdict
from datetime import UTC, datetime

from aiohttp import web
from typing_extensions import TypedDict

from rotator.control.sky.mount import Mount
from rotator.exchange.status import Status
from rotator.protocols.methods import WrongValuesError
from rotator.store.flown import FlownPass, FlownPasses, picture_name
from rotator.views.pass_svg import Flown, draw
from rotator.web.recorder import Record, Recorder
from rotator.web.route import Route, get, refusals
from rotator.web.schema import SVG, in_address

log = logging.getLogger(__name__)

LOOK_S = 0.1
_STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)


_Flown = TypedDict("_Flown", {"flown": list[FlownPass]})


class FlownPictures:
    """`status` gives the latest status. `utc` gives seconds since 1970."""

    def __init__(
        self,
        kept: FlownPasses,
        recorder: Recorder,
        mount: Mount,
        status: Callable[[], Status],
        utc: Callable[[], float],
    ) -> None:
        self._kept = kept
        self._recorder = recorder
        self._mount = mount
        self._status = status
        self._utc = utc
        recorder.over = self._take
        self._over: list[Record] = []

    def routes(self) -> Sequence[Route]:
        async def picture(request: web.Request) -> web.StreamResponse:
            file = request.query.get("file", "")
            if not file:
                raise WrongValuesError("send the name of a picture as ?file=: /api/flown lists them")
            svg = await asyncio.to_thread(self._kept.picture, file)
            if svg is None:
                raise web.HTTPNotFound(reason="there is no picture of that name: /api/flown lists them")
            return web.Response(
                text=svg,
                content_type="image/svg+xml",
                headers={"Content-Security-Policy": policy(svg), "Cache-Control": "private, max-age=86400"},
            )

        return (
            get(
                "/api/flown",
                lambda _: {"flown": [asdict(each) for each in self._kept.passes]},
                ("The last passes that were flown, the latest first", _Flown),
            ),
            get(
                "/api/flown/picture",
                picture,
                ("The picture of one of them", SVG),
                query={"file": in_address("its name, as in /api/flown", "20260401-101500-iss.svg")},
                more=refusals(400, 404),
            ),
        )

    async def run(self) -> None:
        """Watch each status, and draw each pass that is over, until cancelled."""
        while True:
            self._recorder.look(self._status())
            while self._over:
                record = self._over.pop(0)
                try:
                    await asyncio.to_thread(self._keep, record)
                except Exception:
                    # A failed picture must not end the page and its STOP.
                    log.exception("the picture of %s cannot be drawn", record.name)
            await asyncio.sleep(LOOK_S)

    def _take(self, record: Record) -> None:
        self._over.append(record)

    def _keep(self, record: Record) -> None:
        begin_utc_s = self._utc() - (self._status().at_s - record.begin_s)
        flown = FlownPass(
            file=picture_name(record.name, begin_utc_s),
            name=record.name,
            begin_utc_s=round(begin_utc_s, 1),
            end_utc_s=round(begin_utc_s + record.trace[-1].t, 1),
            rms_deg=round(record.rms_deg, 2),
            max_deg=round(record.errors_deg[-1], 2),
            relay_starts=record.relay_starts,
        )
        when = datetime.fromtimestamp(begin_utc_s, UTC)
        antenna = Flown("antenna as measured", "blue", record.trace, record, record.clicks_s)
        self._kept.keep(flown, draw(f"{record.name}, {when:%d %b %Y %H:%M} UTC", [antenna], self._mount))


def policy(svg: str) -> str:
    """The security policy of the picture: only its own style, known by its hash."""
    found = _STYLE.search(svg)
    digest = base64.b64encode(hashlib.sha256(found[1].encode()).digest()).decode() if found else ""
    style = f"style-src 'sha256-{digest}'; " if digest else ""
    return f"default-src 'none'; {style}base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
