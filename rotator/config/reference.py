"""Makes the lists of keys of docs/reference/keys.md from the model, so that page and program agree.

Knows Markdown, the legend of the lists, and the short name of each type of value. The keys and their meanings come
from the model.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rotator.config.keys import NAMED, bare, describe, table_of
from rotator.config.model import Config
from rotator.config.rotors import USUAL

_KINDS = {
    str: "text",
    bool: "true/false",
    int: "whole",
    float: "number",
    list[tuple[float, float]]: "pairs",
    list[str]: "texts",
    list[tuple[float, float, float, float]]: "rows of four",
    tuple[float, float]: "[number, number]",
}
_EDGES = {"ge": "from {}", "gt": "above {}", "le": "to {}", "lt": "below {}"}
_LENGTHS = {"min_length": "{} or more", "max_length": "up to {}"}
"""The wording of a limit. No text may be empty, and the page does not repeat that."""
_LEGEND = """\
In brackets stands the default, as code, then what is allowed: a number from 0 to 360 (0…360), above 0 to 45 (>0…45), a
*whole* number. A key without a default may be left out, unless it *must be given*. *GPIO*: 0 to 57, the BCM number.
*Bus*: the N of /dev/i2c-N, 0 to 255; 1 is on the header. *Address*: an I2C address, 0x08 to 0x77. *Input*: A0 to A3 of
an ADS1115, as 0 to 3. *Pairs*: a list of [number, number]."""
_AXES = ("azimuth", "elevation")
"""Two tables with the same keys, which the page shows as one."""


Row = tuple[str, str, str, str]
"""Key, default, what else is allowed, meaning."""


def reference() -> str:
    """A legend; a heading, a sentence and a list of keys for each table of the file; the defaults of each kind."""
    describe(Config)
    return "\n\n".join([_LEGEND, *_tables([("", Config)], {}), _usual()]) + "\n"


def _usual() -> str:
    lines = []
    for kind, places in USUAL.items():
        tables_of: dict[str, list[str]] = {}
        for place, keys in places.items():
            for key, value in keys.items():
                tables_of.setdefault(f"`{key} = {_toml(value)}`", []).append(f"`{place}`")
        if tables_of:
            lines.append(f"- `{kind}`: " + "; ".join(f"{each} in {', '.join(at)}" for each, at in tables_of.items()))
    intro = "Defaults that differ from those above (limits: on the simulated rotor only)."
    return f"### By kind of rotor\n\n{intro}\n\n" + "\n".join(lines)


def _tables(models: list[tuple[str, type[BaseModel]]], first_tables: dict[Row, str]) -> Iterator[str]:
    """The tables inside these models: one model, or those of both axes, which have the same keys."""
    fields = models[0][1].model_fields
    for name, field in fields.items():
        if table_of(field)[0] is None or (name == _AXES[1] and _AXES[0] in fields):
            continue
        names = _AXES if name == _AXES[0] and _AXES[1] in fields else (name,)
        tables = [(f"{prefix}{each}", model.model_fields[each]) for prefix, model in models for each in names]
        yield from _section(tables, first_tables)
        within = [(f"{path}.", kind) for path, each in tables if (kind := table_of(each)[0]) is not None]
        yield from _tables(within, first_tables)


def _section(tables: list[tuple[str, FieldInfo]], first_tables: dict[Row, str]) -> Iterator[str]:
    """One table of the file, or the same table of both axes. `first_tables`: the first table of each key so far."""
    headings = [f"[[{path}]]" if table_of(field)[1] else f"[{path}]" for path, field in tables]
    yield f"### {' and '.join(f'`{heading}`' for heading in headings)}"
    sentences = [_described(*each) for each in zip(headings, (field for _, field in tables), strict=True)]
    if len(set(sentences)) == 1:
        yield sentences[0]
    rows = [
        [_row(path, key, each) for key, each in kind.model_fields.items() if table_of(each)[0] is None]
        for path, field in tables
        if (kind := table_of(field)[0]) is not None
    ]
    lines = list(_lines([_merged(*each) for each in zip(*rows, strict=True)], headings[0], first_tables))
    if lines:
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
    kind, limits = bare(field.annotation, list(field.metadata))
    default = _default(field)
    named = next((name for name, known in NAMED.items() if kind is int and limits == known), "")
    if named == "address" and field.default is not None:
        default = f"`0x{field.default:02x}`"
    return f"`{key}`", default, named or _allowed(kind, limits, field), _described(f"{heading} {key}", field)


def _allowed(kind: Any, limits: list[Any], field: FieldInfo) -> str:
    """The allowed values beside the default: the other choices, or the type and its bounds."""
    if get_origin(kind) is Literal:
        others = ", ".join(_toml(choice) for choice in get_args(kind) if choice != field.default)
        return f"or {others}" if field.default in get_args(kind) else others
    bounds = _bounds(limits, kind)
    if kind is float or kind is str:
        return bounds or (_KINDS[kind] if field.default is None else "")
    return "" if kind is bool else f"{_KINDS[kind]} {bounds}".strip()


def _described(heading: str, field: FieldInfo) -> str:
    if not field.description:
        raise ValueError(f"{heading} has no description: write a docstring below it")
    return field.description


def _bounds(limits: list[Any], kind: Any) -> str:
    wording = _LENGTHS if kind is str or get_origin(kind) is list else _EDGES
    edges = {name: getattr(limit, name) for limit in limits for name in wording if hasattr(limit, name)}
    if kind is str:
        edges.pop("min_length", None)
    numbers = {name: f"{int(edge) if edge == int(edge) else edge}" for name, edge in edges.items()}
    words = [wording[name].format(number) for name, number in numbers.items()]
    lower = next((f"{sign}{numbers[name]}" for name, sign in (("ge", ""), ("gt", ">")) if name in numbers), None)
    # Both ends in one word: most keys have both.
    text = f"{lower}…{numbers['le']}" if lower is not None and "le" in numbers else " ".join(words)
    return f"{text} characters" if text and kind is str else text


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "must be given"
    value = field.get_default(call_default_factory=True)
    return "" if value is None else f"`{_toml(value)}`"


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
