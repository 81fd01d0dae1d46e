"""The whole box in real time: builds its parts from a configuration, starts them, and stops them in a safe order.

Knows the order of start and stop, and which parts end the box when they end. Knows no driver, kind of rotor or
protocol: `rotator.assembly` chooses those.
"""

from __future__ import annotations

import asyncio
import itertools
import logging
import os
import time
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hw.ports import Axis
from rotator.assembly.calibration import calibration_controller
from rotator.assembly.fetching import build_elements_server, build_fetching
from rotator.assembly.hands import hands
from rotator.assembly.kept_files import build_latch_file, build_learnt, build_relays_file, build_tries_file
from rotator.assembly.links import build_links
from rotator.assembly.settings import build_controller, build_mount, build_offsets
from rotator.assembly.sky import build_sky
from rotator.assembly.station import Station, fitted_panel
from rotator.assembly.tracking import build_tracking
from rotator.calibrating.at_start import watch_at_start
from rotator.calibrating.stops import only_stops
from rotator.config.model import Config
from rotator.config.places import console_path, memory_folder, monitor_path
from rotator.exchange.orders import Take
from rotator.exchange.sources import KEYBOARD, Source
from rotator.exchange.spoken import held_by
from rotator.exchange.status import NO_TRIES
from rotator.links.console import ConsoleSocket
from rotator.links.wire import LinkError, Wire
from rotator.monitor.socket import MonitorSocket
from rotator.monitor.tap import Tap
from rotator.mqtt.build import build_mqtt
from rotator.protocols.console_session import ConsoleSession
from rotator.runtime.anew import Anew
from rotator.runtime.autosave import Autosave
from rotator.runtime.client import Client
from rotator.runtime.closing import Part, closing
from rotator.runtime.dead_threads import dead_threads
from rotator.runtime.display import DisplayThread
from rotator.runtime.engine import Engine, process_end
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.latch_thread import TRIES_THREAD, LatchThread
from rotator.runtime.loop import ControlLoop
from rotator.runtime.service_manager import ServiceManager
from rotator.store import counts
from rotator.store.tries import NOTHING
from rotator.views import lcd
from rotator.web.build import build_page, build_pairings

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration

log = logging.getLogger(__name__)

RELAY_LINES = "relay-lines"
"""The unit's ExecStopPost reads this file to open the relays of a program that has died."""


def open_station(config: Config) -> Station:
    """The hardware, in real time. Where the rotor outlives the program, axes that count start with the kept counts."""
    counts_file = Path(config.state.path).with_name(counts.FILE_NAME) if config.keeps_files else None
    return Station(config, time.monotonic, time.sleep, counts=counts_file)


