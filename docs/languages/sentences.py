"""The sentences in the program's Python that a person reads on the page, as the messages of a catalogue.

Knows Python's grammar: an f-string is a message with {0}, {1}, and one that has words to choose from is several. Knows
the rooms whose words come to the page. The log, the protocols, commands and the API stay English.
"""

from __future__ import annotations

import ast
import itertools
import re
from collections.abc import Iterator
from functools import cache
from itertools import chain
from pathlib import Path

from rotator.config.keys import forms
from rotator.doctor.checks import CONFIGURATION, OF_THE_MACHINE, OF_THE_STATION
from rotator.doctor.finding import Check
from rotator.exchange.faults import OF_ANOTHER_SENSOR, FaultKind, Missing
from rotator.exchange.spoken import short_sender
from rotator.protocols.programs import PROGRAMS
from rotator.views import lcd
from rotator.web.setting_up import plain

ROOT = Path(__file__).resolve().parents[2]
ROOMS = {
    "": (
        *("rotator/control", "rotator/exchange", "rotator/rotors", "rotator/tracking", "rotator/views/words.py"),
        *("rotator/runtime/keeping.py", "rotator/runtime/errands.py", "rotator/protocols/operating.py"),
        *("rotator/web", "rotator/links/wire.py", "rotator/orbits/targets.py", "rotator/orbits/catalogue.py"),
    ),
    "setup": (
        *("rotator/setup/question.py", "rotator/setup/questions.py"),
        *(f"rotator/calibrating/{each}_guide.py" for each in ("axis", "table", "degrees", "stopwatch", "field")),
        *(f"rotator/calibrating/{each}.py" for each in ("guide", "phrases", "question", "on_page", "readings")),
        *(f"rotator/calibrating/{each}.py" for each in ("table_draft", "rig", "at_start")),
    ),
    "doctor": ("rotator/doctor",),
}
"""By the context of their texts: the view of the page that alone shows them, if there is one."""
_SENTENCE = re.compile(r"[a-z]{2,},? [a-z({\d]|[A-Za-z]{2,} [a-z]{2,}|^\{0\}[:,]? [a-z]{2,}|^[A-Z]{3,} [A-Z]{2,}")
_NO_SENTENCE = re.compile(
    r"^[-abs]{3} [-abs]{3} | \+ Enter: |^(?:relays-checked|home|confirm) \{|^\{0\}\{1\}|/api/|max-age|stop = true"
    r"|as the body of|^bold|: write .*rotator|^[\w.-]+$|[<>]|^/|\\|==|^rotator [a-z]|Content-|\bsvg\b"
    r"|^[a-z-]+ '|; |%[sd]|`|\bEnter\b|\by or n\b|\bor b:|\bor n:|rotator calibrate|^which no |^field |^reading"
    r"|\? lists|^\[|nothing here|back here|^Type y |^b takes|^the arrows|^Setting up the|compass \{1\}$|t angle:$"
)
_COMMAND = re.compile(r"^sudo [^.;:,]*$|^sudo ip |^rotator [a-z]+$|^\{0\} \{1\}$|^bold|\|")
"""What of the doctor's advice is a command and no more."""
_KEY = re.compile(r"\{\w+_key\}")
"""A key that turns an axis: for a terminal."""
_SILENT = frozenset(
    [
        *("the", "one_of", "get", "post", "component", "live", "compile", "getLogger", "Logger", "match", "fullmatch"),
        *("sub", "log", "debug", "info", "warning", "exception", "critical", "Method", "startswith", "endswith"),
        *("partition", "rpartition", "split", "removeprefix", "removesuffix", "create_task", "Thread"),
        *("_lead", "_head"),  # a guide's lines for a terminal
        "Check",  # what the doctor looks at, for the documents
    ]
)
"""Calls whose texts nobody reads on the page."""
DESCRIBE = ("openapi.py", "route.py", "schema.py", "logs.py", "assets.py", "foreign.py")
"""Files of these rooms that describe the API, or check what no person types."""
MOST_CHOICES = 8


def messages(path: Path) -> list[str]:
    """The messages of one file."""
    found = [text for node in _read_nodes(ast.parse(path.read_text(encoding="utf-8"))) for text in _texts(node)]
    found = [text for text in found if not _KEY.search(text)]
    wanted = [text for text in dict.fromkeys(map(_clean, found)) if _SENTENCE.search(text)]
    # In the page's own room what begins with a capital describes the API.
    described, no_sentence = "web" in path.parts, _COMMAND if "doctor" in path.parts else _NO_SENTENCE
    return [text for text in wanted if not (no_sentence.search(text) or (described and text[:1].isupper()))]


