"""N1MM Logger+ and its rotor messages: orders for an azimuth as XML, and the antenna's azimuth as `name @ 2350`.

Knows the messages, their codec and what they make the box do. Does not know sockets: one `receive` is one datagram.
Sources: what other rotor servers for N1MM receive and send (see docs/reference/wire.md).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from xml.sax.saxutils import unescape

from rotator.exchange.orders import Aim, Stop
from rotator.protocols.aiming import degrees, outside, whole
from rotator.protocols.damaged import is_stop
from rotator.protocols.session import Box, Talk

REPORT_EVERY_S = 15.0
REPORT_MOVED_TENTHS = 10
"""After a turn of this many tenths of a degree it reports at once."""
TURN_TENTHS = 3600

_MESSAGE = re.compile(r"\ufeff?\s*+(?:<\?xml[^<>]*\?>\s*+)?<N1MMRotor>(.*)</N1MMRotor>[\s\0]*", re.DOTALL)
_FIELD = re.compile(r"\s*<([A-Za-z]+)>([^<>]*)</\1>\s*")
_NO = ("0", "false")
_NO_STOP = re.compile(rf"<stop>\s*(?:{'|'.join(_NO)})\s*</stop>", re.IGNORECASE)
_ROTOR = re.compile(r"<rotor>([^<>]*)</rotor>", re.IGNORECASE)

AZIMUTH_TOP_DEG = 360


@dataclass(frozen=True, slots=True)
class Go:
    """Turn the rotor of that name. `offset`: the degrees that N1MM wants added, as text."""

    rotor: str
    azimuth_deg: float
    offset: str = "0.0"


@dataclass(frozen=True, slots=True)
class Halt:
    """Stop the rotor of that name; empty: the message names none."""

    rotor: str


def parse(datagram: bytes) -> Go | Halt | None:
    """One message; None: the datagram is none. A message with a stop in it is a stop, also a damaged one."""
    text = datagram.decode("utf-8", errors="replace")
    if command := _whole(text):
        return command
    rotor = _ROTOR.search(text)
    return Halt(unescape(rotor[1]).strip() if rotor else "") if is_stop(_NO_STOP.sub("", text).encode()) else None


def _whole(text: str) -> Go | Halt | None:
    message = _MESSAGE.fullmatch(text)
    if not message:
        return None
    before, opened, rest = message[1].partition("<stop>")
    inner, closed, after = rest.partition("</stop>")
    fields = _fields(before + after)
    if opened and closed and inner.strip().lower() not in _NO:
        return Halt(((_fields(inner) or {}).get("rotor") or (fields or {}).get("rotor", "")).strip())
    if fields is None or bool(opened) != bool(closed):
        return None
    azimuth_deg = degrees(fields.get("goazi", "").strip())
    if azimuth_deg is None:
        return None
    return Go(fields.get("rotor", "").strip(), azimuth_deg, fields.get("offset", "").strip())


def _fields(text: str) -> dict[str, str] | None:
    fields, at = {}, 0
    while at < len(text):
        found = _FIELD.match(text, at)
        if not found:
            return None
        fields[found[1]] = unescape(found[2])
        at = found.end()
    return fields


class N1mmSession(Talk):
    """N1MM on one PC. It expects no answers.

    `rotor_name`: obey only orders for this rotor, with the same capitals; None: obey all.
    """

    def __init__(
        self,
        box: Box,
        rotor_name: str | None = None,
        remark: Callable[[str], None] = lambda _text: None,
    ) -> None:
        self._box = box
        self._rotor_name = rotor_name
        self._remark = remark

    def receive(self, data: bytes) -> list[bytes]:
        command = parse(data)
        match command:
            case Halt(rotor) if not rotor or self._is_ours(rotor):
                self._box.order(Stop())
            case Go(rotor, azimuth_deg, offset) if self._is_ours(rotor):
                if not 0 <= azimuth_deg <= AZIMUTH_TOP_DEG:
                    self._box.note_refused(outside(azimuth_deg, AZIMUTH_TOP_DEG))
                    return []
                if degrees(offset):
                    self._remark(f"N1MM's offset of {offset} degrees is not added: give the box its own")
                self._box.order(Aim(azimuth_deg, None))
            case None:
                self._box.note_refused(data)
            case Go(rotor) | Halt(rotor):
                self._remark(f'orders for rotor {rotor[:24]!a} are not for this box, which is "{self._rotor_name}"')
        return []

    def _is_ours(self, rotor: str) -> bool:
        return self._rotor_name is None or rotor == self._rotor_name


class N1mmReport:
    """The antenna's azimuth for N1MM's bearing windows: at every call of `due` while it turns, else every 15 s."""

    def __init__(self, box: Box, rotor_name: str) -> None:
        self._box = box
        self._rotor_name = rotor_name
        self._sent_s = -math.inf
        self._sent_tenths = 0

    def due(self, now_s: float) -> bytes | None:
        azimuth_deg = self._box.status().azimuth.points_deg
        if azimuth_deg is None:
            return None
        tenths = whole(azimuth_deg * 10) % TURN_TENTHS
        turned = abs((tenths - self._sent_tenths + TURN_TENTHS // 2) % TURN_TENTHS - TURN_TENTHS // 2)
        if turned < REPORT_MOVED_TENTHS and now_s - self._sent_s < REPORT_EVERY_S:
            return None
        self._sent_s, self._sent_tenths = now_s, tenths
        return f"{self._rotor_name} @ {tenths}".encode()
