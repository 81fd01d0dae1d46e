"""A place in the file system where a running box listens: its own as long as it runs, and nobody else's.

Knows how a Unix socket is claimed, shared with the box's group, and left behind tidily. Knows nothing of what is said
on it.
"""

from __future__ import annotations

import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

MODE = 0o660
"""The owner's and the group's: who they are is the only thing that is asked of whoever connects."""


@contextmanager
def claimed(path: Path) -> Iterator[socket.socket]:
    """A socket bound to `path`, not listening yet; the file is gone afterwards. Folders are made.

    What a box left that died is replaced. Raises BlockingIOError where a living one has the place, OSError where none
    can be had there.
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
                # Before it listens: nobody else gets in between.
                path.chmod(MODE)
                yield place
            finally:
                path.unlink(missing_ok=True)
    finally:
        os.close(locked)
