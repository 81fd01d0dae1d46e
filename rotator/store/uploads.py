"""The folder of the files of elements that people have sent by the page: how many, how large, under which names.

Knows names and bounds, and that a file is checked before it takes its name: a file that is refused leaves nothing, and
the one it should have replaced stays. Does not know elements: the check comes with each file.
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
"""Of one file: ten thousand satellites as TLE."""
MOST_FILES = 16
LONGEST_NAME = 60
SUFFIX = ".txt"
UNCHECKED = "sent.unchecked"
"""While it is checked a file has this name, whose ending no reader of the folder takes."""
_UNFIT = re.compile(r"[^A-Za-z0-9_-]+")


class NotKeptError(ValueError):
    """The file is not kept. The text says why, and what to send instead."""


class Uploads:
    """`put` and `remove` belong to one thread at a time. They may wait for the disk."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def names(self) -> list[str]:
        with suppress(OSError):
            return sorted(path.name for path in self.folder.glob(f"*{SUFFIX}"))
        return []

    def put(self, said: str, content: bytes, faults: Callable[[Path], Sequence[str]]) -> str:
        """Keep a file, in place of one of the same name. `faults`: what is wrong with it. Returns the name that it has.

        `said`: what the person calls it. Raises NotKeptError.
        """
        name = file_name(said)
        if len(content) > MOST_BYTES:
            raise NotKeptError(f"{said[:LONGEST_NAME]!a}: a file has at most {MOST_BYTES:,} bytes")
        there = self.names()
        if name not in there and len(there) >= MOST_FILES:
            raise NotKeptError(f"the box keeps {MOST_FILES} files: remove one first, or give this one its name")
        unchecked = self.folder / UNCHECKED
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            unchecked.write_bytes(content)
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


def file_name(said: str) -> str:
    """The name in this folder of what a person calls a file: never a path, never hidden. Raises NotKeptError."""
    last = said.replace("\\", "/").rpartition("/")[2]
    stem = _UNFIT.sub("-", last.rpartition(".")[0] or last).strip("-")[:LONGEST_NAME]
    if not stem:
        raise NotKeptError("the file needs a name of letters and digits")
    return stem + SUFFIX


def _few(wrong: Sequence[str]) -> str:
    more = f" and {len(wrong) - 1} more" if len(wrong) > 1 else ""
    return f"{wrong[0]}{more}"
