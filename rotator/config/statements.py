"""Where each key and each heading of a TOML text stands: its line, also in a text that is no TOML yet.

Knows headings, keys, texts in quotes and lists over several lines. Does not know which keys there are, nor values.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rotator.exchange.foreign import toml_of

Place = tuple[int | str, ...]
"""The way to a key: `("link", 0, "pty")`."""

_HEADING = re.compile(r"\s*(\[\[?)([^\[\]]+)(\]\]?)\s*(?:#.*)?")
_KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"|'[^']*'))*)\s*=""")
_NEXT = re.compile(r"\s*(?:[A-Za-z_][\w.-]*\s*=|\[\[?[A-Za-z_][\w. -]*\]\]?\s*(?:#.*)?$)")
"""A line like this begins something new, even where a list before it has not been closed."""
_TOKENS = re.compile(r'"""|\'\'\'|(?<!\\)"(?:\\.|[^"\\])*+"|\'[^\']*\'|#.*|[\[\]{}]')


@dataclass(frozen=True, slots=True)
class Statement:
    """A heading, a key with its value, or a line that is neither."""

    line: int
    """The statement's first line, from 1."""
    last: int
    keys: tuple[str, ...] = ()
    """The parts of its name; empty for what is neither heading nor key."""
    brackets: int = 0
    """Of a heading: 1 or 2; 0 for a key."""


def statements(text: str) -> list[Statement]:
    """In the order of the file, without remarks and empty lines."""
    found = []
    lines = text.split("\n")
    at = 0
    while at < len(lines):
        line = lines[at].rstrip("\r")
        bare = line.strip()
        if bare and not bare.startswith("#"):
            heading, key = _HEADING.fullmatch(line), _KEY.match(line)
            if heading and not key:
                found.append(Statement(at + 1, at + 1, parts(heading[2]), len(heading[1])))
            elif key:
                last = _end_of_value(lines, at, key.end())
                found.append(Statement(at + 1, last + 1, parts(key[1])))
                at = last
            else:
                found.append(Statement(at + 1, at + 1))
        at += 1
    return found


def places(text: str) -> Mapping[Place, tuple[int, ...]]:
    """The lines of each key and heading; a table has those of its headings, or that of its first key."""
    found: dict[Place, list[int]] = {}
    unsaid: dict[Place, tuple[int, ...]] = {}
    counts: dict[Place, int] = {}
    table: Place = ()
    for statement in statements(text):
        if statement.brackets:
            *way, last = statement.keys or ("",)
            parent: Place = ()
            for part in way:
                parent = _inside((*parent, part), counts)
            table = (*parent, last)
            if statement.brackets == 2:
                counts[table] = counts.get(table, -1) + 1
            table = _inside(table, counts)
        place = table if statement.brackets else (*table, *statement.keys)
        for length in range(1, len(place)):
            unsaid.setdefault(place[:length], (statement.line,))
        if statement.brackets or statement.keys:
            found.setdefault(place, []).append(statement.line)
    return unsaid | {place: tuple(lines) for place, lines in found.items()}


def parts(key: str) -> tuple[str, ...]:
    """`sim."azimuth"` taken apart; empty for what is no key."""
    try:
        value: object = toml_of(f"{key.strip()} = 0")
    except ValueError:
        return ()
    found = []
    while isinstance(value, dict):
        ((part, value),) = value.items()
        found.append(part)
    return tuple(found)


def _inside(table: Place, counts: Mapping[Place, int]) -> Place:
    return (*table, counts[table]) if table in counts else table


def _end_of_value(lines: list[str], first: int, begin: int) -> int:
    """The index of the last line of a value that begins in line `first`."""
    depth = 0
    quote = ""
    at, text = first, lines[first][begin:]
    while True:
        for token in _tokens(text, quote):
            match token:
                case '"""' | "'''":
                    quote = "" if quote else token
                case "[" | "{":
                    depth += 1
                case "]" | "}":
                    depth = max(depth - 1, 0)
        over = not depth and not quote
        if over or at + 1 == len(lines) or (not quote and _NEXT.match(lines[at + 1])):
            return at
        at += 1
        text = lines[at]


def _tokens(text: str, quote: str) -> Iterator[str]:
    """The brackets and the marks of long texts; `quote`: the mark of the long text in which the line begins."""
    at = 0
    while True:
        if quote:
            at = text.find(quote, at) + len(quote)
            if at < len(quote):
                return
            yield quote
            quote = ""
        token = _TOKENS.search(text, at)
        if token is None:
            return
        at = token.end()
        if token[0] in ('"""', "'''"):
            quote = token[0]
        if len(token[0]) == 1 or quote:
            yield token[0]
