"""The whole box in real time: starts its parts, runs until it is stopped, and stops them in a safe order.

Knows the order of start and stop, and which parts end the box when they end. `parts` builds them.
"""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotator.assembly.station import Station, open_station
from rotator.box.parts import build_parts, lcd_rows
from rotator.config.model import Config
from rotator.exchange.orders import Take
from rotator.exchange.spoken import held_by
from rotator.links.wire import LinkError, Wire
from rotator.runtime.anew import Anew
from rotator.runtime.closing import Part, closing
from rotator.runtime.engine import sentinel_fails
from rotator.runtime.open_files import say_it_once
from rotator.runtime.own_thread import dead_threads

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration

log = logging.getLogger(__name__)

RELAY_LINES = "relay-lines"
"""The unit's ExecStopPost reads this file to open the relays of a program that has died."""


class App:
    """The whole box, in real time. Build it, then `await run(stop)` once. Every relay is off when that returns."""

    def __init__(
        self, config: Config, path: Path | None = None, station: Station | None = None, *, anew: Anew | None = None
    ) -> None:
        """`path`: the configuration's file, where calibrations are saved. `anew`: by which the page has the box start
        anew. Raises HardwareError."""
        self.config = config
        self._anew = anew or Anew()
        self.is_ready = False
        """The box has started with all its links."""
        self.station = station or open_station(config)
        self._built = parts = build_parts(config, path, self.station, self._anew)
        self.mount, self.loop, self.links = parts.mount, parts.loop, parts.links
        self.console, self.typed = parts.console, parts.typed
        self._tasks: list[asyncio.Task[Any]] = []
        """The end of one of these is the end of the box."""
        self._side_tasks: list[asyncio.Task[Any]] = []
        """When one of these ends, the box goes on."""

    @property
    def wires(self) -> list[Wire]:
        """The links and the page, as a screen shows them."""
        others = self._built.page, self._built.mqtt
        return [*(link.wire for link in self.links), *(each.wire for each in others if each)]

    def lcd_rows(self, now_s: float) -> tuple[str, str]:
        """The rows of the display."""
        return lcd_rows(self.loop, self._built.pairings, self._built.language, now_s)

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, HardwareError, or the exception that ended the control thread."""
        say_it_once(asyncio.get_running_loop())
        with dead_threads(self.loop.fail):
            await self._run(stop)

    async def _run(self, stop: asyncio.Event) -> None:
        async with closing(self._parts()) as failures:
            motion_ended = await self._start()
            self._tasks.append(asyncio.create_task(stop.wait(), name="stop"))
            self._built.service_manager.ready()
            if self._anew.again:
                self._built.service_manager.resumed()
            self.is_ready = True
            if not self.config.link:
                log.warning("the file has no [[link]], so no program can connect: `rotator config` prints two to copy")
            await asyncio.wait([motion_ended, *self._tasks], return_when=asyncio.FIRST_COMPLETED)
            if motion_ended.done() and (failure := motion_ended.result()):
                failures.note("the control thread", failure)
            for task in self._tasks:
                if task.done() and isinstance(ended_by := task.exception(), Exception):
                    failures.note(task.get_name(), ended_by)

    def _parts(self) -> list[Part]:
        """The parts that must be stopped, in the order of stopping.

        Motion ends first: the engine opens the relays, and then their guard ends. Parts that may hang or fail come
        later. The station dismisses the sentinel once all lines are off.
        """
        built = self._built
        threads = {
            "the page": built.page,
            "MQTT": built.mqtt,
            "the panel": built.panel,
            "the display": built.display,
            "the tracker": built.tracking,
            "fetching elements": built.fetching,
        }
        return [
            Part.quick("the service manager", self._say_ending),
            Part("the control thread", self._end_motion),
            Part("a task", self._end_tasks),
            *(Part.quick(link.wire.name, link.close) for link in self.links),
            *(Part.blocking(name, thread.stop) for name, thread in threads.items() if thread),
            Part.blocking("closing the hardware", self.station.close),
            Part.blocking("keeping what the box remembers", lambda: built.remembered.end_properly(built.loop.status)),
            Part.blocking("the last autosave", built.autosave.close),
            Part.quick("the service manager", built.service_manager.close),
        ]

    async def _start(self) -> asyncio.Future[Exception | None]:
        """Start everything. Returns the future that is done when the control thread ends. Raises LinkError."""
        built = self._built
        if self.station.sentinel and self.station.lines:
            built.service_manager.leave(RELAY_LINES, self.station.lines.to_text())
            self._tasks.append(asyncio.create_task(sentinel_fails(self.station.sentinel), name="sentinel"))
        built.remembered.thread.start()
        if (latched := self.loop.status.latch) is not None:
            log.warning("%s", held_by(latched.by, storm=latched.storm))
        if self._anew.holder is not None:
            self.loop.post(self._anew.holder, Take())
        motion_ended = built.engine.start()
        for link in self.links:
            await link.open()
            self._tasks.append(asyncio.create_task(link.run(), name=link.wire.name))
        if built.page:
            built.page.start()
            if self._anew.again and built.page.wire.state == "closed":
                # Else a person who has changed the page's port by the page could never change it back.
                raise LinkError(f"{built.page.wire.where}: the page cannot listen there")
        for thread in (built.mqtt, built.display, built.panel, built.tracking, built.fetching):
            if thread:
                thread.start()
        side = [("monitor", built.monitor_socket.run()), ("console", built.console_socket.run())]
        if built.elements_server:
            side.append(("elements for other boxes", built.elements_server.run()))
        if built.calibration:
            side.append(("the calibration", self._calibrate(built.calibration)))
        elif self.config.compass.at_start:
            from rotator.calibrating.at_start import watch_at_start  # noqa: PLC0415 - many a box has no compass

            state = built.remembered.state
            side.append(("compass", watch_at_start(self.config, self.station.board, self.loop, state)))
        for name, work in side:
            self._side_tasks.append(asyncio.create_task(work, name=name))
        self._tasks.append(asyncio.create_task(built.autosave.run(), name="autosave"))
        self._tasks.append(asyncio.create_task(built.events.run(), name="the event loop's watch"))
        return motion_ended

    def _say_ending(self) -> None:
        if self._anew.asked:
            self._built.service_manager.pausing()
        else:
            self._built.service_manager.stopping()

    async def _end_motion(self) -> None:
        failure = await self._built.engine.halt()
        if failure is not None:
            raise failure

    async def _end_tasks(self) -> None:
        """Cancel all tasks. Raises the first failure; the others are in the log."""
        tasks = [*self._tasks, *self._side_tasks]
        self._tasks, self._side_tasks = [], []
        for task in tasks:
            task.cancel()
        outcomes = await asyncio.gather(*tasks, return_exceptions=True)
        failed = [outcome for outcome in outcomes if isinstance(outcome, Exception)]
        for failure in failed[1:]:
            log.error("another task failed: %s", failure)
        if failed:
            raise failed[0]

    async def _calibrate(self, calibration: PageCalibration) -> None:
        """Until the guide ends. Then the box starts anew with what has been saved."""
        try:
            await calibration.run(self.loop, self.station.rotor.sensors)
        except Exception:
            log.exception("the calibration has failed: nothing of it is saved")
        self._anew.calibrated = calibration.outcome()
        self._anew.ask(self.loop.status)
