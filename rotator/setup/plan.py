"""A set-up that is planned and not yet done: the changes of files, and notes for the user.

Knows how to show a change as a diff. Reads and writes no file, and does not know what the lines mean.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path


class SetupError(Exception):
    """The set-up cannot be done. The text says what the user must do first."""


@dataclass(frozen=True, slots=True)
class Link:
    """A symbolic link."""

    target: str


Content = str | Link | None
"""The content at a path: text (bytes that are no UTF-8 as surrogates), a link, or None where there is no file."""

Files = Mapping[Path, Content]


@dataclass(frozen=True, slots=True)
class Change:
    path: Path
    before: Content
    after: Content
    copied: bool = False
    """The file belongs to the user or to the system: keep a copy of the old one."""


@dataclass(frozen=True, slots=True)
class ChangeSet:
    changes: tuple[Change, ...]
    """Only changes between different contents."""
    notes: tuple[str, ...] = ()
    """Sentences that the user should read before agreeing."""


def planned(
    files: Files, wanted: Mapping[Path, Content], copied: Collection[Path], notes: Iterable[str] = ()
) -> ChangeSet:
    """The changes that make the files what is wanted. `copied`: those that belong to the user or to the system."""
    different = {path: after for path, after in wanted.items() if files[path] != after}
    return ChangeSet(
        tuple(Change(path, files[path], after, path in copied) for path, after in different.items()), tuple(notes)
    )


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
