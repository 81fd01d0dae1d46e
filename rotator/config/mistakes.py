"""Everything that is wrong with a text that is no configuration, in the order of the file.

Knows harmless values with which it goes on to find further mistakes, and the lines of each. The words are in `wording`,
what is no TOML in `mending`. Imported only when a file has a mistake.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotator.config import mending, migrations
from rotator.config.mistake import Mistake, counted
from rotator.config.model import Config
from rotator.config.statements import Place, places
from rotator.config.wording import explain, sorts, tables

ENOUGH = 200
"""Mistakes of keys and values: more than a person reads at once, or a file for a rotator can have."""
_PATHS = re.compile(r"[a-z_0-9]+(?:\[\d+\])?(?:\.[a-z_0-9]+)*")
"""What may be a key in the words of a mistake."""


def mistakes_in(text: str) -> list[Mistake]:
    """Everything that is wrong with a text that is no configuration."""
    several = {name for name, _, many in tables() if many}
    mended = mending.mended(text, {name for name, *_ in tables()} - several, several, sorts())
    found = list(mended.mistakes)
    try:
        keys = migrations.values(mended.text)
    except migrations.FormatError as fault:
        return [*found, Mistake(str(fault), places(mended.text).get((migrations.KEY,), ())[:1])]
    values = {key: value for key, value in keys.items() if key[:1] != mending.SCRATCH}
    lines = places(mended.text)
    replaced: set[Place] = set()
    seen: list[Mistake] = []
    for _ in range(mending.MOST):
        try:
            Config.model_validate(values)
            break
        except ValidationError as invalid:
            errors = invalid.errors()[:ENOUGH]
        # A line that could not be read may hold just what is missing.
        shown_errors = [error for error in errors if mended.whole or error["type"] not in ("missing", "value_error")]
        shown_errors = [error for error in shown_errors if not _follows(error, replaced)]
        new = [mistake for error in shown_errors for mistake in _located(error, lines) if mistake not in seen]
        seen += new
        for mistake in (Mistake(_counted(each.text, several), each.lines) for each in new):
            _tell(mistake, found, mended.whys)
        if any(not error["loc"] for error in errors) or (shown_errors and not new) or len(found) >= ENOUGH:
            break
        replaced |= {tuple(error["loc"]) for error in errors}
        # One mistake can hide another: limits are compared only if both are numbers. Mend the values, and check again.
        for error in errors:
            _mend(values, list(error["loc"]))
    return found


def _counted(text: str, several: Collection[str]) -> str:
    """`link[0].pty` as people count: `the first [[link]]: pty` at the beginning, else `pty of the first [[link]]`."""

    def words(found: re.Match[str]) -> str:
        name, number, key = found.groups()
        if name not in several:
            return found[0]
        one = counted(name, int(number))
        return one if not key else f"{one}: {key}" if found.start() == 0 else f"{key} of {one}"

    return re.sub(r"(?<![\w.\"])([a-z_.]+)\[(\d+)\](?:\.([a-z_][\w.\[\]]*\w\]?))?", words, text)


def _tell(mistake: Mistake, found: list[Mistake], whys: Mapping[int, str]) -> None:
    """Add a mistake. Two mistakes of one line become one text: the advice of each alone would lead to the other."""
    line = mistake.lines[0] if len(mistake.lines) == 1 else 0
    before = next((at for at, each in enumerate(found) if line in whys and each.lines == (line,)), None)
    if before is None or "; and " in found[before].text:
        found.append(mistake)
    else:
        found[before] = Mistake(f"{whys[line]}; and {mistake.text}", mistake.lines)


def _follows(error: ErrorDetails, replaced: Collection[Place]) -> bool:
    """Whether a rule fails over a key whose faulty value was replaced: with the right value it may hold."""
    place = tuple(error["loc"])
    named = {(*place, *_place(path)) for path in _PATHS.findall(explain(error))}
    return error["type"] == "value_error" and not named.isdisjoint(replaced)


def _located(error: ErrorDetails, lines: Mapping[Place, tuple[int, ...]]) -> Iterable[Mistake]:
    """The mistake with its lines: those of the keys that it names, else that of its table. The rules across tables
    may have found several at once."""
    place = tuple(error["loc"])
    for words in explain(error).split("\n"):
        if error["type"] != "value_error":
            yield Mistake(words, _line_of(place, lines))
            continue
        sentence = words.removeprefix(f"{_dotted(place)}:") if place else words
        named = [line for path in _PATHS.findall(sentence) for line in lines.get((*place, *_place(path)), ())]
        yield Mistake(words, tuple(sorted(set(named))) or _line_of(place, lines))


def _line_of(place: Place, lines: Mapping[Place, tuple[int, ...]]) -> tuple[int, ...]:
    """The line of the key at `place`, or of the nearest table around it."""
    around = (lines[place[:length]] for length in range(len(place), 0, -1) if place[:length] in lines)
    return next(around, ())[:1]


def _place(path: str) -> Place:
    return tuple(int(part) if part.isdigit() else part for part in re.split(r"[.\[\]]+", path) if part)


def _dotted(place: Place) -> str:
    return ".".join(str(part) for part in place)


def _mend(values: dict[str, Any], place: list[int | str]) -> None:
    """Replace the faulty value by a harmless one, to find further faults."""
    parent: Any = values
    *way, last = place
    for part in way:
        if isinstance(parent, list) and not (isinstance(part, int) and part < len(parent)):
            return
        if isinstance(parent, dict) and part not in parent:
            return
        parent = parent[part]
    match parent, last:
        case _ if place[:2] in (["mount", "forbidden"], ["sky", "follow"]) and len(place) > 2:
            # Such a table has keys that must be given. A faulty one is left out, and the others with it.
            values[str(place[0])].pop(place[1])
        case dict(), "protocol":
            places = {"connect": "rotctld-follow", "udp": "pstrotator", "file": "wsjtx"}
            parent[last] = next((protocol for key, protocol in places.items() if key in parent), "rotctld")
        case dict(), "pty" | "serial" | "tcp" | "connect" | "udp" | "file" if place[0] == "link":
            parent[last] = f"mended-{place[1]}:1"
        case dict(), _:
            parent.pop(last, None)
        case list(), int() if place[0] == "link" and len(place) == 2:
            parent[last] = {"protocol": "rotctld", "pty": f"mended-{last}"}
        case _:
            _mend(values, way)
