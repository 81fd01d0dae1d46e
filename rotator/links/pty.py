"""A pseudo-terminal with a symlink: a serial port for programs on the same machine.

Knows how to make a pseudo-terminal that stays open while programs open and close it, and how to keep its symlink for
one running box. Does not know what the bytes mean.
"""

from __future__ import annotations

import asyncio
import fcntl
import grp
import os
import tty
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rotator.links.fd import converse, writer
from rotator.links.wire import Conversation, LinkError, Wire
from rotator.protocols.session import Session

SERIAL_GROUP = "dialout"


class PtyLink:
    """`path`: the symlink to the terminal. `session` makes the protocol's side of the link."""

    def __init__(self, wire: Wire, path: Path, session: Callable[[], Session]) -> None:
        self.wire = wire
        self._path = path
        self._session = session
        self._master = -1
        self._slave = -1
        self._locked = -1
        self._name = ""

    async def open(self) -> None:
        """Raises LinkError."""
        self._master, self._slave = os.openpty()
        # The box keeps the slave open, so that the line does not hang up when a client leaves. Raw: without echo.
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self._name = os.ttyname(self._slave)
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            self._lock()
            if self._path.is_symlink():
                self._path.unlink()
            self._path.symlink_to(self._name)
            self._share()
        except BlockingIOError as fault:
            self._close_fds()
            raise LinkError(f"{self._path}: another program of this kind has it") from fault
        except OSError as fault:
            self._close_fds()
            raise LinkError(f"{self._path}: cannot be made a link to a terminal: {fault.strerror}") from fault
        self.wire.state = f"→ {self._name}"

    async def run(self) -> None:
        try:
            await converse(self._master, Conversation(self._session(), self.wire, writer(self._master)))
            # The master's end is not expected to fail. After a failure the link waits: it cannot be opened again.
            await asyncio.Event().wait()
        finally:
            self.close()

    def close(self) -> None:
        """Remove the symlink and the terminal. May be called twice."""
        with suppress(OSError):  # the folder may be gone; the terminal is closed in any case
            if self._path.is_symlink() and os.readlink(self._path) == self._name:
                self._path.unlink()
        self._close_fds()
        self.wire.state = "closed"

    def _share(self) -> None:
        """Allow the group of serial ports to open the terminal, because the client programs run as other users."""
        with suppress(KeyError, OSError):
            os.chown(self._name, -1, grp.getgrnam(SERIAL_GROUP).gr_gid)
            os.chmod(self._name, 0o660)

    def _lock(self) -> None:
        """Take the lock for the symlink's path. Raises BlockingIOError when a running program has the lock.

        A symlink without a lock is left over from a program that died, and may be replaced.
        """
        self._locked = os.open(self._path.with_name(f".{self._path.name}.lock"), os.O_RDWR | os.O_CREAT, 0o600)
        fcntl.flock(self._locked, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _close_fds(self) -> None:
        fds = (self._master, self._slave, self._locked)
        self._master = self._slave = self._locked = -1
        for fd in fds:
            if fd >= 0:
                os.close(fd)
