"""A pseudo-terminal with a symlink: a serial port for programs on the same machine.

Knows how to make one that stays up whoever opens and closes it. Knows no protocol.
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
        # The slave stays open here, so the line never hangs up when a client leaves; raw, so nothing is echoed.
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
            # Our own end of a pseudo-terminal does not fail; if it does, there is nothing to reopen.
            await asyncio.Event().wait()
        finally:
            self.close()

    def close(self) -> None:
        """Remove the symlink and the terminal. May be called twice."""
        with suppress(OSError):  # a folder that is gone, or not ours any more: the terminal is closed all the same
            if self._path.is_symlink() and os.readlink(self._path) == self._name:
                self._path.unlink()
        self._close_fds()
        self.wire.state = "closed"

    def _share(self) -> None:
        """Open to whoever may use serial ports: programs of other users than the service's come to this one too."""
        with suppress(KeyError, OSError):
            os.chown(self._name, -1, grp.getgrnam(SERIAL_GROUP).gr_gid)
            os.chmod(self._name, 0o660)

    def _lock(self) -> None:
        """A link left by a program that died may be replaced; one whose program lives may not."""
        self._locked = os.open(self._path.with_name(f".{self._path.name}.lock"), os.O_RDWR | os.O_CREAT, 0o600)
        fcntl.flock(self._locked, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _close_fds(self) -> None:
        fds = (self._master, self._slave, self._locked)
        self._master = self._slave = self._locked = -1
        for fd in fds:
            if fd >= 0:
                os.close(fd)
