"""Reads a file that a person has named, whole: an ordinary file of a sensible size.

The read of a pipe without a writer, or of an endless device, would never end. Knows file types and sizes. Does not know
the content of the file.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

MOST_BYTES = 4_000_000
"""Bytes. A configuration has some thousand, a pass a hundred thousand."""


class NoPlainFileError(OSError):
    """This name is no file that can be read whole. `strerror` says what it is, for the user."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(0, reason, str(path))


def read_plain(path: Path, most_bytes: int = MOST_BYTES) -> bytes:
    """The bytes of the file. Raises OSError; its kind NoPlainFileError: a pipe, a device or too large."""
    # O_NONBLOCK: a pipe without a writer is opened at once.
    with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
        mode = os.fstat(file.fileno()).st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(0, "is a folder", str(path))
        if not stat.S_ISREG(mode):
            raise NoPlainFileError(path, "is a device or a pipe, no file: save what it should hold in a file")
        data = file.read(most_bytes + 1)
    if len(data) > most_bytes:
        raise NoPlainFileError(path, f"has more than {most_bytes // 1_000_000} MB: another file must be meant")
    return data
