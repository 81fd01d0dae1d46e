"""The content of the page: the present state of the box in one object for the browser.

Knows a status, and makes plain values of it. Words come from `rotator.views`, so that page, terminal and display say
the same. Knows no HTTP and no browser.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, asdict, dataclass, field, replace
from typing import Annotated, Any, Literal

from typing_extensions import TypedDict

from hw.ports import Direction
from rotator.exchange.flight_order import Fly
from rotator.exchange.motor import Trust
from rotator.exchange.orders import Stop
from rotator.exchange.sources import TRACKER
from rotator.exchange.spoken import sender, spoken
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import Wire
from rotator.protocols.status_object import as_object
from rotator.views import words
from rotator.views.sky_plot import Way, aimed_at, off_deg, pointing
from rotator.web.past import Past, target_deg
from rotator.web.schema import Pair, one_of, the

LAST_BYTES = 24
MOST_POINTS = 180
ITSELF = "the box itself"
_PAGE = re.compile(r"\bpage(?:#(\d+))?\b")
Lamp = Literal["on", "off", "doubted"]
"""A relay. `doubted`: switched off, but perhaps still closed."""
Mood = Literal["good", "plain", "warns", "alarms"]
_MOODS: dict[str, Mood] = {words.GOOD: "good", words.PLAIN: "plain", words.WARNS: "warns", words.ALARMS: "alarms"}


@dataclass(frozen=True, slots=True)
class FlightPath:
    """The directions of a pass."""

    key: Annotated[str, the("no other flight has it")]
    name: str
    points: Annotated[Sequence[Pair], the("azimuth and elevation")]


_Lamps = TypedDict("_Lamps", {"cw": Lamp, "ccw": Lamp, "up": Lamp, "down": Lamp})


class _Link(TypedDict):
    name: str
    protocol: str
    where: str
    state: str
    out: Annotated[bool, the("no program can use it now")]
    heard: Annotated[str, the("the last line that a program sent")]
    count: Annotated[int, the("bytes that came so far")]


class Picture(TypedDict):
    """All values that may change at any time."""

    status: Annotated[Mapping[str, object], one_of("status")]
    headline: str
    mood: Mood
    passes: Annotated[bool, the("every fault ends by itself")]
    antenna: Annotated[Pair | None, the("true azimuth and elevation")]
    target: Annotated[Pair | None, the("true azimuth and elevation")]
    azimuth_deg: float | None
    elevation_deg: float | None
    azimuth_target_deg: float | None
    elevation_target_deg: float | None
    readings: Annotated[list[float | None], the("of both sensors, as they come")]
    off_deg: Annotated[float | None, the("from the target")]
    starts: Annotated[int | None, the("of the relays")]
    tracking: Annotated[str, the("off, planning, tracking; ended:, refused: or rests: and why")]
    goes_on_with: Annotated[str, the("what `go-on` tracks: the words of a target, or plan; empty: nothing")]
    rise_or_set: str
    path: Annotated[str, the("empty, or the key of the flight that /api/path has")]
    stops: Annotated[int, the("how often a person has stopped it since the program began")]
    utc_s: Annotated[float, the("the box's clock, in seconds since 1970")]
    clock_known: Annotated[bool, the("it is right, as the system or a person says")]
    lamps: Annotated[_Lamps, the("of the relays")]
    lcd: Annotated[list[str], the("the rows of the display")]
    mover: Annotated[str, the("whose orders move the antenna, by name")]
    holder: str
    stopper: str
    mode_by: str
    mode_switch: Annotated[bool, the("a front panel has one, and it comes first")]
    notes: list[str]
    links: list[_Link]


@dataclass(eq=False)
class Scene:
    """`status` gives the latest status. `lcd` gives the rows of the display, with a code covered.

    `named`: the name of a paired browser by its number. `tracks`: as `Tracker.state`.
    `goes_on_with`: as `Tracker.goes_on_with`. `utc`: seconds since 1970 by the box's clock, and whether that is right.
    """

    status: Callable[[], Status]
    lcd: Callable[[], Sequence[str]]
    wires: Sequence[Wire]
    named: Callable[[int], str]
    tracks: Callable[[], str]
    _: KW_ONLY
    goes_on_with: Callable[[], str] = lambda: ""
    utc: Callable[[], float]
    clock_is_known: Callable[[], bool]
    past: Past = field(init=False)
    _path: FlightPath = field(default_factory=lambda: FlightPath("", "", []), init=False)
    _counting: threading.Lock = field(default_factory=threading.Lock, init=False)
    """Orders come from several threads, some at the same moment."""
    _flights: int = field(default=0, init=False)
    stops: int = field(default=0, init=False)
    """The number of stops by a person since the start of the program."""

    def __post_init__(self) -> None:
        self.past = Past(self.status)

    def note_order(self, order: object) -> None:
        """Count stops, and take the path of the pass from a flight. Called from any thread."""
        if isinstance(order, Stop) and order.latch:
            with self._counting:
                self.stops += 1
        if isinstance(order, Fly):
            step = max(1, len(order.path) // MOST_POINTS)
            points = [(round(az, 1), round(el, 1)) for _, az, el in order.path[::step]]
            with self._counting:
                self._flights += 1
                self._path = FlightPath(f"{self._flights} {order.name}", order.name, points)

    def path(self) -> dict[str, Any]:
        """The directions of the pass that is flown, or that the antenna waits for. `key`: unique for each flight."""
        return asdict(self._path)

    def now(self) -> Picture:
        status = self.status()
        named_status = self._with_names(status)
        headline, style = words.headline(named_status)
        flown = status.flown
        return {
            "status": as_object(status),
            "headline": headline,
            "mood": _MOODS[style],
            "passes": all(fault.passing for fault in status.faults),
            "antenna": _rounded(pointing(status)),
            "target": _rounded(aimed_at(status)),
            "azimuth_deg": _short(status.azimuth.points_deg),
            "elevation_deg": _short(status.elevation.points_deg),
            "azimuth_target_deg": _short(target_deg(status.azimuth)),
            "elevation_target_deg": _short(target_deg(status.elevation)),
            "readings": [_short(axis.raw, 4) for axis in (status.azimuth, status.elevation)],
            "off_deg": _short(off_deg(status), 2),
            "starts": _starts(status),
            "tracking": self.with_names(self.tracks()),
            "goes_on_with": self.goes_on_with(),
            "rise_or_set": words.rise_or_set(flown, status.at_s) + flown.error_text if flown else "",
            "path": self._path.key if flown and flown.name == self._path.name else "",
            "stops": self.stops,
            "utc_s": round(self.utc(), 2),
            "clock_known": self.clock_is_known(),
            "lamps": {
                "cw": _lamp(status.azimuth, Direction.PLUS),
                "ccw": _lamp(status.azimuth, Direction.MINUS),
                "up": _lamp(status.elevation, Direction.PLUS),
                "down": _lamp(status.elevation, Direction.MINUS),
            },
            "lcd": list(self.lcd()),
            "mover": named_status.controlled_by,
            "holder": named_status.held_by,
            "stopper": named_status.latched,
            "mode_by": named_status.mode_by,
            "mode_switch": status.mode_switch,
            "notes": [*named_status.notices, *words.notes(status), *words.lacks(status), *status.stays],
            "links": [_link(wire) for wire in self.wires],
        }

    def _with_names(self, status: Status) -> Status:
        """The status with the names of people's browsers in place of their numbers."""
        return replace(
            status,
            latched=self._who(status.latched),
            controlled_by=ITSELF if status.controlled_by == TRACKER else self._who(status.controlled_by, status),
            held_by=self._who(status.held_by),
            mode_by=self._who(status.mode_by),
            notices=tuple(self.with_names(notice) for notice in status.notices),
        )

    def _who(self, name: str, moves: Status | None = None) -> str:
        """One sender, with the name of a person's browser. `moves`: the status, if the sender moves the antenna."""
        named = self.with_names(name)
        return named if named != name else sender(name, moves.controlled_from if moves else "")

    def with_names(self, text: str) -> str:
        """A text with the names of people's browsers in place of their numbers."""
        return spoken(_PAGE.sub(lambda found: self._name(found[1]), text))

    def _name(self, number: str | None) -> str:
        return (self.named(int(number)) if number else "") or "the page"


