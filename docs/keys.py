"""Makes the lists of keys of docs/reference/keys.md from the model, so that page and program agree.

Knows Markdown, the legend of the lists, and the short name of each type of value. The keys and their meanings come
from the model, as the page asks for them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any

from pydantic.fields import FieldInfo

from rotator.config.keys import TableOf, bare, describe, question, tables
from rotator.config.kinds import KINDS

_NUMBERS = {
    list[tuple[float, float]]: "pairs",
    list[tuple[float, float, float, float]]: "rows of four",
    tuple[float, float]: "[number, number]",
}
_LEGEND = """\
In brackets stands the default, as code, then what is allowed: a number from 0 to 360 (0…360), above 0 to 45 (>0…45), a
*whole* number. A key without a default may be left out, unless it *must be given*. *GPIO*: 0 to 57, the BCM number.
*Bus*: the N of /dev/i2c-N, 0 to 255; 1 is on the header. *Address*: an I2C address, 0x08 to 0x77. *Input*: A0 to A3 of
an ADS1115, as 0 to 3. *Pairs*: a list of [number, number]."""

Row = tuple[str, str, str, str]
"""Key, default, what else is allowed, meaning."""


def reference() -> str:
    """A legend; a heading, a sentence and a list of keys for each table of the file; the defaults of each kind."""
    describe()
    first_tables: dict[Row, str] = {}
    sections = [part for group in _of_both_axes() for part in _section(group, first_tables)]
    return "\n\n".join([_LEGEND, *sections, _usual()]) + "\n"


def _of_both_axes() -> Iterable[list[TableOf]]:
    """The tables of the file; those of the two axes, which have the same keys, together."""
    groups: dict[str, list[TableOf]] = {}
    for table in tables().values():
        groups.setdefault(table.name.replace("elevation", "azimuth"), []).append(table)
    return groups.values()


def _usual() -> str:
    lines = []
    for name, kind in KINDS.items():
        tables_of: dict[str, list[str]] = {}
        for place, keys in kind.usual.items():
            for key, value in keys.items():
                tables_of.setdefault(f"`{key} = {_toml(value)}`", []).append(f"`{place}`")
        if tables_of:
            lines.append(f"- `{name}`: " + "; ".join(f"{each} in {', '.join(at)}" for each, at in tables_of.items()))
    intro = "Defaults that differ from those above (limits: on the simulated rotor only)."
    return f"### By kind of rotor\n\n{intro}\n\n" + "\n".join(lines)


def _section(group: list[TableOf], first_tables: dict[Row, str]) -> Iterator[str]:
    """One table of the file, or the same table of both axes. `first_tables`: the first table of each key so far."""
    yield f"### {' and '.join(f'`{table.heading}`' for table in group)}"
    sentences = {table.field.description or "" for table in group}
    if len(sentences) == 1:
        yield sentences.pop()
    rows = [[_row(table.name, key, field) for key, field in table.keys.items()] for table in group]
    if lines := list(_lines([_merged(*each) for each in zip(*rows, strict=True)], group[0].heading, first_tables)):
        yield "\n".join(lines)


def _lines(rows: list[Row], table: str, first_tables: dict[Row, str]) -> Iterator[str]:
    """The lines of a list. Neighbours with one meaning share a line, and keys of an earlier table are only named."""
    for before, same in groupby(rows, key=first_tables.get):
        if before is not None:
            yield f"- {', '.join(key for key, *_ in same)}: as in `{before}`."
            continue
        for meaning, alike in groupby(same, key=lambda row: row[-1]):
            keys, *cells, _ = zip(*alike, strict=True)
            values = "; ".join(filter(None, (", ".join(each if len(set(each)) > 1 else each[:1]) for each in cells)))
            yield f"- {', '.join(keys)}{f' ({values})' if values else ''}: {meaning}"
    for row in rows:
        first_tables.setdefault(row, table)


def _merged(row: Row, other: Row | None = None) -> Row:
    """One row for a key of both axes. A cell names both values where they differ."""
    if other is None:
        return row
    key, default, allowed, _ = (a if a == b else f"{a}, elevation {b}" for a, b in zip(row, other, strict=True))
    meaning = row[-1] if row[-1] == other[-1] else f"{row[-1]} Elevation: {other[-1][0].lower()}{other[-1][1:]}"
    return key, default, allowed, meaning


def _row(heading: str, key: str, field: FieldInfo) -> Row:
    asked = question(key, field)
    if not asked["meaning"]:
        raise ValueError(f"{heading} {key} has no description: write a docstring below it")
    value = None if asked["needed"] else field.get_default(call_default_factory=True)
    default = "must be given" if asked["needed"] else ""
    if value is not None:
        default = f"`0x{value:02x}`" if asked.get("named") == "address" else f"`{_toml(value)}`"
    return f"`{key}`", default, asked.get("named") or _allowed(asked, value, field), asked["meaning"]


def _allowed(asked: dict[str, Any], value: object, field: FieldInfo) -> str:
    """The allowed values beside the default: the other choices, or the type and its bounds."""
    kind, limits = bare(field.annotation, list(field.metadata))
    longest = "".join(f"up to {limit.max_length}" for limit in limits if hasattr(limit, "max_length"))
    shortest = "".join(f"{limit.min_length} or more" for limit in limits if hasattr(limit, "min_length"))
    match asked["kind"]:
        case "choice":
            others = ", ".join(_toml(choice) for choice in asked["choices"] if choice != value)
            return f"or {others}" if value in asked["choices"] else others
        case "yes":
            return ""
        case "text" if longest:
            return f"{longest} characters"
        case "number" if bounds := _bounds(asked):
            return bounds
        case "text" | "number" as word:
            return "" if asked["needed"] or value is not None else word
        case "whole":
            return f"whole {_bounds(asked)}".strip()
    return " ".join(filter(None, (_NUMBERS.get(kind, "texts"), shortest, longest)))


def _bounds(asked: dict[str, Any]) -> str:
    edges = {edge: _toml(asked[edge]) for edge in ("least", "above", "most", "below") if edge in asked}
    lower = edges.get("least") or (f">{edges['above']}" if "above" in edges else "")
    if lower and "most" in edges:
        # Both ends in one word: most keys have both.
        return f"{lower}…{edges['most']}"
    words = {"least": "from", "above": "above", "most": "to", "below": "below"}
    return " ".join(f"{words[edge]} {number}" for edge, number in edges.items())


def _toml(value: object) -> str:
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return f'"{value}"'
        case [*points]:
            return f"[{', '.join(_toml(point) for point in points)}]"
        case float() if value == int(value):
            return f"{int(value)}"
        case _:
            return f"{value}"
