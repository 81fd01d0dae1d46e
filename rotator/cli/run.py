"""`rotator run`: the box in the foreground, with a live picture in a terminal, or plain lines elsewhere.

Starts the faults of --fault, and the box anew where the page wants that. `rotator.cli.run_keys` knows the keys,
`rotator.views` draws the picture; `rotator.box` is the box.
"""

from __future__ import annotations

import asyncio
import itertools
import logging
import os
import shutil
import sys
import time
from collections.abc import Callable
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, TextIO, cast

from rotator import __version__
from rotator.box.app import App
from rotator.cli.anew import restored, start_anew, text_of
from rotator.cli.announced import announced, boxes
from rotator.cli.commands import draws
from rotator.cli.failed import CommandFailed
from rotator.cli.faults import chosen_faults
from rotator.cli.lines import in_front, wrapped
from rotator.cli.output import LINES, PICTURES, Output
from rotator.cli.reach import connected
from rotator.cli.run_keys import NEXT, RunKeys
from rotator.cli.screen import LOOK_S, LogRows, draw, has_ascii_only, keys_to, log_to, print_lines, terminal_console
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.places import console_path, monitor_path, runtime_folder
from rotator.runtime.anew import Anew
from rotator.runtime.memory import use_one_heap
from rotator.runtime.open_files import allow_enough
from rotator.runtime.signals import SignalThread
from rotator.views import plain_lines
from rotator.views.words import KEYS

if TYPE_CHECKING:
    from rich.console import RenderableType

PAGE_LOOKS = 30
"""The greeting waits so many looks for a page that does not listen yet."""


def run_box(
    path: Path | None, faults: tuple[str, ...], *, plain: bool, errand: Callable[[], str] | None = None
) -> None:
    """Raises CommandFailed where a box runs already with these sockets.

    `errand`: done once the box runs, in a thread; the box ends with it, and its sentence is the last one.
    """
    plain = plain or not draws()
    chosen = chosen_faults(path, faults)
    use_one_heap()
    allow_enough()
    anew = Anew()
    anew.file = path
    restored(path)
    good = text_of(path)
    app = _app(anew)
    recent = LogRows()
    screen, errors = Output(sys.stdout, LINES if plain else PICTURES), Output(sys.stderr)
    # Before a thread of the app can log above the picture.
    log_to(logging.StreamHandler(cast(TextIO, errors)) if plain else recent)
    try:

        def run(app: App) -> None:
            with nullcontext() if runtime_folder(os.environ) else announced(_monitor(app.config), anew.file):
                asyncio.run(run_app(app, chosen, screen, None if plain else recent, anew, errand=errand))
            # The faults of the command line have begun, and a person has seen them.
            chosen.clear()

        run(app)
        start_anew(path, anew, lambda: _app(anew), run, good)
    finally:
        screen.close()
        errors.close()


def _app(anew: Anew) -> App:
    config = load(anew.file)
    make_sure_of(_monitor(config), anew.file)
    return App(config, anew.file, anew=anew)


def _monitor(config: Config) -> Path:
    return monitor_path(config.state.path, config.monitor.path, os.environ)


def make_sure_of(monitor: Path, path: Path | None) -> None:
    """That no box runs with these sockets, or with this file: it drives the same rotor. Raises CommandFailed."""
    file = path.resolve() if path else None
    same = [box for box in boxes() if box.monitor == monitor.absolute() or (file is not None and box.config == file)]
    names = {monitor: "a box"} | {box.monitor: box.named for box in same}
    for place, name in reversed(names.items()):
        if (other := connected(console_path(place))) is not None:
            other.close()
            running = name
            break
    else:
        return
    raise CommandFailed(
        f"{running} runs already. `rotator where` shows what it does, `rotator stop` stops its antenna; Ctrl-C in its "
        "terminal ends it. A second box needs a folder of its own, or a [state] path of its own in its file"
    )


async def run_app(
    app: App,
    faults: list[tuple[float, str]],
    screen: Output,
    recent: LogRows | None,
    anew: Anew,
    *,
    errand: Callable[[], str] | None = None,
) -> None:
    """Run until a signal or a key ends it, or until the page wants it to start anew.

    `faults`: seconds after the start, and the simulator's name of each. `recent`: the log rows of the picture; None:
    print plain lines.
    """
    stop, events = asyncio.Event(), asyncio.get_running_loop()

    def ended() -> None:
        app.loop.stop()  # at once, for the event loop may be stuck
        with suppress(RuntimeError):  # the event loop has ended already
            events.call_soon_threadsafe(stop.set)

    def ended_by_signal() -> None:
        anew.forget()
        ended()

    anew.on_asked = ended
    for at_s, name in faults:
        assert app.station.world is not None, "faults are for the simulator"
        events.call_later(at_s, app.station.world.inject, name)
    work = asyncio.create_task(_errand(app, errand, stop)) if errand else None
    watcher = asyncio.create_task(_plain(app, stop, screen) if recent is None else _picture(app, stop, screen, recent))
    try:
        with SignalThread(ended_by_signal):
            await app.run(stop)
    finally:
        watcher.cancel()
        await asyncio.gather(watcher, return_exceptions=True)
    # Below the terminal as it was before the picture.
    last = "The page starts the box anew." if anew.asked else plain_lines.farewell(app.loop.status)
    for text in (last, *([await work] if work else [])):
        screen.write(f"{wrapped(text, shutil.get_terminal_size().columns, 0) if screen.isatty() else text}\n")


async def _errand(app: App, errand: Callable[[], str], stop: asyncio.Event) -> str:
    try:
        while not app.is_ready:
            await asyncio.sleep(LOOK_S)
        await asyncio.sleep(LOOK_S)  # its console listens a moment later
        return await asyncio.to_thread(errand)
    finally:
        stop.set()


async def _plain(app: App, stop: asyncio.Event, screen: Output) -> None:
    """Lines, and at a terminal the same keys as in the picture."""
    wires = app.wires
    keys = RunKeys(app.console, app.typed)
    printed = ""

    def greeting() -> list[str]:
        lines = plain_lines.greeting(__version__, app.config.rotor.hardware, wires)
        return [*lines, "  keys: " + ", ".join(KEYS).replace("   ", ", ")] if in_front(sys.stdin) else lines

    def key(pressed: str) -> None:
        nonlocal printed
        if keys.key(pressed):
            stop.set()
        elif keys.line != printed and not keys.line.endswith(NEXT):
            printed = keys.line
            if printed:
                screen.write(f"{printed}\n")

    looks = itertools.count(1)

    def ready() -> bool:
        """The page begins a moment after the links. Where it cannot listen, the greeting says so in the end."""
        return app.is_ready and (all(wire.state != "closed" for wire in wires) or next(looks) >= PAGE_LOOKS)

    with keys_to(key):
        await print_lines(greeting, lambda: plain_lines.line(app.loop.status), screen, ready)


async def _picture(app: App, stop: asyncio.Event, screen: Output, recent: LogRows) -> None:
    from rotator.views import terminal  # noqa: PLC0415 - plain lines do without rich
    from rotator.views.sky_plot import Trail  # noqa: PLC0415 - plain lines do without it

    wires = app.wires
    keys, trail, plain = RunKeys(app.console, app.typed), Trail(), has_ascii_only(screen)

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
