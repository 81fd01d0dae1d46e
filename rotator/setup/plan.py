"""What a set-up is before it is done: the files it would change, and what a person should know of it.

Knows how to show a change. Touches no file and knows nothing of what is in them.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path


class SetupError(Exception):
    """It cannot be done; the text says in a sentence what a person has to do first."""


@dataclass(frozen=True, slots=True)
class Link:
    """A symbolic link."""

    target: str


Content = str | Link | None
"""What stands at a path: text (bytes that are no UTF-8 as surrogates), a link, or nothing."""

Files = Mapping[Path, Content]


@dataclass(frozen=True, slots=True)
class Change:
    path: Path
    before: Content
    after: Content
    copied: bool = False
    """The file is a person's own: a copy of it is kept."""


@dataclass(frozen=True, slots=True)
class ChangeSet:
    changes: tuple[Change, ...]
    """Only those that change something."""
    notes: tuple[str, ...] = ()
    """Sentences a person should read before agreeing."""


def changes(*wanted: Change) -> tuple[Change, ...]:
    """Those that change something."""
    return tuple(change for change in wanted if change.before != change.after)


def lines(text: str) -> list[str]:
    """The lines with their ends; only a line feed ends one, a carriage return before it belongs to the line."""
    return re.findall(r"[^\n]*\n|[^\n]+", text)


def diff(change: Change) -> Iterator[str]:
    """The change as lines of a unified diff."""
    before, after = _shown(change.before), _shown(change.after)
    old, new = ("/dev/null" if content is None else str(change.path) for content in (change.before, change.after))
    yield from difflib.unified_diff(before, after, old, new, n=2, lineterm="")


def _shown(content: Content) -> list[str]:
    match content:
        case None:
            return []
        case Link(target):
            return [f"(a link to {target})"]
        case text:
            return [line.rstrip("\r\n") for line in lines(text)]
