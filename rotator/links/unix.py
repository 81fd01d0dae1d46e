"""The path of a Unix socket, which belongs to one running box at a time.

Knows how to claim the path, share it with the box's group, and remove it in the end. Does not know what goes over the
socket.
"""

from __future__ import annotations

import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

MODE = 0o660
"""Owner and group may connect. There is no other check."""


@contextmanager
def claimed(path: Path) -> Iterator[socket.socket]:
    """A socket bound to `path`, not listening yet. Missing folders are made; afterwards the file is removed.

    The file of a box that died is replaced. Raises BlockingIOError when a running box has the path, OSError when no
    socket can be made there.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    locked = os.open(path.with_name(f".{path.name}.lock"), os.O_RDWR | os.O_CREAT, 0o600)
    try:
        fcntl.flock(locked, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if path.is_socket():
            path.unlink()
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as place:
            place.bind(str(path))
            try:
                # Before it listens, so that no other user can connect in between.
                path.chmod(MODE)
                yield place
            finally:
                path.unlink(missing_ok=True)
    finally:
        os.close(locked)
