"""Everything that is wrong with a text that is no configuration, in the order of the file.

Knows the lines of each mistake, the errors of pydantic, and the keys and words that come near to what was written. What
is no TOML is told as tomllib finds it, and nothing is looked for beyond it. Imported only when a file has a mistake.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterable, Mapping
from typing import Literal, get_args, get_origin

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from rotator.config import migrations
from rotator.config.keys import bare, tables
from rotator.config.mistake import Mistake, counted
from rotator.config.model import Config
from rotator.config.statements import Place, places

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
        return [Mistake(str(fault), _line_of((migrations.KEY,), places(text)))]
    except ValueError as fault:
        return [_no_toml(text, str(fault))]
    try:
        Config.model_validate(values)
    except ValidationError as invalid:
        lines = places(text)
        found = dict.fromkeys(mistake for error in invalid.errors()[:ENOUGH] for mistake in _located(error, lines))
        several = {name for name, table in tables().items() if table.many}
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


def _located(error: ErrorDetails, lines: Mapping[Place, int]) -> Iterable[Mistake]:
    """The mistake with its lines: those of the keys that it names, else that of its table. The rules across tables
    may have found several at once."""
    place = tuple(error["loc"])
    if error["type"] != "value_error":
        yield Mistake(_explain(error), _line_of(place, lines))
        return
    for sentence in str(error["ctx"]["error"]).split("\n"):
        words = f"{_written(place)}: {sentence}" if place else sentence
        named = {line for path in _PATHS.findall(sentence) if (line := lines.get((*place, *_place(path))))}
        yield Mistake(words, tuple(sorted(named)) or _line_of(place, lines))


def _line_of(place: Place, lines: Mapping[Place, int]) -> tuple[int, ...]:
    """The line of the key at `place`, or of the nearest table around it."""
    around = ((lines[place[:length]],) for length in range(len(place), 0, -1) if place[:length] in lines)
    return next(around, ())


def _place(path: str) -> Place:
    return tuple(int(part) if part.isdigit() else part for part in re.split(r"[.\[\]]+", path) if part)


_KINDS = {
    "float": "a number",
    "int": "a whole number",
    "bool": "true or false",
    "string": "text in quotes",
    "list": "a list in brackets",
    "tuple": "a pair of numbers in brackets",
    "model": "a table",
}
"""The first word of a pydantic error type, in words for the user."""


def _explain(error: ErrorDetails) -> str:
    """One mistake: the key, its value, what is allowed, and what was probably meant."""
    place = list(error["loc"])
    key = _written(place)
    value = error["input"]
    match error["type"]:
        case "extra_forbidden" if len(place) == 1 and isinstance(value, (dict, list)):
            there = {name: table.heading for name, table in tables().items() if "." not in name}
            meant = _meant(key, there) or f"; there are {', '.join(there)}"
            return f"[{key}]: no such table{meant}"
        case "extra_forbidden":
            known = list(_fields_at(place))
            meant = _meant(str(place[-1]), known) or f"; known here: {', '.join(known)}"
            return f"{key} = {_show(value)}: no such key{meant}"
        case "missing":
            choices = _choices(place)
            return f"{key}: must be given{', one of ' if choices else ''}{', '.join(choices)}"
        case "literal_error":
            allowed = _choices(place)
            return f"{key} = {_show(value)}: must be one of {', '.join(allowed)}{_meant(str(value), allowed)}"
        case kind:
            sort = kind.split("_")[0]
            expected = _KINDS.get(sort) if kind.endswith(("_type", "_parsing")) else None
            expected = expected or error["msg"].removeprefix("Input should be ")
            table = tables().get(key) if isinstance(value, (dict, list)) else None
            return f"{key} = {_show(value)}: must be {expected}{f'; write {table.heading}' if table else ''}"


def _written(place: Iterable[int | str]) -> str:
    """As the page names a key: `link[0].pty`."""
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def _show(value: object) -> str:
    """A value as TOML writes it, if that is short."""
    match value:
        case bool():
            text = "true" if value else "false"
        case str():
            text = f'"{value}"'
        case dict():
            text = "{ " + ", ".join(f"{key} = {_show(each)}" for key, each in value.items()) + " }"
        case list() | tuple():
            text = f"[{', '.join(_show(each) for each in value)}]"
        case _:
            text = f"{value}"
    text = text if text.isprintable() else ascii(text)
    return text if len(text) <= 60 else text[:57] + "..."


def _choices(place: list[int | str]) -> list[str]:
    """The words or numbers from which a key takes one; empty: any."""
    field = _fields_at(place).get(str(place[-1]))
    kind = bare(field.annotation, [])[0] if field else None
    return [str(choice) for choice in get_args(kind)] if get_origin(kind) is Literal else []


def _fields_at(place: list[int | str]) -> dict[str, FieldInfo]:
    """Those of the table with this key."""
    table = tables().get(".".join(part for part in place[:-1] if isinstance(part, str)))
    return (table.model if table else Config).model_fields


def _meant(word: str, known: Iterable[str]) -> str:
    """The one that differs least, by its letters alone: nothing is guessed of what a person calls it. Empty: none."""
    names = known if isinstance(known, dict) else {each: each for each in known}
    near = next(iter(difflib.get_close_matches(word.lower(), names, n=1)), "")
    return f"; did you mean {names[near]}?" if near else ""
