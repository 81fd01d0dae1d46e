"""The flown passes on the page: their figures, and picture and table of the latest ones, from the disk.

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
from dataclasses import asdict, dataclass, field
from datetime import UTC, datetime
from typing import Annotated

from aiohttp import web
from typing_extensions import TypedDict

from rotator.control.sky.mount import Mount
from rotator.exchange.status import Status
from rotator.protocols.methods import WrongValuesError
from rotator.store.flown import LONGEST_FAULT, LONGEST_NAME, MOST, MOST_FAULTS, FlownPass, FlownPasses, picture_name
from rotator.views.pass_svg import Flown, draw
from rotator.views.trace import Sample, p95
from rotator.web.recorder import Record, Recorder
from rotator.web.route import Route, get, refusals
from rotator.web.schema import SVG, TABLE, in_address, the

log = logging.getLogger(__name__)

LOOK_S = 0.1
_A_DAY = {"Cache-Control": "private, max-age=86400"}
_STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)


_Flown = TypedDict("_Flown", {"flown": list[FlownPass], "pictures": Annotated[int, the("so many have a picture")]})


@dataclass(eq=False)
class FlownPictures:
    """`status` gives the latest status. `utc` gives seconds since 1970."""

    kept: FlownPasses
    recorder: Recorder
    mount: Mount
    status: Callable[[], Status]
    utc: Callable[[], float]
    _over: list[Record] = field(default_factory=list, init=False)

    def __post_init__(self) -> None:
        self.recorder.over = self._take

    def routes(self) -> Sequence[Route]:
        async def kept(request: web.Request, read: Callable[[str], str | None]) -> str:
            file = request.query.get("file", "")
            if not file:
                raise WrongValuesError("send the name of a picture as ?file=: /api/flown lists them")
            text = await asyncio.to_thread(read, file)
            if text is None:
                raise web.HTTPNotFound(reason="there is no picture of that name: /api/flown lists them")
            return text

        async def picture(request: web.Request) -> web.StreamResponse:
            svg = await kept(request, self.kept.picture)
            headers = {"Content-Security-Policy": policy(svg), **_A_DAY}
            return web.Response(text=svg, content_type=SVG["contentMediaType"], headers=headers)

        async def table(request: web.Request) -> web.StreamResponse:
            text = await kept(request, self.kept.table)
            return web.Response(text=text, content_type=TABLE["contentMediaType"], headers=_A_DAY)

        named = {"file": in_address("its name, as in /api/flown", "20260401-101500-iss.svg")}

        return (
            get(
                "/api/flown",
                lambda _: {"flown": [asdict(each) for each in self.kept.passes], "pictures": MOST},
                ("The passes of the last weeks, the latest first, and the figures of each", _Flown),
            ),
            get(
                "/api/flown/picture",
                picture,
                ("The picture of one of them", SVG),
                query=named,
                more=refusals(400, 404),
            ),
            get(
                "/api/flown/table",
                table,
                ("The samples of one of them: moment, target, antenna, error, drives", TABLE),
                query=named,
                more=refusals(400, 404),
            ),
        )

    async def run(self) -> None:
        """Watch each status, and draw each pass that is over, until cancelled."""
        while True:
            self.recorder.look(self.status())
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
        begin_utc_s = self.utc() - (self.status().at_s - record.begin_s)
        flown = FlownPass(
            file=picture_name(record.name, begin_utc_s),
            name=record.name[:LONGEST_NAME],
            begin_utc_s=round(begin_utc_s, 1),
            end_utc_s=round(begin_utc_s + record.trace[-1].t, 1),
            rms_deg=round(record.rms_deg, 2),
            max_deg=round(record.errors_deg[-1], 2),
            relay_starts=record.relay_starts,
            p95_deg=round(p95(record.errors_deg), 2),
            max_el_deg=round(max(0.0, *(sample.target_el for sample in record.trace)), 1),
            motor_s=round(record.motor_s, 1),
            faults=tuple(each[:LONGEST_FAULT] for each in record.faults[:MOST_FAULTS]),
        )
        when = datetime.fromtimestamp(begin_utc_s, UTC)
        antenna = Flown("antenna as measured", "blue", record.trace, record, record.clicks_s)
        drawn = draw(record.name, [antenna], self.mount, f"{when:%d %b %Y %H:%M} UTC")
        self.kept.keep(flown, drawn, csv_of(record.trace, begin_utc_s))


COLUMNS = "utc,t,target_az,target_el,antenna_az,antenna_el,off_deg,az_drive,el_drive"


def csv_of(trace: Sequence[Sample], begin_utc_s: float) -> str:
    """The samples as a table. The antenna's azimuth is on the rotor's own scale; a drive is -1, 0 or 1."""
    rows = (
        f"{datetime.fromtimestamp(begin_utc_s + each.t, UTC):%Y-%m-%dT%H:%M:%S.%f}"[:-5]
        + f"Z,{each.t:.1f},{each.target_az:.2f},{each.target_el:.2f},{each.antenna_az:.2f},{each.antenna_el:.2f}"
        + f",{each.error_deg:.2f},{each.az_drive},{each.el_drive}"
        for each in trace
    )
    return "\n".join((COLUMNS, *rows, ""))


def policy(svg: str) -> str:
    """The security policy of the picture: only its own style, known by its hash."""
    found = _STYLE.search(svg)
    digest = base64.b64encode(hashlib.sha256(found[1].encode()).digest()).decode() if found else ""
    style = f"style-src 'sha256-{digest}'; " if digest else ""
    return f"default-src 'none'; {style}base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
