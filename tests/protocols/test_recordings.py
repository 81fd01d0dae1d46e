"""Recordings of what programs and the box said to each other, played again: each piece in, each answer byte for byte.

Those in tests/transcripts were made with `rotator monitor --to`, or are in its form. `# at` lines put the antenna where
it was; a silence in the times is a silence.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, get_args

from rotator.assembly.sessions import session_maker
from rotator.config.links import FOLLOW, Link, ProtocolName
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal
from rotator.exchange.status import Status
from rotator.monitor.transcript import At, LinkNote, Piece, Way, parse
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

RECORDINGS = sorted((Path(__file__).parents[1] / "transcripts").glob("*.txt"))
DAY_S = 86_400.0
SKY = Sky(Site(52.5, 13.4), lambda: 1.8e9)
"""The sky of the recordings of telescope programs."""


class Visitor:
    """The box as a link that is read_only sees it."""

    def __init__(self, box: BenchBox) -> None:
        self._box = box

    def status(self) -> Status:
        return self._box.status()

    def note_refused(self, _refused: Refusal | bytes) -> None:
        """Nobody reads the log here."""

    def order(self, _order: Order) -> Refusal:
        return Refusal("the link is read_only", forbidden=True)


class Replay:
    """One connection. What its session says waits until the recording says it too."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._said: list[bytes] = []
        self._heard_s: float | None = None

    def came(self, moment_s: float, data: bytes) -> None:
        self._fall_silent_until(moment_s)
        assert self._said == [], "it said more than was recorded"
        self._heard_s = moment_s
        self._said += self._session.receive(data)

    def went(self, moment_s: float, data: bytes) -> None:
        self._fall_silent_until(moment_s)
        assert self._said[:1] == [data]
        self._said.pop(0)

    def ends(self) -> None:
        self._fall_silent_until(2 * DAY_S)
        assert self._said == [], "it said more than was recorded"

    def _fall_silent_until(self, moment_s: float) -> None:
        idle_s = self._session.idle_s
        if idle_s is not None and self._heard_s is not None and moment_s - self._heard_s >= idle_s:
            self._heard_s = None
            self._said += self._session.idle()


def replay(text: str, box: BenchBox) -> None:
    links: dict[str, Link] = {}
    connections: dict[str, Replay] = {}
    for line in text.splitlines():
        match parse(line):
            case LinkNote(name, keys):
                links[name] = Link.model_validate(keys)
            case At(azimuth_deg, elevation_deg):
                box.stands_at(azimuth_deg, elevation_deg)
                box.goes_on()
            case Piece(moment_s, source, way, data):
                link = links[source.link]
                if str(source) not in connections:
                    seen = Visitor(box) if link.read_only else box
                    connections[str(source)] = Replay(session_maker(link, sky=SKY)(seen))
                connection = connections[str(source)]
                if way is Way.IN:
                    connection.came(moment_s, data)
                else:
                    connection.went(moment_s, data)
    for connection in connections.values():
        connection.ends()


@every_row("path", RECORDINGS)
def test_it_is_said_again(new_box: type[BenchBox], path: Path) -> None:
    box = new_box()
    replay(path.read_text(encoding="ascii"), box)
    moved = "read-only" not in path.stem
    assert bool(box.motions) == moved


def test_there_are_recordings_of_every_maker_s_protocol() -> None:
    spoken = {note.keys["protocol"] for path in RECORDINGS for note in map(parse, path.read_text().splitlines())
              if isinstance(note, LinkNote)}  # fmt: skip
    assert spoken <= set(get_args(ProtocolName)) - {FOLLOW}
    assert {"gs232a", "gs232b", "gs232-f1efw", "rotctld", "easycomm2", "md01", "rot2prog", "dcu1"} <= spoken
