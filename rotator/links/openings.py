"""How many programs have a file open, and whether there was a moment with no such program: Linux's inotify.

Knows the kernel's interface and how to count its events. Does not know what the file is for.
"""

from __future__ import annotations

import ctypes
import errno
import os
import struct
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

_OPEN, _CLOSE_WRITE, _CLOSE_NOWRITE = 0x20, 0x08, 0x10
_EVENT = struct.Struct("iIII")
"""`struct inotify_event`: the watch, what happened, a cookie, and the length of the name that follows."""
_READ_BYTES = 65_536


class Openings:
    """Counts from the moment of its making; a program that has the file open already is not counted.

    The kernel drops an event that is equal to the one before it as long as that one has not been read: two programs
    that open the file in turn would count as one. So the file's folder is watched as well: each opening then gives two
    different events, the folder's and the file's, and equal ones never follow each other. Two programs on two
    processors can still mix their events, so the count may be wrong until `none_left` corrects it.
    """

    def __init__(self, path: Path) -> None:
        """Raises OSError where the kernel gives no more watches."""
        self._libc = ctypes.CDLL(None, use_errno=True)
        self.fd: int = self._libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        """Readable when a program has opened or closed the file."""
        self._count = 0
        if self.fd < 0:
            raise _failure()
        try:
            self._watch(path.parent)
            self._file = self._watch(path)
        except OSError:
            self.close()
            raise

    def look(self) -> bool:
        """Whether the last program that had the file open has closed it since the last look. Never waits."""
        was_free = False
        for watch, happened in self._events():
            if watch != self._file:
                continue
            if happened & _OPEN:
                self._count += 1
            elif happened & (_CLOSE_WRITE | _CLOSE_NOWRITE):
                self._count = max(0, self._count - 1)
                was_free = was_free or self._count == 0
        return was_free

    def none_left(self) -> None:
        """The caller knows in another way that no program has the file open."""
        self._count = 0

    def close(self) -> None:
        if self.fd >= 0:
            os.close(self.fd)
            self.fd = -1

    def _watch(self, path: Path) -> int:
        watch = int(self._libc.inotify_add_watch(self.fd, os.fsencode(path), _OPEN | _CLOSE_WRITE | _CLOSE_NOWRITE))
        if watch < 0:
            raise _failure()
        return watch

    def _events(self) -> Iterator[tuple[int, int]]:
        """The watch and the event of everything that has happened, oldest first."""
        with suppress(BlockingIOError):
            while data := os.read(self.fd, _READ_BYTES):
                at = 0
                while at < len(data):
                    watch, happened, _cookie, name_bytes = _EVENT.unpack_from(data, at)
                    at += _EVENT.size + name_bytes
                    yield watch, happened


def _failure() -> OSError:
    number = ctypes.get_errno() or errno.ENOSYS
    return OSError(number, os.strerror(number))