def names_of_checks() -> list[str]:
    checks: tuple[Check[...], ...] = (CONFIGURATION, *OF_THE_MACHINE, *OF_THE_STATION)
    return [check.name for check in checks]


def _clean(text: str) -> str:
    count = itertools.count()
    return re.sub(r"\{\w*\}|\bSENSOR\b|\bAXIS\b", lambda _: f"{{{next(count)}}}", text).strip()


def _read_nodes(tree: ast.AST) -> Iterator[ast.expr]:
    """The strings that may be read: no docstrings, nothing for the log or a description."""
    for child in ast.iter_child_nodes(tree):
        match child:
            case ast.Expr(value=ast.Constant()) | ast.Assert() | ast.Import() | ast.ImportFrom():
                continue
            case ast.ClassDef(name="State" | "Deed" | "Trust"):
                continue  # rows and columns of a table in the documents
            case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)) if name in _SILENT:
                continue
            case ast.Subscript(value=ast.Name(id="Literal" | "Annotated")):
                continue
            case ast.Raise(exc=ast.Call(func=ast.Name(id="AssertionError" | "TypeError" | "RuntimeError"))):
                continue
            case ast.Constant(value=str()) | ast.JoinedStr():
                yield child
                if isinstance(child, ast.JoinedStr):
                    yield from (each for part in child.values for each in _read_nodes(part))
            case _:
                yield from _read_nodes(child)


def _texts(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.Constant):
        yield str(node.value)
        return
    assert isinstance(node, ast.JoinedStr)
    pieces: list[list[str]] = []
    for part in node.values:
        match part:
            case ast.Constant(value=str() as text):
                pieces.append([text.replace("{", "").replace("}", "")])
            case ast.FormattedValue(
                value=ast.IfExp(body=ast.Constant(value=str() as one), orelse=ast.Constant(value=str() as other))
            ):
                pieces.append([one, other])
            case _:
                pieces.append(["{}"])
    chosen = list(itertools.islice(itertools.product(*pieces), MOST_CHOICES))
    yield from ("".join(each) for each in chosen)


def meanings() -> list[str]:
    """What the settings say of each key and table of the file."""
    told = [each["meaning"] for table in forms() for each in (table, *table["keys"])]
    return list(dict.fromkeys(filter(None, told)))


def of_programs() -> list[str]:
    """What is to be set in a tracking program, and how it is connected; no names."""
    told = [plain(text) for each in PROGRAMS for text in (each.name, each.where, each.settings)]
    return [text for text in dict.fromkeys(told) if re.search(r"[a-z]{2,}[,;:]? [a-z]|, and |^serial$", text)]


def fault_texts() -> list[str]:
    """What the tables of faults say, beside what stands in f-strings."""
    kinds = [text for kind in FaultKind for text in (kind.text, kind.advice)]
    others = [text for text, _, advice in OF_ANOTHER_SENSOR.values() for text in (text, advice)]
    return list(dict.fromkeys(_clean(text) for text in [*kinds, *others, *(each.text for each in Missing)]))


@cache
def display_texts() -> dict[str, int]:
    """The texts of the display, each with the columns that it has room for."""
    beside = (
        [kind.lcd for kind in FaultKind]
        + [each[1] for each in OF_ANOTHER_SENSOR.values()]
        + [each.lcd for each in Missing]
    )
    beside += [
        text
        for room in chain(*ROOMS.values())
        for path in files(room)
        for text in _short(ast.parse(path.read_text(encoding="utf-8")))
    ]
    senders = [short_sender(name) for name in ("keyboard", "console", "page", "panel", "calibrate", "track")]
    return {
        **dict.fromkeys(beside, lcd.BESIDE_AXIS),
        **lcd.WIDTHS,
        **dict.fromkeys(senders, lcd.COLUMNS - lcd.WIDTHS[lcd.STOP] - 2),
    }


def _short(tree: ast.AST) -> Iterator[str]:
    """The second word of a notice."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name(id="Notice"), args=[_, ast.Constant(value=str() as text)]) if text:
                yield text
            case ast.Call(
                func=ast.Name(id="Notice"),
                args=[_, ast.IfExp(body=ast.Constant(value=str() as one), orelse=ast.Constant(value=str() as other))],
            ):
                yield from (one, other)
            case _:
                pass


def files(room: str) -> list[Path]:
    place = ROOT / room
    return [place] if place.suffix else sorted(path for path in place.rglob("*.py") if path.name not in DESCRIBE)
