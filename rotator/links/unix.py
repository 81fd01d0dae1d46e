"""The path of a Unix socket, which belongs to one running box at a time.

Knows how to claim the path, let the box's group use it, and remove it at the end. Does not know what the bytes on the
socket mean.
"""

from __future__ import annotations

import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

MODE = 0o660
"""Owner and group may connect. The socket has no other access check."""
LONGEST = 107
"""Bytes of a path that the kernel takes for a socket."""


@contextmanager
def short(path: Path) -> Iterator[str]:
    """A name for the socket's path that the kernel takes, also where its folders have long names. Raises OSError."""
    if len(os.fsencode(path)) <= LONGEST:
        yield str(path)
        return
    folder = os.open(path.parent, os.O_PATH | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)


@contextmanager
def claimed(path: Path) -> Iterator[socket.socket]:
    """A socket bound to `path`, not listening yet. Makes missing folders; removes the socket's file at the end.

    Replaces a file that is left over from a box that died. Raises BlockingIOError when a running box has the path, and
    OSError when no socket can be made there.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    locked = os.open(path.with_name(f".{path.name}.lock"), os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600)
    try:
        fcntl.flock(locked, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if path.is_socket():
            path.unlink()
        with short(path) as name, socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as place:
            place.bind(name)
            try:
                # The mode is set before the socket listens, so that no other user can connect in between.
                path.chmod(MODE)
                yield place
            finally:
                path.unlink(missing_ok=True)
    finally:
        os.close(locked)
