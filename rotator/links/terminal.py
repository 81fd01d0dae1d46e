"""A pseudo-terminal: its two ends, its line settings, and whether a program has it open.

Knows the kernel's interfaces for terminals, and inotify, which tells who opens a file. Does not know its symlink, nor
what the bytes mean.

The box holds only the master's end. There the kernel says "hung up" as long as no program has the slave open. That does
not show a program that closed it just before the next one opened it: `Openings` sees that.
"""

from __future__ import annotations

import ctypes
import errno
import fcntl
import os
import select
import struct
import termios
import tty
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

READ_BYTES = 4096
MOST_READS = 32
"""Reads for the bytes that one program has left behind: more than the kernel keeps for a terminal."""

_OPEN, _CLOSE_WRITE, _CLOSE_NOWRITE = 0x20, 0x08, 0x10
_EVENT = struct.Struct("iIII")
"""`struct inotify_event`: the watch, what happened, a cookie, and the length of the name that follows."""
_READ_BYTES = 65_536


class Terminal:
    """Raises OSError where the kernel has no more terminals."""

    def __init__(self) -> None:
        self.master, slave = os.openpty()
        os.set_blocking(self.master, False)
        self.name = os.ttyname(slave)
        """The slave's path, /dev/pts/3."""
        tty.setraw(slave)  # without echo; the settings stay while the master is open
        os.close(slave)
        self.openings: Openings | None
        try:
            self.openings = Openings(Path(self.name))
            self.blind = ""
            """Why a closing and an opening in quick succession go unnoticed; empty: they are noticed."""
        except OSError as fault:
            self.openings, self.blind = None, fault.strerror or str(fault)

    @property
    def wanted(self) -> bool:
        """Whether a program has it open, or has left bytes in it that have not been read."""
        return self._events() != select.POLLHUP

    @property
    def free(self) -> bool:
        """Whether no program has it open now."""
        return bool(self._events() & select.POLLHUP)

    def changed_hands(self) -> bool:
        """Whether there was a moment since the last call at which no program had it open. Never waits."""
        return self.openings is not None and self.openings.look()

    def read(self, most_reads: int = 1) -> tuple[bytes, bool]:
        """The bytes that programs have written, and whether no program has it open any more."""
        data = b""
        try:
            for _ in range(most_reads):
                data += os.read(self.master, READ_BYTES)
        except BlockingIOError:
            return data, False
        except OSError:
            return data, True
        return data, False

    def clear(self) -> bool:
        """After the last program has left: drop the answers that it has not read, and what it set on the line.

        Returns False where the terminal can no longer be used: a program that had it for itself alone (TIOCEXCL, as Qt
        and others do) was killed, and the kernel lets no other user's program in.
        """
        free = self.free
        if free and self.openings is not None:
            self.openings.none_left()
        try:
            slave = os.open(self.name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError:
            return not self.free
        try:
            with suppress(OSError, termios.error):
                termios.tcflush(slave, termios.TCIFLUSH)
                if free:
                    fcntl.ioctl(slave, termios.TIOCNXCL)
                    tty.setraw(slave)
        finally:
            os.close(slave)
        # The box itself has opened and closed it here, no program.
        self.changed_hands()
        return True

    def close(self) -> None:
        """May be called twice."""
        if self.openings is not None:
            self.openings.close()
        if self.master >= 0:
            os.close(self.master)
            self.master = -1

    def _events(self) -> int:
        poll = select.poll()
        poll.register(self.master, select.POLLIN)
        return next((events for _, events in poll.poll(0)), 0)


class Openings:
    """How many programs have a file open, and whether there was a moment with no such program.

    Counts from the moment of its making; a program that has the file open already is not counted.

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
