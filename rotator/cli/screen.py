"""What the foreground commands share: signals, single keys, log lines, and a picture drawn a few times a second.

Knows the terminal. The commands supply the picture and the meaning of the keys.
"""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import sys
import termios
import tty
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import IO, TYPE_CHECKING, cast

from rotator.cli.lines import in_front
from rotator.cli.output import Output
from rotator.exchange.spoken import spoken
from rotator.runtime.signals import never_pause
from rotator.views.frame import ascii_only

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

PICTURE_HZ = 5
LOG_ROWS = 40
LOOK_S = 0.1
"""The time between two looks whether the box is ready, in seconds."""


class LogRows(logging.Handler):
    """The latest log lines, for the picture."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: deque[str] = deque(maxlen=LOG_ROWS)

    def emit(self, record: logging.LogRecord) -> None:
        self.rows.append(self.format(record).splitlines()[0])


class SpokenFormatter(logging.Formatter):
    """With the senders' names as a person says them."""

    def format(self, record: logging.LogRecord) -> str:
        return spoken(super().format(record))


def log_to(handler: logging.Handler) -> None:
    handler.setFormatter(SpokenFormatter("%(asctime)s %(levelname).1s %(message)s", "%H:%M:%S"))
    logging.basicConfig(level=logging.INFO, handlers=[handler])


def stop_on_signals() -> asyncio.Event:
    """An event that Ctrl-C, SIGTERM and a closed terminal set. Ctrl-Z does nothing from now on."""
    stop = asyncio.Event()
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        asyncio.get_running_loop().add_signal_handler(signum, stop.set)
    never_pause()
    return stop


def terminal_console(output: Output) -> Console:
    """A console for `draw` whose terminal may stop reading."""
    from rich.console import Console  # noqa: PLC0415 - plain lines do without it

    return Console(file=cast(IO[str], output))


def has_ascii_only(output: Output) -> bool:
    return ascii_only(output.encoding, os.environ.get("TERM", ""))


async def draw(
    render: Callable[[], RenderableType], key: Callable[[str], None], console: Console, *, whole_screen: bool = False
) -> None:
    """Draw until cancelled, and pass single keys to `key`. Text printed on `console` stays above the picture.

    `whole_screen`: the picture fills the terminal, also after a change of its size; at the end the old text is back.
    """
    from rich.live import Live  # noqa: PLC0415 - plain lines do without it

    with keys_to(key), Live(console=console, auto_refresh=False, screen=whole_screen) as live:
        while True:
            live.update(render(), refresh=True)
            await asyncio.sleep(1 / PICTURE_HZ)


async def print_lines(
    greeting: Callable[[], list[str]], line: Callable[[], str], output: Output, ready: Callable[[], bool] = lambda: True
) -> None:
    """For output that is no terminal: print a greeting, then each line that differs from the one before.

    `ready`: whether the links are open, so that the greeting can name their ports.
    """
    await asyncio.sleep(LOOK_S)
    while not ready():
        await asyncio.sleep(LOOK_S)
    last = ""
    output.write("\n".join((*greeting(), "")))
    while True:
        now = line()
        if now != last:
            output.write(f"{now}\n")
            last = now
        await asyncio.sleep(1.0)


@contextmanager
def keys_to(handle: Callable[[str], None]) -> Iterator[None]:
    """While it is open, each key goes to `handle` without Enter. Without a terminal, behind it (`rotator run &`), or
    once it is gone: nothing."""
    if not in_front(sys.stdin):
        yield
        return
    fd = sys.stdin.fileno()
    before = termios.tcgetattr(fd)
    tty.setcbreak(fd)
    events = asyncio.get_running_loop()

    def read() -> None:
        try:
            key = os.read(fd, 1)
        except OSError:
            key = b""
        if key:
            handle(key.decode("latin-1"))
        else:
            # A terminal that is gone would be readable for ever, and cost a whole core. The kernel tells the first
            # program in it alone, and that may have been `make run`: the box ends as it does then.
            events.remove_reader(fd)
            signal.raise_signal(signal.SIGHUP)

    events.add_reader(fd, read)
    try:
        yield
    finally:
        events.remove_reader(fd)
        with suppress(termios.error):  # of a terminal that is gone
            # Not after the last output (TCSADRAIN): after Ctrl-S that would be never.
            termios.tcsetattr(fd, termios.TCSANOW, before)