def _starts(status: Status) -> int | None:
    starts = [axis.starts for axis in (status.azimuth, status.elevation) if axis.starts is not None]
    return sum(starts) if starts else None


def _lamp(axis: AxisStatus, direction: Direction) -> Lamp:
    if axis.drive is direction:
        return "on"
    trust = axis.trusts[0 if direction is Direction.PLUS else 1]
    return "doubted" if trust in (Trust.DOUBTED, Trust.WELDED) else "off"


def _link(wire: Wire) -> _Link:
    return {
        "name": wire.name,
        "protocol": wire.protocol,
        "where": wire.where,
        "state": wire.state,
        "out": words.is_out(wire),
        "heard": _readable(wire.last_in),
        "count": wire.count_in,
    }


def _readable(data: bytes) -> str:
    """The last line that a program sent; bytes that are no text are dots."""
    lines = [line for line in re.split(rb"[\r\n]+", data) if line]
    last = lines[-1][-LAST_BYTES:] if lines else b""
    return "".join(chr(byte) if 32 <= byte < 127 else "·" for byte in last)


def _rounded(way: Way | None) -> list[float] | None:
    return None if way is None else [round(way[0], 2), round(way[1], 2)]


def _short(number: float | None, digits: int = 1) -> float | None:
    return None if number is None else round(number, digits) + 0.0
