"""`rotator run`: the box in the foreground, with a live picture in a terminal, or plain lines elsewhere.

Starts the faults of --fault. `rotator.cli.run_keys` knows the keys, `rotator.views` draws the picture; `rotator.app` is
the box.
"""

from __future__ import annotations

import asyncio
import logging
import os
import shutil
import sys
import textwrap
import time
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import TextIO, cast

from rich.console import RenderableType

from rotator import __version__
from rotator.app import App
from rotator.cli.announced import announced, boxes
from rotator.cli.failed import CommandFailed
from rotator.cli.faults import parse_faults
from rotator.cli.output import LINES, PICTURES, Output
from rotator.cli.reach import connected
from rotator.cli.run_keys import NEXT, RunKeys
from rotator.cli.screen import LogRows, draw, has_ascii_only, keys_to, log_to, print_lines, terminal_console
from rotator.config.load import load
from rotator.config.places import console_path, monitor_path, runtime_folder
from rotator.runtime.signals import SignalThread
from rotator.views import plain_lines, terminal
from rotator.views.sky_plot import Trail


def run_box(path: Path | None, faults: tuple[str, ...], *, plain: bool) -> None:
    """Raises CommandFailed where a box runs already with these sockets."""
    config = load(path)
    monitor = monitor_path(config.state.path, config.monitor.path, os.environ)
    _make_sure_of(monitor)
    app = App(config, path)
    recent = LogRows()
    screen, errors = Output(sys.stdout, LINES if plain else PICTURES), Output(sys.stderr)
    # Before a thread of the app can log above the picture.
    log_to(logging.StreamHandler(cast(TextIO, errors)) if plain else recent)
    try:
        chosen = parse_faults(faults, app.station.world)
        with nullcontext() if runtime_folder(os.environ) else announced(monitor, path):
            asyncio.run(run_app(app, chosen, screen, None if plain else recent))
    finally:
        screen.close()
        errors.close()


def _make_sure_of(monitor: Path) -> None:
    """That no box runs here. Two with one state file and one console would be one too many: `rotator stop` would find
    the other one. Raises CommandFailed.
    """
    if (other := connected(console_path(monitor))) is None:
        return
    other.close()
    running = next((box.named for box in boxes() if box.monitor == monitor.absolute()), "a box")
    raise CommandFailed(
        f"{running} runs already. `rotator where` shows what it does, `rotator stop` stops its antenna; Ctrl-C in its "
        "terminal ends it. A second box needs a folder of its own, or a [state] path of its own in its file"
    )


async def run_app(app: App, faults: list[tuple[float, str]], screen: Output, recent: LogRows | None) -> None:
    """Run until a signal or a key ends it.

    `faults`: seconds after the start, and the simulator's name of each. `recent`: the log rows of the picture; None:
    print plain lines.
    """
    stop, events = asyncio.Event(), asyncio.get_running_loop()

    def ended() -> None:
        app.loop.stop()  # at once, for the event loop may be stuck
        with suppress(RuntimeError):  # the event loop has ended already
            events.call_soon_threadsafe(stop.set)

    for at_s, name in faults:
        assert app.station.world is not None, "faults are for the simulator"
        events.call_later(at_s, app.station.world.inject, name)
    watcher = asyncio.create_task(_plain(app, stop, screen) if recent is None else _picture(app, stop, screen, recent))
    try:
        with SignalThread(ended):
            await app.run(stop)
    finally:
        watcher.cancel()
        await asyncio.gather(watcher, return_exceptions=True)
    # Below the terminal as it was before the picture.
    last = plain_lines.farewell(app.loop.status)
    screen.write("".join(f"{row}\n" for row in (_rows(last) if screen.isatty() else last.split("\n"))))


def _rows(text: str) -> list[str]:
    """Broken between words, for the terminal's width."""
    columns = shutil.get_terminal_size().columns
    return [row for line in text.split("\n") for row in textwrap.wrap(line, columns, break_on_hyphens=False)]


async def _plain(app: App, stop: asyncio.Event, screen: Output) -> None:
    """Lines, and at a terminal the same keys as in the picture."""
    wires = [link.wire for link in app.links]
    keys = RunKeys(app.console)

    def greeting() -> list[str]:
        lines = plain_lines.greeting(__version__, app.config.rotor.hardware, wires)
        return [*lines, "  keys: " + ", ".join(terminal.KEYS).replace("   ", ", ")] if sys.stdin.isatty() else lines

    def key(pressed: str) -> None:
        if keys.key(pressed):
            stop.set()
        elif keys.line and not keys.line.endswith(NEXT):
            screen.write(f"{keys.line}\n")

    with keys_to(key):
        await print_lines(greeting, lambda: plain_lines.line(app.loop.status), screen)


async def _picture(app: App, stop: asyncio.Event, screen: Output, recent: LogRows) -> None:
    wires = [link.wire for link in app.links]
    keys, trail, plain = RunKeys(app.console), Trail(), has_ascii_only(screen)

    def glass() -> tuple[str, ...]:
        """The rows of the display: read from a simulated one. A real one cannot be read, so the rows sent to it."""
        world = app.station.world
        return world.lcd.text() if world and world.lcd else app.lcd_rows(time.monotonic())

    def render() -> RenderableType:
        status = app.loop.status
        trail.note(status)
        around = terminal.Surroundings(app.mount, trail.ways, keys.line, plain)
        return terminal.picture(__version__, status, glass(), wires, list(recent.rows), around=around)

    def key(pressed: str) -> None:
        if keys.key(pressed):
            stop.set()

    await draw(render, key, terminal_console(screen), whole_screen=True)
