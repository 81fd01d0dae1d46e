"""The two screens of `rotator calibrate`: plain lines, and a live picture with single keys.

Knows the terminal and standard input. What is asked and shown, the guides of `rotator.calibrating` say.
"""

from __future__ import annotations

import asyncio
import os
import sys
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from functools import partial

from rich.console import Console, Group, RenderableType
from rich.text import Text

from rotator.calibrating.rig import Rig
from rotator.calibrating.session import TypedAhead
from rotator.cli import lines
from rotator.cli.screen import draw


class PlainLines:
    """Lines out, and lines of standard input in."""

    def __init__(self) -> None:
        self.typed = TypedAhead()
        self._console = Console(highlight=False, soft_wrap=True)
        self._reads = False

    def show(self, *said: str) -> None:
        for line in said:
            self._console.print(wrapped(line, self._console), markup=False)

    def ask(self, prompt: str) -> None:
        self.show(f"> {prompt}" if prompt else "")

    @asynccontextmanager
    async def open(self, rig: Rig) -> AsyncIterator[None]:
        if not self._reads:
            self._reads = True
            events = asyncio.get_running_loop()
            threading.Thread(target=_read_lines, args=(self.typed, events), daemon=True).start()
        yield


class LivePicture(PlainLines):
    """A terminal: single keys, and the state of the rig below the lines.

    A key that is held makes the guide say the same thirty times a second: it is shown once, and counted.
    """

    def __init__(self) -> None:
        super().__init__()
        self._shown: tuple[str, ...] = ()
        self._times = 1

    def show(self, *said: str) -> None:
        if said == self._shown:
            self._times += 1
            return
        if self._times > 1:
            self._console.print(self._count, style="dim", markup=False)
        super().show(*said)
        self._shown, self._times = said, 1

    def ask(self, prompt: str) -> None:
        """The picture shows the prompt all the time."""

    @asynccontextmanager
    async def open(self, rig: Rig) -> AsyncIterator[None]:
        drawing = asyncio.create_task(draw(partial(self._picture, rig), self.typed.key, self._console))
        try:
            yield
        finally:
            drawing.cancel()
            await asyncio.gather(drawing, return_exceptions=True)
            # The last picture stays, with its count.
            self._shown, self._times = (), 1

    @property
    def _count(self) -> str:
        return f"  ({self._times} times)"

    def _picture(self, rig: Rig) -> RenderableType:
        state, turns = rig.picture()
        count = [Text(self._count, style="dim")] if self._times > 1 else []
        return Group(
            *count,
            Text(wrapped(state, self._console), style="green" if turns else "dim"),
            Text(wrapped(f"> {rig.guide.prompt} {self.typed.keyboard.typed}", self._console), style="bold"),
        )


def wrapped(line: str, console: Console) -> str:
    """Broken between words where a terminal is narrower. The rows below the first have its indent."""
    return lines.wrapped(line, console.width, len(line) - len(line.lstrip())) if console.is_terminal else line


def _read_lines(typed: TypedAhead, events: asyncio.AbstractEventLoop) -> None:
    """Read standard input in a thread of its own: files, pipes and terminals are read alike."""
    rest = b""
    while chunk := os.read(sys.stdin.fileno(), 4096):
        *lines, rest = (rest + chunk).split(b"\n")
        for line in lines:
            _hand_over(events, typed, line.decode("utf-8", "replace"))
    if rest:
        _hand_over(events, typed, rest.decode("utf-8", "replace"))
    _hand_over(events, typed, None)


def _hand_over(events: asyncio.AbstractEventLoop, typed: TypedAhead, line: str | None) -> None:
    # After the end of the event loop no guide waits for the line.
    with suppress(RuntimeError):
        events.call_soon_threadsafe(typed.line, line)