def _calibration_of(config: Config, axis: Axis, path: Path) -> PageCalibration:
    from rotator.calibrating.on_page import PageCalibration  # noqa: PLC0415 - a start as ever does without its guides

    return PageCalibration(config, axis, path, time.monotonic)


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
        """It has started with all its links."""
        self.station = station or open_station(config)
        self._service_manager = ServiceManager(os.environ, time.monotonic)
        self._events, page_events = EventWatch(time.monotonic), EventWatch(time.monotonic)
        self.mount = mount = build_mount(config)
        memory = memory_folder(config.state.path, path, os.environ)
        learnt, relays_file = build_learnt(config), build_relays_file(config, memory)
        latch_file, tries_file = build_latch_file(config, memory), build_tries_file(config, memory)
        # A new start by the page knows the stop even where a full disk has not taken it.
        stopped = latch_file.load() or self._anew.latch
        self._latch = LatchThread(latch_file.save, stopped)
        kept = learnt.load(), relays_file.begin() if relays_file else None, stopped
        axis = self._anew.sets_up
        tries = tries_file.load() if tries_file else NOTHING
        if axis:
            # A person who sets an axis up releases it. What the file says of the other axis stays as it is.
            tries = {**tries, axis: NO_TRIES}
        self._tries = LatchThread(tries_file.save if tries_file else lambda _: True, tries, name=TRIES_THREAD)
        self._calibration = _calibration_of(config, axis, path) if axis and path else None
        self.loop = ControlLoop(
            calibration_controller(config, axis, *kept)
            if axis
            else build_controller(config, kept[0], trusts=kept[1], tries=tries, latch=stopped, panel=True),
            self.station.rotor,
            time.monotonic,
            1 / config.control.rate_hz,
            after_good_step=self._sign_of_life,
            events=self._events,
            page_events=page_events,
            keep_latch=self._latch.note,
            keep_tries=lambda now: self._tries.note({**tries, axis: now[axis]} if axis else now),
        )
        self._tracking = build_tracking(config, self.loop, mount)
        self._pairings = build_pairings(config, self._tracking.clock_is_known)
        self._fetching = build_fetching(config, self._tracking.clock_is_known, self._tracking.read_again)
        self._elements_server = build_elements_server(config, self._tracking.known_elements)
        self.console = Client(self.loop, mount, Source(KEYBOARD))
        numbers = itertools.count(1)
        monitor = monitor_path(config.state.path, config.monitor.path, os.environ)
        self._console_socket = ConsoleSocket(
            console_path(monitor),
            lambda: ConsoleSession(
                Client(self.loop, mount, Source("console", next(numbers))),
                hands(self.station.world),
                self._tracking.tracker,
                self._pairings,
            ),
        )
        self._tap = Tap(datetime.now, lambda: self.loop.status)
        # While an axis is calibrated no program reaches the box.
        links = [] if self._calibration else config.link
        self.links = build_links(links, self.loop, mount, self._tap, build_sky(config.station))
        self._page = (
            build_page(
                config,
                self.loop,
                mount,
                self._pairings,
                lcd=lambda: self.lcd_rows(time.monotonic(), code_shown=False),
                wires=[link.wire for link in self.links],
                tap=self._tap,
                tracking=self._tracking,
                path=path,
                anew=self._anew,
                calibration=self._calibration,
                events=page_events,
            )
            if self._pairings
            else None
        )
        self._mqtt = build_mqtt(config, self.loop, mount, self._tracking.tracker)
        self._monitor_socket = MonitorSocket(monitor, self._tap.listeners, self._tap.greeting)
        post = partial(self.loop.post, Source("panel"))
        self._panel = fitted_panel(config, self.station, self.loop, only_stops(post) if self._calibration else post)
        if self._panel:
            self._tap.on_data = self._panel.data_received
        display = self.station.display
        self._display = DisplayThread(display, self.lcd_rows, time.monotonic) if display else None
        self._engine = Engine(self.loop, self.station.rotor)
        self._autosave = Autosave(self.loop, path, build_offsets(config), learnt, relays_file, tries=tries_file)
        self._tasks: list[asyncio.Task[Any]] = []
        """The end of one of these is the end of the box."""
        self._side_tasks: list[asyncio.Task[Any]] = []
        """When one of these ends, the box goes on."""

    @property
    def wires(self) -> list[Wire]:
        """The links and the page, as a screen shows them."""
        return [*(link.wire for link in self.links), *(each.wire for each in (self._page, self._mqtt) if each)]

    def lcd_rows(self, now_s: float, *, code_shown: bool = True) -> tuple[str, str]:
        """The rows of the display. Not `code_shown`: with a covered code, for those who are not at the box."""
        code = self._pairings.shown() if self._pairings else ""
        return lcd.rows(self.loop.status, now_s, code if code_shown else "*" * len(code))

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, HardwareError, or the exception that ended the control thread."""
        with dead_threads(self.loop.fail):
            await self._run(stop)

    async def _run(self, stop: asyncio.Event) -> None:
        async with closing(self._parts()) as failures:
            motion_ended = await self._start()
            self._tasks.append(asyncio.create_task(stop.wait(), name="stop"))
            self._service_manager.ready()
            if self._anew.again:
                self._service_manager.resumed()
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
        parts = [
            Part.quick("the service manager", self._say_ending),
            Part("the control thread", self._end_motion),
            Part("a task", self._end_tasks),
            *(Part.quick(link.wire.name, link.close) for link in self.links),
        ]
        if self._page:
            parts.append(Part.blocking("the page", self._page.stop))
        if self._mqtt:
            parts.append(Part.blocking("MQTT", self._mqtt.stop))
        if self._panel:
            parts.append(Part.blocking("the panel", self._panel.stop))
        if self._display:
            parts.append(Part.blocking("the display", self._display.stop))
        parts.append(Part.blocking("the tracker", self._tracking.stop))
        if self._fetching:
            parts.append(Part.blocking("fetching elements", self._fetching.stop))
        return [
            *parts,
            Part.blocking("closing the hardware", self.station.close),
            Part.blocking("the last autosave", self._autosave.close),
            Part.blocking("keeping a stop", self._latch.close),
            Part.blocking("keeping vain tries", self._tries.close),
            Part.quick("the service manager", self._service_manager.close),
        ]

    async def _start(self) -> asyncio.Future[Exception | None]:
        """Start everything. Returns the future that is done when the control thread ends. Raises LinkError."""
        if self.station.sentinel and self.station.lines:
            self._service_manager.leave(RELAY_LINES, self.station.lines.to_text())
            self._tasks.append(asyncio.create_task(process_end(self.station.sentinel.pid), name="sentinel"))
        self._autosave.keep_relays()
        self._latch.start()
        self._tries.start()
        if (latched := self.loop.status.latch) is not None:
            log.warning("%s", held_by(latched.by, storm=latched.storm))
        if self._anew.holder is not None:
            self.loop.post(self._anew.holder, Take())
        motion_ended = self._engine.start()
        for link in self.links:
            await link.open()
            self._tasks.append(asyncio.create_task(link.run(), name=link.wire.name))
        if self._page:
            self._page.start()
            if self._anew.again and self._page.wire.state == "closed":
                # Else a person who has changed the page's port by the page could never change it back.
                raise LinkError(f"{self._page.wire.where}: the page cannot listen there")
        if self._mqtt:
            self._mqtt.start()
        if self._display:
            self._display.start()
        if self._panel:
            self._panel.start()
        self._tracking.start()
        if self._fetching:
            self._fetching.start()
        side = [("monitor", self._monitor_socket.run()), ("console", self._console_socket.run())]
        if self._elements_server:
            side.append(("elements for other boxes", self._elements_server.run()))
        if self._calibration:
            side.append(("the calibration", self._calibrate(self._calibration)))
        elif self.config.compass.at_start:
            side.append(("compass", watch_at_start(self.config, self.station.board, self.loop)))
        for name, work in side:
            self._side_tasks.append(asyncio.create_task(work, name=name))
        self._tasks.append(asyncio.create_task(self._autosave.run(), name="autosave"))
        self._tasks.append(asyncio.create_task(self._events.run(), name="the event loop's watch"))
        return motion_ended

    def _say_ending(self) -> None:
        if self._anew.asked:
            self._service_manager.pausing()
        else:
            self._service_manager.stopping()

    async def _end_motion(self) -> None:
        failure = await self._engine.halt()
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
            await calibration.run(self.loop)
        except Exception:
            log.exception("the calibration has failed: nothing of it is saved")
        self._anew.said = calibration.lines
        self._anew.ask(self.loop.status)

    def _sign_of_life(self) -> None:
        self._service_manager.alive()
        self.station.beat()
