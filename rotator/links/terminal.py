"""A pseudo-terminal: its two ends, its line settings, and whether a program has it open.

Knows the kernel's interface. Does not know its symlink, nor what the bytes mean.

The box holds only the master's end. There the kernel says "hung up" as long as no program has the slave open. That does
not show a program that closed it just before the next one opened it: `Openings` sees that.
"""

from __future__ import annotations

import fcntl
import os
import select
import termios
import tty
from contextlib import suppress
from pathlib import Path

from rotator.links.openings import Openings

READ_BYTES = 4096
MOST_READS = 32
"""Reads for the bytes that one program has left behind: more than the kernel keeps for a terminal."""


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
