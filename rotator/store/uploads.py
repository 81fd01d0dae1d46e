"""The folder of the files of elements that people have uploaded on the page: their number, sizes and names.

Knows names and bounds, and that a file is checked before it gets its name: a refused file leaves no trace, and the file
that it should replace stays. Does not know elements: the caller gives the check.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

from rotator.store.whole import write_whole

FOLDER = "uploaded"
"""Beside the state file."""
MOST_BYTES = 2_000_000
"""Bytes of one file: ten thousand satellites as TLE."""
MOST_FILES = 16
LONGEST_NAME = 60
SUFFIX = ".txt"
UNCHECKED = "sent.unchecked"
"""Name of a file during the check. No reader of the folder takes this ending."""
_UNFIT = re.compile(r"[^A-Za-z0-9_-]+")


class NotKeptError(ValueError):
    """The file is not kept. The text says why, and what to send instead."""


class Uploads:
    """Call `put` and `remove` from one thread at a time. They may wait for the disk."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def names(self) -> list[str]:
        with suppress(OSError):
            return sorted(path.name for path in self.folder.glob(f"*{SUFFIX}"))
        return []

    def put(self, sent_name: str, content: bytes, faults: Callable[[Path], Sequence[str]]) -> str:
        """Store a file, in place of one of the same name. `faults` returns its errors. Returns its name in the folder.

        `sent_name`: the person's name for it. Raises NotKeptError.
        """
        name = file_name(sent_name)
        if len(content) > MOST_BYTES:
            raise NotKeptError(f"{sent_name[:LONGEST_NAME]!a}: a file has at most {MOST_BYTES:,} bytes")
        there = self.names()
        if name not in there and len(there) >= MOST_FILES:
            raise NotKeptError(f"the box keeps {MOST_FILES} files: remove one first, or give this one its name")
        unchecked = self.folder / UNCHECKED
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            write_whole(unchecked, content)
            try:
                if wrong := faults(unchecked):
                    raise NotKeptError(f"{name} is not taken: {_few(wrong)}")
                write_whole(self.folder / name, content)
            finally:
                unchecked.unlink(missing_ok=True)
        except OSError as fault:
            raise NotKeptError(f"{name} cannot be kept: {fault.strerror or fault}") from None
        return name

    def remove(self, name: str) -> None:
        """Raises NotKeptError."""
        if name not in self.names():
            raise NotKeptError(f"there is no {name[:LONGEST_NAME]!a} among the files that were sent")
        try:
            (self.folder / name).unlink()
        except OSError as fault:
            raise NotKeptError(f"{name} cannot be removed: {fault.strerror or fault}") from None


def file_name(sent_name: str) -> str:
    """The name in this folder for a person's name of a file: never a path, never hidden. Raises NotKeptError."""
    last = sent_name.replace("\\", "/").rpartition("/")[2]
    stem = _UNFIT.sub("-", last.rpartition(".")[0] or last).strip("-")[:LONGEST_NAME]
    if not stem:
        raise NotKeptError("the file needs a name of letters and digits")
    return stem + SUFFIX


def _few(wrong: Sequence[str]) -> str:
    more = f" and {len(wrong) - 1} more" if len(wrong) > 1 else ""
    return f"{wrong[0]}{more}"
