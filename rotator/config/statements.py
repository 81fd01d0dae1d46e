"""Where each key and each heading of a TOML text stands: the reader of TOML itself takes each statement apart.

Knows where a statement ends. Does not know which keys there are. What is no TOML has no statement.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rotator.exchange.foreign import STRINGS_AND_REMARKS, toml_of

Place = tuple[int | str, ...]
"""The way to a key: `("link", 0, "pty")`."""
_INNER_END = "\0"
"""In place of a line's end within a text in quotes: no TOML has this character."""


@dataclass(frozen=True, slots=True)
class Statement:
    """A heading, or a key with its value."""

    line: int
    """The statement's first line, from 1."""
    last: int
    place: Place
    """Of a key whose value is a table on one line: that of the first key with a value of its own."""
    heads: bool
    """It is a heading."""


def statements(text: str) -> list[Statement]:
    """In the order of the file, without remarks and empty lines."""
    rows = text.split("\n")
    found: list[Statement] = []
    counts: dict[Place, int] = {}
    table: Place = ()
    for first, last in _spans(text):
        keys = _keys("\n".join(rows[first:last]))
        heads = rows[first].lstrip().startswith("[")
        if heads:
            table = ()
            for part in keys:
                table = (*table, counts[table], part) if table in counts else (*table, part)
            if rows[first].lstrip().startswith("[["):
                counts[table] = counts.get(table, -1) + 1
            table = (*table, counts[table]) if table in counts else table
        if keys:
            found.append(Statement(first + 1, last, table if heads else (*table, *keys), heads))
    return found


def places(text: str) -> Mapping[Place, int]:
    """The line of each key and heading. A table without a heading has the line of the first key in it."""
    found = statements(text)
    within = {each.place[:length]: each.line for each in reversed(found) for length in range(1, len(each.place))}
    return within | {each.place: each.line for each in found}


def _spans(text: str) -> Iterator[tuple[int, int]]:
    """The index of each statement's first row, and the one behind its last. A value goes on to its last bracket."""
    bare = STRINGS_AND_REMARKS.sub(lambda found: "''" + _INNER_END * found[0].count("\n"), text)
    at = first = depth = 0
    for row in bare.split("\n"):
        first = first if depth else at
        at += 1 + row.count(_INNER_END)
        depth = max(0, depth + sum(row.count(mark) for mark in "[{") - sum(row.count(mark) for mark in "]}"))
        if not depth and row.strip():
            yield first, at


def _keys(statement: str) -> tuple[str, ...]:
    """The parts of its name, `sim."azimuth"` taken apart; empty for a remark, and for what is no TOML."""
    try:
        value: Any = toml_of(f"{statement}\n")
    except ValueError:
        return ()
    found = []
    while isinstance(value, dict) and len(value) == 1:
        ((part, value),) = value.items()
        found.append(part)
    return tuple(found)
