"""`rotator run`: the box in the foreground, with a live picture in a terminal or plain lines elsewhere.

Knows signals, keys and where output goes. What the picture shows is the view's; what the box does is the app's.
"""

from __future__ import annotations

import asyncio
import logging
import signal
import sys
import termios
import tty
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.live import Live

from rotator import __version__
from rotator.app import App
from rotator.cli.faults import parse_faults
from rotator.config.load import load
from rotator.orders import Release, Stop
from rotator.views import terminal

PICTURE_HZ = 5
LOG_ROWS = 6


def run_box(path: Path | None, faults: tuple[str, ...], *, plain: bool) -> None:
    config = load(path)
    console = Console()
    recent: deque[str] = deque(maxlen=LOG_ROWS)
    _log_to(None if plain else recent)
    app = App(config, path)
    plan = parse_faults(faults, app.station.world)
    asyncio.run(_run(app, plan, console, recent, plain=plain))


async def _run(app: App, plan: list[tuple[float, str]], console: Console, recent: deque[str], *, plain: bool) -> None:
    stop = asyncio.Event()
    events = asyncio.get_running_loop()
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        events.add_signal_handler(signum, stop.set)
    for at_s, name in plan:
        assert app.station.world is not None
        events.call_later(at_s, app.station.world.inject, name)
    watcher = asyncio.create_task(_plain(app, console) if plain else _picture(app, console, recent, stop))
    try:
        await app.run(stop)
    finally:
        watcher.cancel()
        await asyncio.gather(watcher, return_exceptions=True)


async def _plain(app: App, console: Console) -> None:
    await asyncio.sleep(0.1)
    for row in terminal.greeting(__version__, app.config.rotor.hardware, [link.wire for link in app.links]):
        print(row, flush=True)  # noqa: T201 - this is the output
    last = ""
    while True:
        row = terminal.line(app.loop.status)
        if row != last:
            print(row, flush=True)  # noqa: T201
            last = row
        await asyncio.sleep(1.0)


async def _picture(app: App, console: Console, recent: deque[str], stop: asyncio.Event) -> None:
    def key(byte: str) -> None:
        match byte:
            case " ":
                app.console.order(Stop(latch=True))
            case "r":
                app.console.order(Release())
            case "q" | "\x03":
                stop.set()

    wires = [link.wire for link in app.links]
    with _keys(key), Live(console=console, auto_refresh=False, screen=False) as live:
        while True:
            picture = terminal.picture(__version__, app.loop.status, app.lcd_glass(), wires, list(recent))
            live.update(picture, refresh=True)
            await asyncio.sleep(1 / PICTURE_HZ)


@contextmanager
def _keys(handle: terminal.KeyHandler) -> Iterator[None]:
    """Single keys from the terminal, where input is one."""
    if not sys.stdin.isatty():
        yield
        return
    fd = sys.stdin.fileno()
    before = termios.tcgetattr(fd)
    tty.setcbreak(fd)
    events = asyncio.get_running_loop()
    events.add_reader(fd, lambda: handle(sys.stdin.read(1)))
    try:
        yield
    finally:
        events.remove_reader(fd)
        termios.tcsetattr(fd, termios.TCSADRAIN, before)


class _Recent(logging.Handler):
    def __init__(self, rows: deque[str]) -> None:
        super().__init__()
        self._rows = rows

    def emit(self, record: logging.LogRecord) -> None:
        self._rows.append(self.format(record).splitlines()[0])


def _log_to(rows: deque[str] | None) -> None:
    """Log into the picture, or to standard error where there is none."""
    handler: logging.Handler = logging.StreamHandler(sys.stderr) if rows is None else _Recent(rows)
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname).1s %(message)s", "%H:%M:%S"))
    logging.basicConfig(level=logging.INFO, handlers=[handler])
    logging.captureWarnings(True)
