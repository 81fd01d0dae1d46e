"""A pseudo-terminal with a symlink: a serial port for programs on the same machine.

Knows how to keep its symlink for one running box, and that a program which opens the port after the last one has closed
it is a new connection. Does not know what the bytes mean.
"""

from __future__ import annotations

import asyncio
import fcntl
import grp
import logging
import os
import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rotator.links.fd import writer
from rotator.links.terminal import MOST_READS, Terminal
from rotator.links.wire import Conversation, LinkError, Wire
from rotator.protocols.session import Session

log = logging.getLogger(__name__)

SERIAL_GROUP = "dialout"
_ORDER = re.compile(
    rb"|[A-Za-z?][A-Za-z\d]?|[A-Za-z]{1,2}[-+.\d]+(?: [A-Za-z]{0,2}[-+.\d]+){0,3}|[PMWpmw](?: [-+.\d]+){1,4}"
)
"""A line that was written to the port while no box was running: a shell makes a file of it then."""
SMALL = 4096
ASIDE = ".was-a-file"
"""The ending of the name under which it is kept."""
LOOK_EVERY_S = 0.25
"""The time between two looks for a program, where the kernel does not say when one opens the terminal."""


class PtyLink:
    """`path`: the symlink to the terminal. `session` makes the protocol's side of a new connection."""

    def __init__(self, wire: Wire, path: Path, session: Callable[[], Session]) -> None:
        self.wire = wire
        self._path = path
        self._session = session
        self._terminal: Terminal | None = None
        self._locked = -1

    async def open(self) -> None:
        """Raises LinkError."""
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            self._lock()
            self._clear_the_place()
            self._make()
        except BlockingIOError as fault:
            self._close_fds()
            raise LinkError(f"{self._path}: another program of this kind has it") from fault
        except OSError as fault:
            self._close_fds()
            why = f"{self._path}: cannot be made a link to a terminal: {fault.strerror}"
            raise LinkError(f"{why}: begin the box in a folder of yours, or write another pty") from fault

    async def run(self) -> None:
        assert self._terminal is not None, "open() comes first"
        if self._terminal.blind:
            log.warning("%s: a program that opens the port at once after another is not noticed: %s",
                        self.wire.name, self._terminal.blind)  # fmt: skip
        begun = b""
        try:
            while True:
                if not begun:
                    await self._program(self._terminal)
                begun = await self._conversation(self._terminal, begun)
                if not self._terminal.clear():
                    self._remove()
                    await self._make_again()
        finally:
            self.close()

    def close(self) -> None:
        """Remove the symlink and the terminal. May be called twice."""
        self._remove()
        self._close_fds()
        self.wire.state = "closed"

    async def _program(self, terminal: Terminal) -> None:
        """Wait until a program opens the terminal."""
        loop = asyncio.get_running_loop()
        while not terminal.wanted:
            if terminal.openings is None:
                await asyncio.sleep(LOOK_EVERY_S)
                continue
            opened = asyncio.Event()
            loop.add_reader(terminal.openings.fd, opened.set)
            try:
                await opened.wait()
            finally:
                loop.remove_reader(terminal.openings.fd)
            terminal.changed_hands()

    async def _conversation(self, terminal: Terminal, begun: bytes) -> bytes:
        """Carry the bytes of the programs that have the terminal open, until the last one closes it.

        `begun`: the first bytes, which have been read already. Returns those of the next conversation.
        """
        loop = asyncio.get_running_loop()
        conversation = Conversation(self._session(), self.wire, writer(terminal.master))
        over: asyncio.Future[bytes] = loop.create_future()

        def look() -> None:
            if over.done():
                return
            data, free = terminal.read()
            changed = terminal.changed_hands()
            if changed and not free:
                more, free = terminal.read(MOST_READS)
                data += more
            if changed and not free:
                # The bytes are the last program's or the next one's. As the next conversation they get their answers.
                over.set_result(data)
                return
            if data:
                conversation.received(data)
            if free:
                conversation.finish()
                over.set_result(b"")

        fds = [terminal.master, *([terminal.openings.fd] if terminal.openings else [])]
        for fd in fds:
            loop.add_reader(fd, look)
        try:
            if begun:
                conversation.received(begun)
            return await over
        finally:
            for fd in fds:
                loop.remove_reader(fd)
            conversation.close()

    def _clear_the_place(self) -> None:
        """Move a file of orders away from the port's place. Raises LinkError where something else is, and OSError."""
        if self._path.is_symlink() or not self._path.exists():
            return
        kind = "folder" if self._path.is_dir() else "file" if self._path.is_file() else "device"
        if kind != "file" or self._path.stat().st_size > SMALL or not _are_orders(self._path.read_bytes()):
            advice = 'for a real port write serial = "..."' if kind == "device" else "move it, or name another path"
            self._close_fds()
            raise LinkError(f"{self._path}: there is a {kind} already, where pty makes a port: {advice}")
        aside = self._path.with_name(self._path.name + ASIDE)
        self._path.replace(aside)
        log.warning("%s: %s was a plain file with orders, written while no box was running; it is now %s",
                    self.wire.name, self._path, aside)  # fmt: skip

    async def _make_again(self) -> None:
        """As `_make`, as soon as the system lets it: for a moment it may have no file or terminal left."""
        told = False
        while True:
            try:
                return self._make()
            except OSError as fault:
                self._remove()
                if not told:
                    log.warning("%s: %s has to wait: %s", self.wire.name, self._path, fault.strerror)
                told = True
                self.wire.state = "waiting"
                await asyncio.sleep(LOOK_EVERY_S)

    def _make(self) -> None:
        """A terminal, and the symlink to it. Raises OSError."""
        self._terminal = Terminal()
        if self._path.is_symlink():
            self._path.unlink()
        self._path.symlink_to(self._terminal.name)
        with suppress(KeyError, OSError):
            # The group of serial ports may open the terminal, because the client programs run as other users.
            os.chown(self._terminal.name, -1, grp.getgrnam(SERIAL_GROUP).gr_gid)
            os.chmod(self._terminal.name, 0o660)
        self.wire.state = "ready"

    def _remove(self) -> None:
        """Close the terminal; remove the symlink if it still leads there."""
        if self._terminal is None:
            return
        with suppress(OSError):  # the folder may be gone; the terminal is closed in any case
            if self._path.is_symlink() and os.readlink(self._path) == self._terminal.name:
                self._path.unlink()
        self._terminal.close()
        self._terminal = None

    def _lock(self) -> None:
        """Take the lock for the symlink's path. Raises BlockingIOError when a running program has the lock.

        A symlink without a lock is left over from a program that died, and may be replaced.
        """
        self._locked = os.open(
            self._path.with_name(f".{self._path.name}.lock"), os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600
        )
        fcntl.flock(self._locked, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _close_fds(self) -> None:
        if self._terminal is not None:
            self._terminal.close()
            self._terminal = None
        if self._locked >= 0:
            os.close(self._locked)
            self._locked = -1


def _are_orders(data: bytes) -> bool:
    return all(_ORDER.fullmatch(row) for row in re.split(rb"[\r\n]+", data))
