"""`rotator calibrate`: a person at the keys, or lines on standard input, and the guide that leads through it.

Knows keys, lines and printing. What is asked and what is believed is the guide's; the rotor runs on the bench.
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

from firmware_sim.rotors.rotor import SimRotor
from hw.ports import Axis
from rotator.app import open_station
from rotator.assembly.station import Station
from rotator.calibrating.answers import Answer, Halt, Keyboard, Quit, from_line
from rotator.calibrating.compass import learnt_path
from rotator.calibrating.north import Placed
from rotator.calibrating.rig import Bench, NorthBench, Sat, Saved, as_toml, keep
from rotator.calibrating.walk import Walk
from rotator.cli.faults import parse_faults
from rotator.cli.reach import monitor_places, reach
from rotator.cli.screen import draw, log_to, stop_on_signals
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.links.console import console_path
from rotator.links.wire import LinkError
from rotator.runtime.engine import Engine

POLL_S = 0.02
NORTH = "north"


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

    def next(self, guide: Walk) -> Answer | None:
        if not self._ahead or not (self._by_key or guide.ready(self._ahead[0])):
            return None
        return self._ahead.popleft()


def calibrate_axes(path: Path | None, faults: tuple[str, ...], what: str | None, *, plain: bool) -> int:
    """`what`: an axis, `north`, or None for both axes. The exit code: 0 when all that was asked for has been done."""
    config = load(path)
    if config.rotor.hardware != "sim":
        _alone(path)
    sitting = Sitting(config, path, faults, plain=plain)
    return asyncio.run(sitting.run([axis.value for axis in Axis] if what is None else [what]))


class Sitting:
    """One after the other, what is to be set up; each with the hardware opened anew."""

    def __init__(self, config: Config, path: Path | None, faults: tuple[str, ...], *, plain: bool) -> None:
        self._config = config
        self._path = path
        self._faults = faults
        self._plain = plain
        self._console = Console(highlight=False, soft_wrap=True)
        self._typed = Typed()

    async def run(self, tasks: list[str]) -> int:
        stop = stop_on_signals()
        log_to(logging.StreamHandler())
        # The guide says what there is to say of faults, in its place; log lines in between would only confuse.
        logging.getLogger().setLevel(logging.CRITICAL)
        if self._config.rotor.hardware == "sim":
            self._say("SIMULATED rotor: nothing real turns.")
        for at, what in enumerate(tasks):
            station = open_station(self._config)
            try:
                self._plan_faults(station.world)
                if self._plain and at == 0:
                    events = asyncio.get_running_loop()
                    threading.Thread(target=_read_lines, args=(self._typed, events), daemon=True).start()
                done = await self._set_up(what, station, stop)
            finally:
                await asyncio.to_thread(station.close)
            if done is None or not await self._keep(done):
                return 1
        return 0

    def _plan_faults(self, world: SimRotor | None) -> None:
        for at_s, name in parse_faults(self._faults, world):
            assert world is not None, "faults are for the simulator"
            asyncio.get_running_loop().call_later(at_s, world.inject, name)

    def _sat(self, what: str, station: Station) -> Sat:
        if what == NORTH:
            return NorthBench(self._config, station, time.monotonic, time.sleep, kept=learnt_path(self._config))
        return Bench(self._config, Axis(what), station, time.monotonic)

    async def _set_up(self, what: str, station: Station, stop: asyncio.Event) -> Saved | Placed | None:
        bench = self._sat(what, station)
        engine = Engine(bench.loop, station.rotor)
        drawing: asyncio.Task[None] | None = None
        if not self._plain:
            picture = partial(_picture, bench, self._typed)
            drawing = asyncio.create_task(draw(picture, self._typed.key, self._console))
        try:
            ended = engine.start()
            bench.start()
            asked = ""
            while not (bench.guide.ended or stop.is_set() or ended.done()):
                for line in bench.step(self._typed.next(bench.guide)):
                    self._say(line)
                if self._plain and bench.guide.prompt != asked:
                    asked = bench.guide.prompt
                    self._say(f"> {asked}" if asked else "")
                await asyncio.sleep(POLL_S)
        finally:
            await asyncio.to_thread(bench.stop)
            failure = await engine.halt()
            if drawing:
                drawing.cancel()
                await asyncio.gather(drawing, return_exceptions=True)
        if failure is not None:
            raise failure
        if not bench.guide.ended:
            self._say(f"Stopped: the motors stand, nothing of the {what} is saved.")
        return bench.result

    async def _keep(self, done: Saved | Placed) -> bool:
        if isinstance(done, Placed):
            return True
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


def _alone(path: Path | None) -> None:
    """Relays have one owner, a serial port or an I2C chip any number. Raises LinkError where the box is running."""
    try:
        box = reach([console_path(each) for each in monitor_places(path)], "console")
    except LinkError:
        return
    box.close()
    raise LinkError("the box is running, and two programs cannot have the motors: end it (sudo systemctl stop rotator)")


def _picture(bench: Sat, typed: Typed) -> RenderableType:
    shown, turns = bench.picture()
    return Group(
        Text(shown, style="green" if turns else "dim"),
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
