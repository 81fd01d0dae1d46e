"""Replaces a file as a whole: after a power failure at any time the file has the old content or the new, never a part.
Or, for a small file that is written at each move, overwrites its one block: a seventh of the wear.

Knows files, folders, and links that root must not follow. Does not know what a file contains.
"""

from __future__ import annotations

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rotator.store.hanging import under_way

NEW = ".new"
"""The ending of the name under which the new content is written first."""
MOST_LINKS = 40
"""As many as the kernel follows."""
BLOCK = 4096
"""Bytes: a block of the card's file system, the least that it writes."""


def write_whole(path: Path, content: str | bytes, *, like: Path | None = None, mode: int = 0o600) -> None:
    """Replace the file by `content`, text as UTF-8. Mode and owner stay those of the old file; a link stays a link.

    `like`: the file whose copy this is: its mode and owner are taken. `mode`: of a file that is not there yet.
    Raises OSError. Then the old file is unchanged. Exception: if only the last step failed, the sync of the folder, the
    new file is in place, and a power failure may bring the old one back. A second call repeats all steps, and
    overwrites a `.new` file that the first call left.
    """
    with under_way(path):
        _write_whole(_followed(path), content, _followed(like or path), mode)


def write_block(path: Path, content: str) -> None:
    """Overwrite the file's one block in place. A power failure may mix it: the content must have a check sum.

    A file that is no block yet, or whose replacement was not finished, is replaced as a whole. Raises OSError.
    """
    block = content.encode("utf-8").ljust(BLOCK)
    with under_way(path):
        path = _followed(path)
        sizes = {len(block), path.stat().st_size if path.is_file() else 0}
        if sizes != {BLOCK} or os.path.lexists(path.with_name(path.name + NEW)):
            _write_whole(path, block, path, 0o600)
            return
        folder = _opened(path.parent)
        try:
            opened = os.open(path.name, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=folder)
        finally:
            os.close(folder)
        with open(opened, "r+b") as file:
            file.write(block)
            file.flush()
            os.fdatasync(file.fileno())


def remove_whole(path: Path) -> None:
    """Remove a file so that no power failure brings it back. Raises OSError."""
    path = _followed(path)
    folder = _opened(path.parent)
    try:
        with suppress(FileNotFoundError):
            os.unlink(path.name, dir_fd=folder)
        os.fsync(folder)
    finally:
        os.close(folder)


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Makes one load and one save a single step, because two programs may share this folder. Hold it only briefly."""
    try:
        folder = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    except OSError:  # no folder yet, or not readable: the save reports that
        yield
        return
    try:
        with suppress(OSError):  # a file system without locks
            fcntl.flock(folder, fcntl.LOCK_EX)
        yield
    finally:
        os.close(folder)


def _write_whole(path: Path, content: str | bytes, like: Path, mode: int) -> None:
    before = like.lstat() if like.exists() else None
    name, new = path.name, path.name + NEW
    folder = _opened(path.parent)
    try:
        # No link that lies there is followed, and nobody else may read it before it is whole.
        flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW | os.O_CLOEXEC
        with open(os.open(new, flags, 0o600, dir_fd=folder), "wb") as file:
            os.fchmod(file.fileno(), 0o600)
            file.write(content.encode("utf-8") if isinstance(content, str) else content)
            file.flush()
            if before:
                with suppress(PermissionError):
                    os.fchown(file.fileno(), before.st_uid, before.st_gid)
            os.fchmod(file.fileno(), before.st_mode & 0o777 if before else mode)
            os.fsync(file.fileno())
        os.replace(new, name, src_dir_fd=folder, dst_dir_fd=folder)
        # The new name is safe only after the folder itself is on the disk.
        os.fsync(folder)
    finally:
        os.close(folder)


def _followed(path: Path) -> Path:
    """The place itself. Where root writes, a link of another user is no way there: that user would choose what root
    overwrites. Raises PermissionError."""
    path = path.absolute()
    trusted = {0, int(os.environ.get("SUDO_UID") or 0)}
    for _ in range(MOST_LINKS if os.geteuid() == 0 else 0):
        link = next((at for at in (*reversed(path.parents), path) if at.is_symlink()), None)
        if link is None:
            break
        if link.lstat().st_uid not in trusted:
            raise PermissionError(errno.EPERM, "is a link of another user, and root does not follow it", str(link))
        path = link.parent / os.readlink(link) / path.relative_to(link)
    return path.resolve()


def _opened(folder: Path) -> int:
    """From the root on, so that no part of the way has become a link meanwhile. Raises OSError."""
    way = os.open("/", os.O_PATH | os.O_DIRECTORY | os.O_CLOEXEC)
    for part in (*folder.parts[1:], "."):
        kind = os.O_RDONLY if part == "." else os.O_PATH
        try:
            below = os.open(part, kind | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=way)
        finally:
            os.close(way)
        way = below
    return way
