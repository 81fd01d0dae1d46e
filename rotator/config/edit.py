"""Changes keys in the text of a configuration file, and leaves all else as it is: remarks, order, empty lines.

Knows where a key stands and where a new one goes. Does not know which keys there are, nor whether a value is allowed:
the loader checks the text that comes of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import takewhile
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from rotator.config.migrations import brought_up
from rotator.config.statements import Place, Statement, places, statements
from rotator.exchange.foreign import toml_of

MOST_CHANGES, DEEPEST = 500, 6
LONG_LIST = 4
"""A list of more points than this has one line for each."""
_KEY = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")


class NoChangeError(ValueError):
    """The text cannot be changed like this. The words say why."""


@dataclass(frozen=True, slots=True)
class Change:
    """One key, or one table of a list such as `("link", 0)`."""

    place: Place
    value: object
    """None: the key or the table is taken out. A table that the list does not have yet: its keys."""

    def __post_init__(self) -> None:
        if not 0 < len(self.place) <= DEEPEST or not isinstance(self.place[0], str):
            raise NoChangeError("a place begins with the name of a table, and has six parts at most")
        for part in self.place:
            if not (_KEY.fullmatch(part) if isinstance(part, str) else type(part) is int and part >= 0):
                raise NoChangeError(f"{str(part)[:40]!a} is no key: a key has small letters, figures and _")
        if self.value is not None and not _is_plain(self.value, DEEPEST):
            raise NoChangeError(f"{self.place[-1]}: a value is a text, a number, true or false, or a list of these")


def edited(text: str, changes: Sequence[Change]) -> str:
    """The text with these changes, one after the other. Raises NoChangeError; ValueError for what is no TOML."""
    if len(changes) > MOST_CHANGES:
        raise NoChangeError(f"{len(changes)} changes at a time: {MOST_CHANGES} at most")
    text = brought_up(text)
    for change in changes:
        wanted = toml_of(text)
        _apply(change, change.value, wanted)
        if toml_of(text) == wanted:
            continue
        new = next((way for way in _ways(text, change) if _says(way, wanted)), None)
        if new is None:
            where = ".".join(str(part) for part in change.place)
            raise NoChangeError(f"{where}: the file writes this in a way that only an editor can change")
        text = new
    return text


def _is_plain(value: object, depth: int) -> bool:
    match value:
        case str() | int() | float():
            return True
        case list() if depth:
            return all(_is_plain(each, depth - 1) for each in value)
        case dict() if depth:
            return all(_KEY.fullmatch(key) and _is_plain(each, depth - 1) for key, each in value.items())
        case _:
            return False


def _says(text: str, wanted: dict[str, Any]) -> bool:
    with suppress(ValueError):
        return toml_of(text) == wanted
    return False


def _apply(change: Change, value: object, values: Any) -> None:
    """Make the change in the keys of a file: plain ones, or those of tomlkit. Raises NoChangeError where there is no
    such table."""
    at = values
    *way, last = change.place
    for part, following in zip(way, change.place[1:], strict=True):
        if isinstance(at, dict) and part not in at:
            at[part] = [] if isinstance(following, int) else {}
        try:
            at = at[part]
        except (IndexError, TypeError):
            at = None
        if not isinstance(at, (dict, list)):
            raise NoChangeError(f"{part!r} is no table of the file")
    match at, last:
        case dict(), str() if value is None:
            at.pop(last, None)
        case dict(), str():
            at[last] = value
        case list(), int() if value is None and last < len(at):
            del at[last]
            if not at and len(change.place) == 2:
                del values[change.place[0]]
        case list(), int() if isinstance(value, dict) and last == len(at):
            at.append(value)
        case _:
            raise NoChangeError(f"{change.place[0]}: there is no {last!r} to change")


def _ways(text: str, change: Change) -> Iterator[str]:
    """The text changed in each way that may fit. A key that is there keeps its line and its remark."""
    if isinstance(change.place[-1], int):
        yield _without_table(text, change.place) if change.value is None else _with_table(text, change)
    elif change.value is not None and change.place not in places(text):
        yield _with_key(text, change)
    with suppress(TOMLKitError, NoChangeError, KeyError, TypeError):
        document = tomlkit.parse(text)
        _apply(change, None if change.value is None else _item(change.value), document)
        yield tomlkit.dumps(document)


def _item(value: object) -> Any:
    if isinstance(value, list) and len(value) > LONG_LIST and all(isinstance(each, list) for each in value):
        rows = tomlkit.array()
        rows.extend(value)
        return rows.multiline(True)
    return tomlkit.item(value)


def _line(key: object, value: object) -> str:
    return f"{key} = {_item(value).as_string()}"


def _with_key(text: str, change: Change) -> str:
    """A new key: behind the last key of its table. A table that is not there yet comes at the end."""
    *table, key = change.place
    row = _line(key, change.value)
    heading = f"[{'.'.join(part for part in table if isinstance(part, str))}]"
    # A table inside one of a list, such as a link's, must follow it.
    of_a_list = next((tuple(table[:to]) for to in range(len(table), 0, -1) if isinstance(table[to - 1], int)), ())
    found = statements(text)
    for place, added in ((tuple(table), [row]), (of_a_list, ["", heading, row])):
        if own := _from_heading(found, place):
            last = [own[0], *takewhile(lambda each: not each.heads, own[1:])][-1].last
            rows = text.split("\n")
            return "\n".join([*rows[:last], *added, *rows[last:]])
    return f"{text.rstrip()}\n\n{heading}\n{row}\n".lstrip("\n")


def _with_table(text: str, change: Change) -> str:
    """One more table of a list, such as a link: at the end."""
    assert isinstance(change.value, dict), "what is appended is a table"
    name = ".".join(str(part) for part in change.place[:-1])
    rows = [_line(key, value) for key, value in change.value.items()]
    return "\n".join([text.rstrip(), "", f"[[{name}]]", *rows, ""]).lstrip("\n")


def _without_table(text: str, place: Place) -> str:
    """Without one table of a list, and without the remark right above its heading."""
    found = _from_heading(statements(text), place)
    if not found:
        return text
    own = list(takewhile(lambda each: each.place[: len(place)] == place, found))
    first, last = own[0].line, own[-1].last
    rows = text.split("\n")
    while first > 1 and rows[first - 2].lstrip().startswith("#"):
        first -= 1
    while last < len(rows) and not rows[last].strip() and first > 1 and not rows[first - 2].strip():
        last += 1
    return "\n".join([*rows[: first - 1], *rows[last:]])


def _from_heading(found: list[Statement], table: Place) -> list[Statement]:
    """The statements from the heading of this table on; none: it has no heading."""
    return next((found[at:] for at, each in enumerate(found) if each.heads and each.place == table), [])
