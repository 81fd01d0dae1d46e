"""Replaces a file as a whole: after a power failure at any time the file has the old content or the new, never a part.
Or, for a small file that is written at each move, overwrites its one block: a seventh of the wear.

Knows files and folders. Does not know what a file contains.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from rotator.store.hanging import under_way

NEW = ".new"
"""The ending of the name under which the new content is written first."""
BLOCK = 4096
"""Bytes: a block of the card's file system, the least that it writes."""


def write_whole(path: Path, content: str | bytes) -> None:
    """Replace the file by `content`, text as UTF-8. Mode and owner stay those of the old file; a link stays a link.

    Raises OSError. Then the old file is unchanged. Exception: if only the last step failed, the sync of the folder, the
    new file is in place, and a power failure may bring the old one back. A second call repeats all steps, and
    overwrites a `.new` file that the first call left.
    """
    with under_way(path):
        _write_whole(path, content)


def write_block(path: Path, content: str) -> None:
    """Overwrite the file's one block, filled up with blanks: neither folder nor file system has anything to note.

    After a power failure in the middle the block may be a mixture: the content must have a check sum. A file that is no
    such block yet, or whose replacement was not finished, is replaced as a whole. Raises OSError.
    """
    block = content.encode("utf-8").ljust(BLOCK)
    with under_way(path):
        path = path.resolve()
        sizes = {len(block), path.stat().st_size if path.is_file() else 0}
        if sizes != {BLOCK} or os.path.lexists(path.with_name(path.name + NEW)):
            _write_whole(path, block)
        else:
            with path.open("r+b") as file:
                file.write(block)
                file.flush()
                os.fdatasync(file.fileno())


def _write_whole(path: Path, content: str | bytes) -> None:
    path = path.resolve()
    new = path.with_name(path.name + NEW)
    with new.open("wb") as file:
        file.write(content.encode("utf-8") if isinstance(content, str) else content)
        file.flush()
        os.fsync(file.fileno())
    with suppress(FileNotFoundError):
        before = path.stat()
        new.chmod(before.st_mode & 0o777)
        with suppress(PermissionError):
            os.chown(new, before.st_uid, before.st_gid)
    new.replace(path)
    # The new name is safe only after the folder itself is on the disk.
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)
