"""Replaces a file whole or not at all, even if the power fails at any moment.

Knows files. Does not know their content.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

NEW = ".new"


def write_whole(path: Path, content: str | bytes) -> None:
    """Replace the file by `content`, text as UTF-8. Raises OSError; then the old file is unchanged.

    A `.new` file that an earlier attempt left is overwritten. Mode and owner stay those of the old file; a symbolic
    link stays a link.
    """
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
