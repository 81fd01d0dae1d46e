"""Changes keys in the text of a configuration file, and leaves all else as it is: remarks, order, empty lines.

Knows where a key stands and where a new one goes. Does not know which keys there are, nor whether a value is allowed:
the loader checks the text that comes of it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from rotator.config.migrations import brought_up
from rotator.config.statements import Place, places, statements
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
            if isinstance(part, bool) or not ((isinstance(part, int) and part >= 0) or _is_key(part)):
                raise NoChangeError(f"{str(part)[:40]!a} is no key: a key has small letters, figures and _")
        if self.value is not None and not _is_plain(self.value, DEEPEST):
            raise NoChangeError(f"{self.place[-1]}: a value is a text, a number, true or false, or a list of these")


def edited(text: str, changes: Sequence[Change]) -> str:
    """The text with these changes, one after the other. Raises NoChangeError; ValueError for what is no TOML."""
    if len(changes) > MOST_CHANGES:
        raise NoChangeError(f"{len(changes)} changes at a time: {MOST_CHANGES} at most")
    text = brought_up(text)
    for change in changes:
        wanted = _applied(toml_of(text), change)
        if _holds(text, wanted):
            continue
        text = next((new for new in _ways(text, change) if _holds(new, wanted)), "")
        if not _holds(text, wanted):
            where = ".".join(str(part) for part in change.place)
            raise NoChangeError(f"{where}: the file writes this in a way that only an editor can change")
    return text


def _is_key(part: object) -> bool:
    return isinstance(part, str) and _KEY.fullmatch(part) is not None


def _is_plain(value: object, depth: int) -> bool:
    match value:
        case str() | int() | float():
            return True
        case list() if depth:
            return all(_is_plain(each, depth - 1) for each in value)
        case dict() if depth:
            return all(_is_key(key) and _is_plain(each, depth - 1) for key, each in value.items())
        case _:
            return False


def _holds(text: str, wanted: Mapping[str, Any]) -> bool:
    """Whether this text says just that."""
    try:
        return bool(toml_of(text) == wanted)
    except ValueError:
        return False


def _applied(values: dict[str, Any], change: Change) -> dict[str, Any]:
    """What the file is to say after the change. Raises NoChangeError where there is no such table."""
    at: Any = values
    *way, last = change.place
    for part, following in zip(way, change.place[1:], strict=True):
        if isinstance(at, dict) and part not in at:
            at[part] = [] if isinstance(following, int) else {}
        at = _inside(at, part)
    match at, last:
        case dict(), str() if change.value is None:
            at.pop(last, None)
        case dict(), str():
            at[last] = change.value
        case list(), int() if change.value is None and last < len(at):
            del at[last]
            if not at and len(change.place) == 2:
                del values[str(way[0])]
        case list(), int() if isinstance(change.value, dict) and last == len(at):
            at.append(change.value)
        case _:
            raise NoChangeError(f"{change.place[0]}: there is no {last!r} to change")
    return values


def _inside(at: Any, part: int | str) -> Any:
    try:
        inner = at[part]
    except (KeyError, IndexError, TypeError):
        inner = None
    if not isinstance(inner, (dict, list)):
        raise NoChangeError(f"{part!r} is no table of the file")
    return inner


def _ways(text: str, change: Change) -> list[str]:
    """The text changed in each way that may fit. A key that is there keeps its line and its remark."""
    ways = []
    present = change.place in places(text)
    if isinstance(change.place[-1], int):
        ways.append(_without_table(text, change.place) if change.value is None else _with_table(text, change))
    elif change.value is not None and not present:
        ways.append(_with_key(text, change))
    with suppress(TOMLKitError, KeyError, IndexError, TypeError, ValueError):
        ways.append(_by_library(text, change))
    return ways


def _by_library(text: str, change: Change) -> str:
    document = tomlkit.parse(text)
    at: Any = document
    for part in change.place[:-1]:
        at = at[part]
    if change.value is None:
        del at[change.place[-1]]
    else:
        at[change.place[-1]] = _item(change.value)
    return tomlkit.dumps(document)


def _item(value: object) -> Any:
    if isinstance(value, list) and len(value) > LONG_LIST and all(isinstance(each, list) for each in value):
        rows = tomlkit.array()
        rows.extend(value)
        return rows.multiline(True)
    return tomlkit.item(value)


def _line(key: str, value: object) -> str:
    return f"{key} = {_item(value).as_string()}"


def _with_key(text: str, change: Change) -> str:
    """A new key: behind the last key of its table. A table that is not there yet comes at the end."""
    *table, key = change.place
    row = _line(str(key), change.value)
    rows = text.split("\n")
    last = _last_line(text, tuple(table))
    if last is not None:
        return "\n".join([*rows[:last], row, *rows[last:]])
    heading = ".".join(str(part) for part in table if isinstance(part, str))
    if within := next((tuple(table[:to]) for to in range(len(table) - 1, 0, -1) if isinstance(table[to - 1], int)), ()):
        # A table inside one of a list, such as a link's, must follow it.
        last = _last_line(text, within)
        assert last is not None, "the table of the list is in the file"
        return "\n".join([*rows[:last], "", f"[{heading}]", row, *rows[last:]])
    return f"{text.rstrip()}\n\n[{heading}]\n{row}\n".lstrip("\n")


def _with_table(text: str, change: Change) -> str:
    """One more table of a list, such as a link: at the end."""
    assert isinstance(change.value, dict), "what is appended is a table"
    name = ".".join(str(part) for part in change.place[:-1])
    rows = [_line(key, value) for key, value in change.value.items()]
    return "\n".join([text.rstrip(), "", f"[[{name}]]", *rows, ""]).lstrip("\n")


def _without_table(text: str, place: Place) -> str:
    """Without one table of a list, and without the remark right above its heading."""
    lines = places(text)
    first = lines.get(place, (0,))[0]
    found = statements(text)
    heading = next((each for each in found if each.line == first and each.brackets == 2), None)
    if heading is None:
        return text
    after = [each for each in found if each.line > first and each.brackets and each.keys[: len(heading.keys)] != ()]
    following = next((each.line for each in after if _leaves(each.keys, each.brackets, heading.keys)), None)
    last = max(each.last for each in found if each.line >= first and (following is None or each.line < following))
    rows = text.split("\n")
    while first > 1 and rows[first - 2].lstrip().startswith("#"):
        first -= 1
    while last < len(rows) and not rows[last].strip() and first > 1 and not rows[first - 2].strip():
        last += 1
    return "\n".join([*rows[: first - 1], *rows[last:]])


def _leaves(keys: tuple[str, ...], brackets: int, table: tuple[str, ...]) -> bool:
    """Whether a heading begins something else than a part of this table."""
    return keys[: len(table)] != table or (brackets == 2 and keys == table)


def _last_line(text: str, table: Place) -> int | None:
    """The line of the last key of a table, or of its heading; None: it has no heading."""
    lines = places(text)
    found = statements(text)
    at = lines.get(table, ())
    begin = next((each for each in found if each.line in at and each.brackets), None)
    if begin is None:
        return None
    last = begin.line
    for each in found:
        if each.line > begin.line:
            if each.brackets:
                break
            last = each.last
    return last
