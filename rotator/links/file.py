"""A file that another program writes again and again: its content after each change is a message.

Knows how to read a file that may be missing, or on a network share that does not answer. Does not know the content's
form: the protocol ignores a half-written one. It compares contents, not times of change: those are coarse on a memory
card, and on a network share they come from another machine's clock.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from functools import partial
from pathlib import Path

from rotator.links.wire import Conversation, Waiting, Wire
from rotator.protocols.session import Session
from rotator.runtime.own_thread import aside

log = logging.getLogger(__name__)

LOOK_EVERY_S = 0.5
"""The time between two reads of the file, in seconds."""
MOST_BYTES = 4096


@dataclass(eq=False)
class FileLink(Waiting):
    """`session` makes the protocol's side of the link. `look_every_s`: the time between two reads, in seconds."""

    wire: Wire
    path: Path
    session: Callable[[], Session]
    _: KW_ONLY
    look_every_s: float = LOOK_EVERY_S
    _trouble: str | None = field(default=None, init=False)

    async def run(self) -> None:
        conversation = Conversation(self.session(), self.wire, lambda _reply: None)
        before: bytes | str | None = None
        try:
            while True:
                # In a thread of its own, because a read from a lost network share may never return.
                now = await aside(partial(_content, self.path), self.wire.name)
                if now != before:
                    before = now
                    self._tell("" if isinstance(now, bytes) else now)
                    if isinstance(now, bytes):
                        conversation.received(now)
                await asyncio.sleep(self.look_every_s)
        finally:
            conversation.close()
            self.wire.state = "closed"

    def _tell(self, trouble: str) -> None:
        """Log a trouble once when it begins, and its end once. `trouble` empty: the file can be read."""
        self.wire.state = "waiting for it" if trouble else "open"
        if trouble == self._trouble:
            return
        self._trouble = trouble
        if trouble:
            log.warning("%s: %s cannot be used: %s; waiting for it", self.wire.name, self.path, trouble)
        else:
            log.info("%s: %s is there", self.wire.name, self.path)


def _content(path: Path) -> bytes | str:
    """The file's content as bytes; or, as text, the reason why it cannot be used."""
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
    except OSError as fault:
        return fault.strerror or str(fault)
    return data if len(data) <= MOST_BYTES else f"it is longer than {MOST_BYTES} bytes"
