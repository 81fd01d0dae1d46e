"""One calibration session: the axes, or north, one after the other. Each opens the hardware again.

Knows how a rig is started, stepped and stopped, that its result is saved, and when what was typed ahead is given to the
guide. Does not know the terminal: lines go to `show`.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import AbstractAsyncContextManager
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Protocol

from hw.ports import Axis
from rotator.assembly.kept_files import build_state
from rotator.assembly.station import Station
from rotator.calibrating.entries import Entry, Keyboard, StopNow, Word, from_line
from rotator.calibrating.guide import Guide
from rotator.calibrating.results import AngleConfirmed, Result, as_toml, save, saved_in
from rotator.calibrating.rig import AxisRig, FieldRig, NorthRig, Rig
from rotator.calibrating.sky_rig import SkyRig, receiver_at
from rotator.calibrating.sky_table import Residuals
from rotator.calibrating.stops import UNREACHED, Stops
from rotator.config.load import ConfigError
from rotator.config.model import Config
from rotator.exchange.status import Latch
from rotator.orbits.sight import Target
from rotator.runtime.engine import Engine
from rotator.store.latch import KeptLatch


class TypedAhead:
    """Entries on their way to the guide: keys act at once, lines wait for their question."""

    def __init__(self) -> None:
        self.keyboard = Keyboard()
        self._waiting: deque[Entry] = deque()
        self._by_key = False

    def key(self, pressed: str) -> None:
        """A key acts at once: a press that no question could take is not carried out later."""
        self._by_key = True
        entry = self.keyboard.key(pressed)
        if entry is not None:
            self._waiting.append(entry)

    def line(self, text: str | None) -> None:
        """A line waits for its question. `s` stops at once and clears the waiting lines. None: the input has ended."""
        entry = Word.QUIT if text is None else from_line(text)
        if isinstance(entry, StopNow):
            self._waiting.clear()
        self._waiting.append(entry)

    def next(self, guide: Guide) -> Entry | None:
        """The entry to give to the guide now."""
        if not self._waiting or not (self._by_key or guide.ready(self._waiting[0])):
            return None
        return self._waiting.popleft()


POLL_S = 0.02
COMPASS, NORTH, SKY = "compass", "north", "sky"
SIMULATED = (
    "SIMULATED rotor: nothing real turns. It may stand at a stop: where a question wants the middle of the travel, "
    "first hold the key for clockwise, or up, for some seconds."
)


class Screen(Protocol):
    """Where the operator reads and types."""

    typed: TypedAhead

    def show(self, *lines: str) -> None:
        """What one step of a guide says. The same again right after it, from a key that is held, may be counted."""

    def ask(self, prompt: str) -> None:
        """The open question has changed; empty: none is open."""

    def open(self, rig: Rig) -> AbstractAsyncContextManager[None]:
        """While it is open the state of the rig is drawn, and entries arrive in `typed`."""


@dataclass(eq=False)
class CalibrationSession:
    """`path`: the file that results are saved in; None: they are shown instead. `open_station` raises HardwareError.

    For the task SKY: `target`, `utc`: what the boom is to point at, and the time. `receiver`: the address of the
    rigctld that hears it, `sim`, or None. `draw` gets the points with what is left at each.
    """

    config: Config
    path: Path | None
    screen: Screen
    open_station: Callable[[Config], Station]
    on_open: Callable[[Station], None]
    _: KW_ONLY
    target: Target | None = None
    utc: Callable[[], float] = time.time
    receiver: str | None = None
    draw: Callable[[Residuals], None] = lambda _shown: None

    async def run(self, tasks: Sequence[str], stop: asyncio.Event) -> bool:
        """`tasks`: names of axes, COMPASS, NORTH, SKY. Returns whether every one of them has a result that is saved."""
        if self.config.simulated:
            self.screen.show(SIMULATED)
        for task in tasks:
            station = self.open_station(self.config)
            try:
                self.on_open(station)
                result = await self._calibrate(task, station, stop)
            finally:
                await asyncio.to_thread(station.close)
            if result is None or not await self._save(result):
                return False
        return True

    def _rig(self, task: str, station: Station) -> Rig:
        if task == COMPASS:
            return FieldRig(self.config, station, time.monotonic)
        if task == NORTH:
            # A real chip must never get the corrections of a simulated one.
            corrections = build_state(self.config, self.path) if self.config.keeps_files else None
            return NorthRig(self.config, station, time.monotonic, time.sleep, corrections=corrections)
        if task == SKY:
            assert self.target is not None, "the command names one"
            return self._sky_rig(self.target, station)
        return AxisRig(self.config, Axis(task), station, time.monotonic)

    def _sky_rig(self, target: Target, station: Station) -> SkyRig:
        def source() -> tuple[float, float]:
            sight = target.sight(self.utc())
            return sight.azimuth_deg, sight.elevation_deg

        receiver = None
        if self.receiver is not None:
            receiver = receiver_at(self.receiver, self.config, station, time.monotonic, source)
        return SkyRig(self.config, station, time.monotonic, target, self.utc, receiver=receiver)

    async def _calibrate(self, task: str, station: Station, stop: asyncio.Event) -> Result | None:
        """Run one guide to its end. The motors stand when it returns, and when it raises."""
        rig = self._rig(task, station)
        engine, stops = Engine(rig.loop, station.rotor), Stops(self.config, rig.loop, station)
        async with self.screen.open(rig):
            try:
                ended = engine.start()
                stops.start()
                rig.start()
                asked, told = "", False
                while not (rig.guide.ended or stop.is_set() or ended.done()):
                    if lines := rig.step(self.screen.typed.next(rig.guide)):
                        self.screen.show(*lines)
                    if rig.guide.prompt != asked:
                        asked = rig.guide.prompt
                        self.screen.ask(asked)
                    if stops.unreached and not told:
                        told = True
                        self.screen.show(UNREACHED)
                    await asyncio.sleep(POLL_S)
            finally:
                # The motors first: a compass that hangs takes seconds to stop.
                try:
                    failure = await engine.halt()
                    if (stopped := rig.loop.status.latch) is not None:
                        await asyncio.to_thread(self._keep, stopped)
                finally:
                    try:
                        await stops.end()
                    finally:
                        await asyncio.to_thread(rig.stop)
        if failure is not None:
            raise failure
        if isinstance(rig, SkyRig) and rig.guide.residuals is not None:
            await asyncio.to_thread(self.draw, rig.guide.residuals)
        if not rig.guide.ended:
            self.screen.show(f"Stopped: the motors stand, nothing of the {task} is saved.")
        return rig.guide.result

    def _keep(self, stopped: Latch) -> None:
        """A stop holds for the box that is started next, too."""
        kept = KeptLatch(build_state(self.config, self.path))
        kept.load()
        kept.save(stopped)

    async def _save(self, result: Result) -> bool:
        if isinstance(result, AngleConfirmed):
            return True
        if self.path is None:
            self.screen.show("No --config, so nothing is saved. In a file it would be:\n\n" + as_toml(result))
            return True
        try:
            await asyncio.to_thread(save, result, self.path)
        except (OSError, ConfigError) as fault:
            self.screen.show(f"It cannot be saved: {fault}. In the file it would be:\n\n{as_toml(result)}")
            return False
        self.screen.show(saved_in(self.path))
        return True
