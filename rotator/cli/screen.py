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
from contextlib import contextmanager
from typing import IO, cast

from rich.console import Console, RenderableType
from rich.live import Live

from rotator.cli.output import Output

PICTURE_HZ = 5
LOG_ROWS = 6


class LogRows(logging.Handler):
    """The latest log lines, for the picture."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: deque[str] = deque(maxlen=LOG_ROWS)

    def emit(self, record: logging.LogRecord) -> None:
        self.rows.append(self.format(record).splitlines()[0])


def log_to(handler: logging.Handler) -> None:
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname).1s %(message)s", "%H:%M:%S"))
    logging.basicConfig(level=logging.INFO, handlers=[handler])


def stop_on_signals() -> asyncio.Event:
    """An event that Ctrl-C, SIGTERM and a closed terminal set."""
    stop = asyncio.Event()
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        asyncio.get_running_loop().add_signal_handler(signum, stop.set)
    return stop


def terminal_console(output: Output) -> Console:
    """A console for `draw` whose terminal may stop reading."""
    return Console(file=cast(IO[str], output))


async def draw(render: Callable[[], RenderableType], key: Callable[[str], None], console: Console) -> None:
    """Draw until cancelled, and pass single keys to `key`. Text printed on `console` stays above the picture."""
    with _keys(key), Live(console=console, auto_refresh=False) as live:
        while True:
            live.update(render(), refresh=True)
            await asyncio.sleep(1 / PICTURE_HZ)


async def print_lines(greeting: Callable[[], list[str]], line: Callable[[], str], output: Output) -> None:
    """For output that is no terminal: print a greeting, then each line that differs from the one before."""
    # After this pause the links are open, and the greeting can name their ports.
    await asyncio.sleep(0.1)
    last = ""
    output.write("\n".join((*greeting(), "")))
    while True:
        now = line()
        if now != last:
            output.write(f"{now}\n")
            last = now
        await asyncio.sleep(1.0)


@contextmanager
def _keys(handle: Callable[[str], None]) -> Iterator[None]:
    if not sys.stdin.isatty():
        yield
        return
    fd = sys.stdin.fileno()
    before = termios.tcgetattr(fd)
    tty.setcbreak(fd)
    events = asyncio.get_running_loop()
    events.add_reader(fd, lambda: handle(os.read(fd, 1).decode("latin-1")))
    try:
        yield
    finally:
        events.remove_reader(fd)
        # Not after the last output (TCSADRAIN): after Ctrl-S that would be never.
        termios.tcsetattr(fd, termios.TCSANOW, before)
