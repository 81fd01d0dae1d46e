"""Everything that is wrong with a text that is no configuration, in the order of the file.

Knows the lines of each mistake. The words for a value that the model refuses are in `wording`; what is no TOML is told
as tomllib finds it, and nothing is looked for beyond it. Imported only when a file has a mistake.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotator.config import migrations
from rotator.config.mistake import Mistake, counted
from rotator.config.model import Config
from rotator.config.statements import Place, places
from rotator.config.wording import explain, tables

ENOUGH = 200
"""Mistakes of keys and values: more than a person reads at once, or a file for a rotator can have."""
_PATHS = re.compile(r"[a-z_0-9]+(?:\[\d+\])?(?:\.[a-z_0-9]+)*")
"""What may be a key in the words of a mistake."""
_PLACE = re.compile(r" ?\(at (?:line (\d+), column \d+|end of document)\)")
_WRITTEN = 'a number is written 4.5, a text "in quotes", and a remark begins with #'


def mistakes_in(text: str) -> list[Mistake]:
    """Everything that is wrong with a text that is no configuration."""
    try:
        values = migrations.values(text)
    except migrations.FormatError as fault:
        return [Mistake(str(fault), places(text).get((migrations.KEY,), ())[:1])]
    except ValueError as fault:
        return [_no_toml(text, str(fault))]
    try:
        Config.model_validate(values)
    except ValidationError as invalid:
        lines = places(text)
        found = dict.fromkeys(mistake for error in invalid.errors()[:ENOUGH] for mistake in _located(error, lines))
        several = {name for name, _, many in tables() if many}
        return [Mistake(_counted(each.text, several), each.lines) for each in found]
    return []


def _no_toml(text: str, reason: str) -> Mistake:
    """The first place that is no TOML: its line as it stands, and what the reader of TOML says of it."""
    rows = text.split("\n")
    at = _PLACE.search(reason)
    if at is None:  # too much of it; or Python itself refuses a whole number with more than some thousand digits
        longest = [max(map(len, re.findall(r"[\d_]+", row)), default=0) for row in rows]
        endless = tuple(number for number, digits in enumerate(longest, 1) if digits > 4300)[:1]
        return Mistake("a number has thousands of digits" if endless else reason, endless)
    last = max((number for number, row in enumerate(rows, 1) if row.strip()), default=1)
    line = min(int(at[1]), last) if at[1] else last
    bare = "".join(mark if mark.isprintable() else " " for mark in rows[line - 1].strip())
    shown = bare if len(bare) <= 60 else bare[:57] + "..."
    return Mistake(f"{shown}: is not TOML: {_PLACE.sub('', reason)}; {_WRITTEN}", (line,))


def _counted(text: str, several: Collection[str]) -> str:
    """`link[0].pty` as people count: `the first [[link]]: pty` at the beginning, else `pty of the first [[link]]`."""

    def words(found: re.Match[str]) -> str:
        name, number, key = found.groups()
        if name not in several:
            return found[0]
        one = counted(name, int(number))
        return one if not key else f"{one}: {key}" if found.start() == 0 else f"{key} of {one}"

    return re.sub(r"(?<![\w.\"])([a-z_.]+)\[(\d+)\](?:\.([a-z_][\w.\[\]]*\w\]?))?", words, text)


def _located(error: ErrorDetails, lines: Mapping[Place, tuple[int, ...]]) -> Iterable[Mistake]:
    """The mistake with its lines: those of the keys that it names, else that of its table. The rules across tables
    may have found several at once."""
    place = tuple(error["loc"])
    for words in explain(error).split("\n"):
        if error["type"] != "value_error":
            yield Mistake(words, _line_of(place, lines))
            continue
        sentence = words.removeprefix(f"{'.'.join(map(str, place))}:") if place else words
        named = [line for path in _PATHS.findall(sentence) for line in lines.get((*place, *_place(path)), ())]
        yield Mistake(words, tuple(sorted(set(named))) or _line_of(place, lines))


def _line_of(place: Place, lines: Mapping[Place, tuple[int, ...]]) -> tuple[int, ...]:
    """The line of the key at `place`, or of the nearest table around it."""
    around = (lines[place[:length]] for length in range(len(place), 0, -1) if place[:length] in lines)
    return next(around, ())[:1]


def _place(path: str) -> Place:
    return tuple(int(part) if part.isdigit() else part for part in re.split(r"[.\[\]]+", path) if part)
