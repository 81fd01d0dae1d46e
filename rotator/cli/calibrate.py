"""`rotator calibrate`: a person at the keys, or lines on standard input, and the guide that sets an axis up.

Knows keys, lines and printing. What is asked and what is believed is the guide's; the axis runs on the bench.
"""

from __future__ import annotations

import asyncio
import logging
import os
import sys
import threading
import time
from collections import deque
from contextlib import suppress
from functools import partial
from pathlib import Path

from rich.console import Console, Group, RenderableType
from rich.text import Text

from hw.ports import Axis
from rotator.calibrating.answers import Answer, Halt, Keyboard, Quit, from_line
from rotator.calibrating.guide import Commissioned
from rotator.cli.faults import parse_faults
from rotator.cli.screen import draw, log_to, stop_on_signals
from rotator.commissioning import Bench, as_toml, keep
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.engine import Engine
from rotator.station import Station

POLL_S = 0.02


class Typed:
    """Answers on their way from the keyboard, or from standard input, to the guide."""

    def __init__(self) -> None:
        self.keyboard = Keyboard()
        self._ahead: deque[Answer] = deque()
        self._by_key = False

    def key(self, pressed: str) -> None:
        """A key means now: what was pressed while nobody could take it is not done later."""
        self._by_key = True
        answer = self.keyboard.key(pressed)
        if answer is not None:
            self._ahead.append(answer)

    def line(self, text: str | None) -> None:
        """A line waits for its turn, but for `s`: it stops at once, and what was typed ahead is forgotten."""
        answer = Quit() if text is None else from_line(text)
        if isinstance(answer, Halt):
            self._ahead.clear()
        self._ahead.append(answer)

    def next(self, bench: Bench) -> Answer | None:
        if not self._ahead or not (self._by_key or bench.guide.ready(self._ahead[0])):
            return None
        return self._ahead.popleft()


def calibrate_axes(path: Path | None, faults: tuple[str, ...], axis: str | None, *, plain: bool) -> int:
    """The exit code: 0 when every axis asked for has been set up."""
    config = load(path)
    axes = list(Axis) if axis is None else [Axis(axis)]
    station = Station(config, time.monotonic, time.sleep)
    try:
        sitting = Sitting(config, path, station, parse_faults(faults, station.world), plain=plain)
        return asyncio.run(sitting.run(axes))
    finally:
        station.close()


class Sitting:
    """One after the other, the axes that are to be set up."""

    def __init__(
        self, config: Config, path: Path | None, station: Station, faults: list[tuple[float, str]], *, plain: bool
    ) -> None:
        self._config = config
        self._path = path
        self._station = station
        self._faults = faults
        self._plain = plain
        self._console = Console(highlight=False, soft_wrap=True)
        self._typed = Typed()

    async def run(self, axes: list[Axis]) -> int:
        stop = stop_on_signals()
        log_to(logging.StreamHandler())
        # The guide says what there is to say of faults, in its place; log lines in between would only confuse.
        logging.getLogger().setLevel(logging.CRITICAL)
        events = asyncio.get_running_loop()
        for at_s, name in self._faults:
            assert self._station.world is not None, "faults are for the simulator"
            events.call_later(at_s, self._station.world.inject, name)
        if self._plain:
            threading.Thread(target=_read_lines, args=(self._typed, events), daemon=True).start()
        if self._config.rotor.hardware == "sim":
            self._say("SIMULATED rotor: nothing real turns.")
        for axis in axes:
            done = await self._set_up(axis, stop)
            if done is None or not await self._keep(done):
                return 1
        return 0

    async def _set_up(self, axis: Axis, stop: asyncio.Event) -> Commissioned | None:
        bench = Bench(self._config, axis, self._station, time.monotonic)
        engine = Engine(bench.loop, self._station.rotor)
        drawing: asyncio.Task[None] | None = None
        if not self._plain:
            picture = partial(_picture, bench, self._typed)
            drawing = asyncio.create_task(draw(picture, self._typed.key, self._console))
        try:
            ended = engine.start()
            asked = ""
            while not (bench.guide.ended or stop.is_set() or ended.done()):
                for line in bench.step(self._typed.next(bench)):
                    self._say(line)
                if self._plain and bench.guide.prompt != asked:
                    asked = bench.guide.prompt
                    self._say(f"> {asked}" if asked else "")
                await asyncio.sleep(POLL_S)
        finally:
            failure = await engine.halt()
            if drawing:
                drawing.cancel()
                await asyncio.gather(drawing, return_exceptions=True)
        if failure is not None:
            raise failure
        if not bench.guide.ended:
            self._say(f"Stopped: every relay is off, nothing of the {axis.value} is saved.")
        return bench.guide.result

    async def _keep(self, done: Commissioned) -> bool:
        if self._path is None:
            self._say("No --config, so nothing is saved. In a file it would be:\n\n" + as_toml(done))
            return True
        try:
            await asyncio.to_thread(keep, done, self._path)
        except (OSError, ConfigError) as fault:
            self._say(f"It cannot be saved: {fault}. In the file it would be:\n\n{as_toml(done)}")
            return False
        self._say(f"Saved in {self._path}; the file before is {self._path.name}.bak.")
        return True

    def _say(self, text: str) -> None:
        self._console.print(text, markup=False)


def _picture(bench: Bench, typed: Typed) -> RenderableType:
    axis = bench.loop.status.axis(bench.guide.known.axis)
    reading = "----" if axis.raw is None else f"{axis.raw:.4f} ({axis.raw * bench.guide.known.supply_v:.3f} V)"
    way = "" if not axis.drive else "  " + bench.guide.way(axis.drive)
    return Group(
        Text(f"reading {reading}{way}", style="green" if axis.drive else "dim"),
        Text(f"> {bench.guide.prompt} {typed.keyboard.typed}", style="bold"),
    )


def _read_lines(typed: Typed, events: asyncio.AbstractEventLoop) -> None:
    """Lines of standard input, in a thread of their own: files, pipes and terminals are read alike."""
    rest = b""
    while chunk := os.read(sys.stdin.fileno(), 4096):
        *lines, rest = (rest + chunk).split(b"\n")
        for line in lines:
            _hand_over(events, typed, line.decode("utf-8", "replace"))
    if rest:
        _hand_over(events, typed, rest.decode("utf-8", "replace"))
    _hand_over(events, typed, None)


def _hand_over(events: asyncio.AbstractEventLoop, typed: Typed, line: str | None) -> None:
    # The event loop may have gone already: then nobody waits for the line.
    with suppress(RuntimeError):
        events.call_soon_threadsafe(typed.line, line)
