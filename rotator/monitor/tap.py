"""The tap: it copies all bytes of all links to the terminal picture and to the monitor's listeners.

Knows the interfaces of sessions and inquiries, and which lines a transcript needs. Does not know sockets, files or what
the bytes mean. It changes no bytes, and a session does not notice its tap.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import datetime

from rotator import __version__
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.links.wire import Wire
from rotator.monitor.transcript import HEADS, At, LinkNote, Peer, Way, encode_at, encode_link, encode_peer, encode_piece
from rotator.protocols.session import ClockedSession, Inquiry, Session

MOVED_DEG = 1.0
MOVED_EVERY_S = 1.0
"""A new position line needs a turn of at least MOVED_DEG, and MOVED_EVERY_S since the last such line."""


class Tap:
    """Keeps the last bytes of each link, and makes transcript lines while there are `listeners`.

    `clock` gives the time of day. A position line has the antenna's angles and the source whose orders the antenna
    obeys. The tap adds one when that source changes, and about once a second while the antenna turns. It reads `status`
    only while there are listeners.
    """

    def __init__(self, clock: Callable[[], datetime], status: Callable[[], Status]) -> None:
        self.listeners: list[Callable[[str], None]] = []
        self.on_data: Callable[[], None] = lambda: None
        """Called after a link has received bytes: for the panel's data lamp."""
        self._clock = clock
        self._status = status
        self._wires: dict[str, Wire] = {}
        self._links: list[LinkNote] = []
        self._peers: dict[Source, Peer] = {}
        """Of the network connections that last."""
        self._day = ""
        self._at: At | None = None
        self._at_noted = datetime.min

    def link(self, wire: Wire, keys: Mapping[str, object]) -> None:
        """Add a link, with the keys of its table in the configuration. The greeting of a listener has a line for it."""
        self._wires[wire.name] = wire
        self._links.append(LinkNote(wire.name, keys))

    def greeting(self) -> list[str]:
        """The first lines for a new listener."""
        moment, at = self._clock(), self._where()
        if not self.listeners:
            self._at, self._at_noted = at, moment
        lines = [f"# rotator {__version__}, {moment:%Y-%m-%d}", *map(encode_link, self._links)]
        lines += [*map(encode_peer, self._peers.values()), *HEADS]
        return [*lines, encode_at(at)] if at else lines

    def came(self, source: Source, host: str) -> None:
        """A machine of the network has connected; the listeners hear its address."""
        self._peers[source] = Peer(source, host)
        for listener in list(self.listeners):
            listener(encode_peer(self._peers[source]))

    def left(self, source: Source) -> None:
        self._peers.pop(source, None)

    def note(self, source: Source, way: Way, data: bytes, *, text: bool) -> None:
        """Note bytes on the link of `source`. `text`: the bytes are characters; else they are binary."""
        if not data:
            return
        wire = self._wires.get(source.link)
        if way is Way.IN:
            self.on_data()
        if wire and way is Way.IN:
            wire.came(data)
        elif wire:
            wire.went(data)
        if not self.listeners:
            return
        moment = self._clock()
        for line in (*self._changes(moment), encode_piece(moment, source, way, data, text=text)):
            for listener in list(self.listeners):
                listener(line)

    def _changes(self, moment: datetime) -> list[str]:
        lines = []
        day = f"{moment:%Y-%m-%d}"
        if self._day not in ("", day):
            lines.append(f"# {day}")
        self._day = day
        at = self._where()
        if at and self._is_news(at, moment):
            self._at, self._at_noted = at, moment
            lines.append(encode_at(at))
        return lines

    def _where(self) -> At | None:
        status = self._status()
        azimuth_deg, elevation_deg = status.azimuth.angle_deg, status.elevation.angle_deg
        if azimuth_deg is None or elevation_deg is None:
            return None
        return At(azimuth_deg, elevation_deg, status.controlled_by)

    def _is_news(self, at: At, moment: datetime) -> bool:
        if self._at is None or at.under != self._at.under:
            return True
        moved_deg = max(
            abs(at.azimuth_deg - self._at.azimuth_deg),
            abs(at.elevation_deg - self._at.elevation_deg),
        )
        return moved_deg >= MOVED_DEG and (moment - self._at_noted).total_seconds() >= MOVED_EVERY_S


class TappedSession:
    """A session, with a copy of all its bytes for `tap`. `text`: the bytes are characters; else they are binary.

    `ended` is called when the connection has ended, `came` with the address of its machine, where there is one.
    """

    def __init__(
        self,
        session: Session,
        tap: Tap,
        source: Source,
        *,
        text: bool = True,
        ended: Callable[[], None] = lambda: None,
        came: Callable[[str], None] = lambda _host: None,
    ) -> None:
        self._ended, self._came = ended, came
        self._session = session
        self._tap = tap
        self._source = source
        self._text = text

    def comes_from(self, host: str) -> None:
        self._tap.came(self._source, host)
        self._came(host)

    def ended(self) -> None:
        self._tap.left(self._source)
        self._ended()

    @property
    def idle_s(self) -> float | None:
        return self._session.idle_s

    @property
    def closed(self) -> bool:
        return self._session.closed

    @property
    def every_s(self) -> float | None:
        return self._session.every_s if isinstance(self._session, ClockedSession) else None

    def beat(self) -> list[bytes]:
        return self._noted(self._session.beat()) if isinstance(self._session, ClockedSession) else []

    def receive(self, data: bytes) -> list[bytes]:
        self._tap.note(self._source, Way.IN, data, text=self._text)
        return self._noted(self._session.receive(data))

    def idle(self) -> list[bytes]:
        return self._noted(self._session.idle())

    def finish(self) -> list[bytes]:
        return self._noted(self._session.finish())

    def _noted(self, replies: list[bytes]) -> list[bytes]:
        for reply in replies:
            self._tap.note(self._source, Way.OUT, reply, text=self._text)
        return replies


class TappedInquiry:
    """An inquiry, with a copy of all its bytes for `tap`. Here the box sends first, always characters."""

    def __init__(self, inquiry: Inquiry, tap: Tap, source: Source) -> None:
        self._inquiry = inquiry
        self._tap = tap
        self._source = source

    @property
    def trouble(self) -> str:
        return self._inquiry.trouble

    def ask(self) -> bytes:
        question = self._inquiry.ask()
        self._tap.note(self._source, Way.OUT, question, text=True)
        return question

    def receive(self, data: bytes) -> bool:
        self._tap.note(self._source, Way.IN, data, text=True)
        return self._inquiry.receive(data)
