"""Hamlib's rotctld protocol, server side: requests by letter or long name, answers to the byte.

Knows the command table and the answers that old and new clients accept. Unlike the genuine server it is line-based,
answers everything (Gpredict's window freezes on silence) and gives each answer in one piece (Gpredict and SatDump read
once a command).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rotator import __version__
from rotator.orders import Aim, Order, Park, Stop
from rotator.protocols.lines import LineReader
from rotator.protocols.session import Box
from rotator.status import Status

MAX_LINE = 512
NO_NEWLINE_S = 0.1
"""Windows builds of Gpredict up to 2018 end no line: a whole command and then silence is taken as sent."""

OK = 0
INVALID_PARAMETER = -1
NOT_IMPLEMENTED = -4
IO_ERROR = -6

_PRETENDED_MODEL = 603
_BLANKS = re.compile(r"[ \t]+")
_NUMBER = re.compile(r"[+-]?(\d{1,12}([.,]\d{0,12})?|[.,]\d{1,12})([eE][+-]?\d)?")
"""A finite number in any locale; neither `nan` nor `inf` is a direction."""


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command table."""

    letter: str
    name: str
    arguments: int = 0


VERBS = (
    Verb("P", "set_pos", 2),
    Verb("p", "get_pos"),
    Verb("S", "stop"),
    Verb("K", "park"),
    Verb("_", "get_info"),
    Verb("Q", "quit"),
    Verb("q", "quit"),
    Verb("\x8f", "dump_state"),
)
_BY_LETTER = {verb.letter: verb for verb in VERBS}
_BY_NAME = {verb.name: verb for verb in VERBS}


@dataclass(frozen=True, slots=True)
class Request:
    name: str
    arguments: tuple[str, ...] = ()


class BadRequest(ValueError):  # noqa: N818 - it is an answer, not a failure of the program
    """The rest of the line cannot be understood; `code` says why in Hamlib's numbers."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


def requests(line: str) -> Iterator[Request]:
    """The requests in one line, in order. Raises BadRequest where the line stops making sense."""
    words = [word for word in _BLANKS.split(line) if word]
    while words:
        word = words.pop(0)
        if word.startswith("#"):
            return
        if word.startswith("\\"):
            verb, rest = _BY_NAME.get(word[1:]), ""
        else:
            verb, rest = _BY_LETTER.get(word[0]), word[1:]
        if verb is None:
            raise BadRequest(NOT_IMPLEMENTED)
        if rest:
            # `P20 10` and `pp` need no blank.
            words.insert(0, rest)
        if len(words) < verb.arguments:
            raise BadRequest(INVALID_PARAMETER)
        arguments, words = words[: verb.arguments], words[verb.arguments :]
        yield Request(verb.name, tuple(arguments))


def encode(request: Request) -> bytes:
    """A request as a client sends it."""
    letter = _BY_NAME[request.name].letter
    head = letter if letter.isascii() else "\\" + request.name
    return (" ".join((head, *request.arguments)) + "\n").encode()


def report(code: int) -> bytes:
    return f"RPRT {code}\n".encode()


def angle(word: str) -> float:
    """A number as clients of any locale write it. Raises BadRequest."""
    if not _NUMBER.fullmatch(word):
        raise BadRequest(INVALID_PARAMETER)
    return float(word.replace(",", "."))


def dump_state(status: Status) -> bytes:
    """Limits for clients that enforce them. Bare numbers first for Hamlib up to 4.5.0, then `key=value` for later ones.

    Azimuth covers at least the whole circle and elevation 0 to 180, since the box turns any direction into axis angles
    itself; never below zero without need, because CQRLOG takes that for a shifted scale.
    """
    min_az_deg = min(0.0, status.azimuth.min_deg)
    max_az_deg = max(360.0, status.azimuth.max_deg)
    limits = {"min_az": min_az_deg, "max_az": max_az_deg, "min_el": 0.0, "max_el": 180.0}
    rows = ["1", str(_PRETENDED_MODEL)]
    rows += [f"{value:.6f}" for value in limits.values()]
    rows += ["0"]
    rows += [f"{key}={value:.6f}" for key, value in limits.items()]
    rows += ["south_zero=0", "rot_type=AzEl", "done"]
    return "".join(row + "\n" for row in rows).encode()


class RotctldSession:
    idle_s = NO_NEWLINE_S

    def __init__(self, box: Box) -> None:
        self._box = box
        self._lines = LineReader(MAX_LINE)
        self.closed = False

    def receive(self, data: bytes) -> list[bytes]:
        return [reply for line in self._lines.feed(data) for reply in self._answers(line)]

    def idle(self) -> list[bytes]:
        pending = self._lines.pending.decode("latin-1")
        try:
            whole = bool(pending) and all(map(self._complete, requests(pending)))
        except BadRequest:
            return []
        return self._answers(self._lines.flush()) if whole else []

    def _complete(self, request: Request) -> bool:
        return all(_NUMBER.fullmatch(word) for word in request.arguments)

    def _answers(self, line: bytes | None) -> list[bytes]:
        if self.closed:
            return []
        if line is None:
            return [report(INVALID_PARAMETER)]
        try:
            # Understood whole before any of it is obeyed: KEEPALIVE is no order to park.
            understood = list(requests(line.decode("latin-1")))
        except BadRequest as fault:
            return [report(fault.code)]
        replies = []
        for request in understood:
            try:
                replies.append(self._answer(request))
            except BadRequest as fault:
                replies.append(report(fault.code))
            if self.closed:
                break
        return [reply for reply in replies if reply]

    def _answer(self, request: Request) -> bytes:
        match request.name:
            case "set_pos":
                return self._set_position(*map(angle, request.arguments))
            case "get_pos":
                return self._position()
            case "stop":
                return self._order(Stop())
            case "park":
                return self._order(Park())
            case "get_info":
                return f"gs232-rotator {__version__}\n".encode()
            case "dump_state":
                return dump_state(self._box.status())
            case "quit":
                self.closed = True
                return b""
        raise BadRequest(NOT_IMPLEMENTED)

    def _set_position(self, azimuth_deg: float, elevation_deg: float) -> bytes:
        if not (-180 <= azimuth_deg <= 540 and -90 <= elevation_deg <= 180):  # Hamlib's widest limits
            raise BadRequest(INVALID_PARAMETER)
        # A negative azimuth is a direction; only from zero on can it name a turn of the overlap.
        return self._order(Aim(azimuth_deg % 360 if azimuth_deg < 0 else azimuth_deg, elevation_deg))

    def _order(self, order: Order) -> bytes:
        return report(INVALID_PARAMETER if self._box.order(order) else OK)

    def _position(self) -> bytes:
        status = self._box.status()
        if status.azimuth.angle_deg is None or status.elevation.angle_deg is None:
            return report(IO_ERROR)
        return f"{status.azimuth.angle_deg:.2f}\n{status.elevation.angle_deg:.2f}\n".encode()
