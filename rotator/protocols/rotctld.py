"""Hamlib's rotctld protocol on the wire: the command table, requests and answers, both ways.

Knows letters, long names, separators of the extended protocol and the form of every answer. Does not know what a
command does. Unlike Hamlib's own server it works on whole lines: a line is parsed to its end before any command of it
is obeyed, and arguments do not continue on the next line.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterator
from dataclasses import dataclass

from rotator.protocols.aiming import degrees
from rotator.protocols.damaged import is_stop

MAX_LINE = 512

OK = 0
INVALID_PARAMETER = -1
NOT_IMPLEMENTED = -4
IO_ERROR = -6
REJECTED = -9
NOT_AVAILABLE = -11

REPORT = b"RPRT "
QUESTION = "?"
"""In place of a name: list the names. No value follows it."""
_SEPARATORS = frozenset(string.punctuation) - frozenset("\\_#")
_BLANKS = re.compile(r"[ \t]+")
_OTHER_NAME = re.compile(rb"\W*se", re.IGNORECASE)
_WHOLE = re.compile(r"[+-]?\d{1,9}")


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command table."""

    letter: str
    name: str
    help: str
    arguments: int = 0
    asks: bool = False
    """The first argument may be `?`, and is then the only one."""
    rest_of_line: bool = False
    """Its one argument is the rest of the line."""


VERBS = (
    Verb("P", "set_pos", "Go there: azimuth, elevation", 2),
    Verb("p", "get_pos", "Read azimuth, then elevation"),
    Verb("S", "stop", "Stop everything"),
    Verb("K", "park", "Go to the park position"),
    Verb("R", "reset", "As `S`; any number", 1),
    Verb("M", "move", "Turn until stopped: direction, speed 1 to 100 or -1", 2),
    Verb("V", "set_level", "Set SPEED, 1 to 4", 2, asks=True),
    Verb("v", "get_level", "Read SPEED", 1),
    Verb("U", "set_func", "No rotor has any", 2, asks=True),
    Verb("u", "get_func", "No rotor has any", 1),
    Verb("X", "set_parm", "No rotor has any", 2, asks=True),
    Verb("x", "get_parm", "No rotor has any", 1),
    Verb("C", "set_conf", "Never widens a limit; see below", 2, asks=True),
    Verb("\xad", "get_conf", "Read one value of `3`; `?`: all", 1),
    Verb("_", "get_info", "What this is"),
    Verb("s", "get_status", "What moves, and the ends reached"),
    Verb("w", "send_cmd", "No device to pass it to", 1, rest_of_line=True),
    Verb("1", "dump_caps", "What the rotor can do"),
    Verb("3", "dump_conf", "The values of `get_conf`"),
    Verb("\x8f", "dump_state", "The limits, for `rotctl -m 2`"),
    Verb("L", "lonlat2loc", "Longitude, latitude, characters to locator", 3),
    Verb("l", "loc2lonlat", "Locator to its middle", 1),
    Verb("D", "dms2dec", "Degrees, minutes, seconds, 1 for south or west to decimal", 4),
    Verb("d", "dec2dms", "The same back", 1),
    Verb("E", "dmmm2dec", "Degrees, minutes, 1 for south or west to decimal", 3),
    Verb("e", "dec2dmmm", "The same back", 1),
    Verb("B", "qrb", "Two places to km and bearing", 4),
    Verb("A", "a_sp2a_lp", "Short-path to long-path bearing", 1),
    Verb("a", "d_sp2d_lp", "Short-path km to long-path km", 1),
    Verb("\x8c", "pause", "Answered at once", 1),
    Verb("Q", "quit", "Close the connection"),
    Verb("q", "quit", "Close the connection"),
)
_BY_LETTER = {verb.letter: verb for verb in VERBS}
_BY_NAME = {verb.name: verb for verb in VERBS}


@dataclass(frozen=True, slots=True)
class Request:
    name: str
    arguments: tuple[str, ...] = ()
    separator: str = ""
    """The separator of the answer's records in the extended protocol; empty: the default protocol."""


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to a command. `encode_answer` gives it the form that the request asked for."""

    code: int = OK
    records: tuple[tuple[str, str], ...] = ()
    """(label, value). Only the extended protocol shows labels, and never an empty one."""
    text: str = ""
    """Whole lines that look the same in both protocols."""
    always_reports: bool = False
    """RPRT follows the text in the default protocol too."""
    default_text: str = ""
    """Replaces all of the above in the default protocol."""


class BadRequest(ValueError):  # noqa: N818 - it is an answer, not a failure of the program
    """The rest of the line cannot be parsed or obeyed; `code` is Hamlib's number for the reason."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


def requests(line: str) -> Iterator[Request]:
    """The requests in one line, in order. Raises BadRequest at the first word that is none."""
    words = [word for word in _BLANKS.split(line) if word]
    separator = ""
    while words:
        word = words.pop(0)
        if word.startswith("#"):
            return
        if word[0] in _SEPARATORS:
            separator = "\n" if word[0] == "+" else word[0]
            words[:0] = [word[1:]] if word[1:] else []
            continue
        if word.startswith("\\"):
            verb, rest = _BY_NAME.get(word[1:]), ""
        else:
            verb, rest = _BY_LETTER.get(word[0]), word[1:]
        if verb is None:
            raise BadRequest(NOT_IMPLEMENTED)
        # `P20 10` and `pp` have no blank after the letter.
        words[:0] = [rest] if rest else []
        count = 1 if verb.asks and words[:1] == [QUESTION] else verb.arguments
        if len(words) < count:
            raise BadRequest(INVALID_PARAMETER)
        if verb.rest_of_line:
            words = [" ".join(words)]
        arguments, words = tuple(words[:count]), words[count:]
        yield Request(verb.name, arguments, separator)
        separator = ""
    if separator:
        raise BadRequest(NOT_IMPLEMENTED)


def is_damaged_stop(line: bytes) -> bool:
    """Whether a line that is not understood was meant as a stop, and not as `set_pos` or another long name."""
    return is_stop(line) and not _OTHER_NAME.match(line)


def encode(request: Request) -> bytes:
    """A request as a client sends it."""
    letter = _BY_NAME[request.name].letter
    head = letter if letter.isascii() else "\\" + request.name
    mark = "+" if request.separator == "\n" else request.separator
    return (mark + " ".join((head, *request.arguments)) + "\n").encode()


def encode_answer(request: Request, answer: Answer) -> bytes:
    """An answer in the form that its request asked for."""
    succeeded = answer.code == OK
    if request.separator:
        mark = request.separator
        rows = [" ".join((f"{request.name}:", *request.arguments))]
        rows += [f"{label}: {value}" if label else value for label, value in answer.records] if succeeded else []
        text = "".join(row + mark for row in rows) + (answer.text if succeeded else "")
        return text.encode("latin-1") + report(answer.code)
    text = "".join(f"{value}\n" for _, value in answer.records) + answer.text if succeeded else ""
    text = answer.default_text or text
    return text.encode("latin-1") + (report(answer.code) if not text or answer.always_reports else b"")


def report(code: int) -> bytes:
    return REPORT + f"{code}\n".encode()


def number(word: str) -> float:
    """Raises BadRequest."""
    if (value := degrees(word)) is None:
        raise BadRequest(INVALID_PARAMETER)
    return value


def whole_number(word: str) -> int:
    """Raises BadRequest."""
    if not _WHOLE.fullmatch(word):
        raise BadRequest(INVALID_PARAMETER)
    return int(word)
