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
from collections.abc import Coroutine
from datetime import datetime
from pathlib import Path
from typing import Any

from rotator.assembly.calibration import compass_path, open_compass
from rotator.assembly.hands import hands
from rotator.assembly.links import build_links
from rotator.assembly.panel import panel_thread
from rotator.assembly.settings import build_controller, build_learnt, build_mount, build_offsets
from rotator.assembly.sky import build_sky
from rotator.assembly.station import Station
from rotator.assembly.tracking import build_tracking
from rotator.calibrating.at_start import CompassAtStart, watch
from rotator.calibrating.compass import CompassReader
from rotator.calibrating.facts import north_facts
from rotator.config.model import Config
from rotator.config.places import console_path, monitor_path
from rotator.links.console import ConsoleSocket
from rotator.monitor.socket import MonitorSocket
from rotator.monitor.tap import Tap
from rotator.orders import Source
from rotator.panel.thread import PanelThread
from rotator.protocols.console_session import ConsoleSession
from rotator.runtime.autosave import Autosave
from rotator.runtime.client import Client
from rotator.runtime.closing import Part, closing
from rotator.runtime.display import DisplayThread
from rotator.runtime.engine import Engine, process_end
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.loop import ControlLoop
from rotator.runtime.service_manager import ServiceManager
from rotator.store import counts, knobs, relays
from rotator.store.compass import CompassFile
from rotator.store.relays import RelaysFile
from rotator.views import lcd

log = logging.getLogger(__name__)

RELAY_LINES = "relay-lines"
"""The unit's ExecStopPost reads this file to open the relays of a program that has died."""


def open_station(config: Config) -> Station:
    """The hardware, in real time. Where the rotor outlives the program, axes that count start with the kept counts."""
    counts_file = Path(config.state.path).with_name(counts.FILE_NAME) if config.keeps_files else None
    return Station(config, time.monotonic, time.sleep, counts=counts_file)


def open_relays(config: Config) -> RelaysFile | None:
    """The file in which a doubt about a relay survives the program; None where the rotor does not, or has no relays."""
    kept = config.keeps_files and config.rotor.switched
    return RelaysFile(Path(config.state.path).with_name(relays.FILE_NAME)) if kept else None


class App:
    """The whole box, in real time. Build it, then `await run(stop)` once. Every relay is off when that returns."""

    def __init__(self, config: Config, path: Path | None = None, station: Station | None = None) -> None:
        """`path`: the configuration's file, where calibrations are saved. Raises HardwareError."""
        self.config = config
        self.station = station or open_station(config)
        self._service_manager = ServiceManager(os.environ, time.monotonic)
        self._events = EventWatch(time.monotonic)
        self.mount = mount = build_mount(config)
        learnt, relays_file = build_learnt(config), open_relays(config)
        self.loop = ControlLoop(
            build_controller(config, learnt.load(), trusts=relays_file.load() if relays_file else None, panel=True),
            self.station.rotor,
            time.monotonic,
            1 / config.control.rate_hz,
            after_good_step=self._sign_of_life,
            events=self._events,
        )
        self._tracking = build_tracking(config, self.loop, mount)
        self.console = Client(self.loop, mount, Source("console"))
        numbers = itertools.count(1)
        monitor = monitor_path(config.state.path, config.monitor.path, os.environ)
        self._console_socket = ConsoleSocket(
            console_path(monitor),
            lambda: ConsoleSession(
                Client(self.loop, mount, Source("console", next(numbers))),
                hands(self.station.world),
                self._tracking.tracker if self._tracking else None,
            ),
        )
        self._tap = Tap(datetime.now, lambda: self.loop.status)
        self.links = build_links(config.link, self.loop, mount, self._tap, build_sky(config.station))
        self._monitor_socket = MonitorSocket(monitor, self._tap.listeners, self._tap.greeting)
        self._panel = self._fit_panel()
        display = self.station.display
        self._display = DisplayThread(display, self.lcd_rows, time.monotonic) if display else None
        self._engine = Engine(self.loop, self.station.rotor)
        self._autosave = Autosave(self.loop, path, build_offsets(config), learnt, relays_file)
        self._tasks: list[asyncio.Task[Any]] = []
        """The end of one of these is the end of the box."""
        self._side_tasks: list[asyncio.Task[Any]] = []
        """When one of these ends, the box goes on."""

    def lcd_rows(self, now_s: float) -> tuple[str, str]:
        return lcd.rows(self.loop.status, now_s)

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, HardwareError, or the exception that ended the control thread."""
        async with closing(self._parts()) as failures:
            motion_ended = await self._start()
            self._tasks.append(asyncio.create_task(stop.wait(), name="stop"))
            self._service_manager.ready()
            if not self.links:
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
            Part.quick("the service manager", self._service_manager.stopping),
            Part("the control thread", self._end_motion),
            Part("a task", self._end_tasks),
            *(Part.quick(link.wire.name, link.close) for link in self.links),
        ]
        if self._panel:
            parts.append(Part.blocking("the panel", self._panel.stop))
        if self._display:
            parts.append(Part.blocking("the display", self._display.stop))
        if self._tracking:
            parts.append(Part.blocking("the tracker", self._tracking.stop))
        return [
            *parts,
            Part.blocking("closing the hardware", self.station.close),
            Part.blocking("the last autosave", self._autosave.close),
            Part.quick("the service manager", self._service_manager.close),
        ]

    async def _start(self) -> asyncio.Future[Exception | None]:
        """Start everything. Returns the future that is done when the control thread ends. Raises LinkError."""
        if self.station.sentinel and self.station.lines:
            self._service_manager.leave(RELAY_LINES, self.station.lines.to_text())
            self._tasks.append(asyncio.create_task(process_end(self.station.sentinel.pid), name="sentinel"))
        self._autosave.keep_relays()
        motion_ended = self._engine.start()
        for link in self.links:
            await link.open()
            self._tasks.append(asyncio.create_task(link.run(), name=link.wire.name))
        if self._display:
            self._display.start()
        if self._panel:
            self._panel.start()
        if self._tracking:
            self._tracking.start()
        side = [("monitor", self._monitor_socket.run()), ("console", self._console_socket.run())]
        if self.config.compass.at_start:
            side.append(("compass", self._compass_at_start()))
        for name, work in side:
            self._side_tasks.append(asyncio.create_task(work, name=name))
        self._tasks.append(asyncio.create_task(self._autosave.run(), name="autosave"))
        self._tasks.append(asyncio.create_task(self._events.run(), name="the event loop's watch"))
        return motion_ended

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

    def _compass_at_start(self) -> Coroutine[Any, Any, None]:
        """What settles an azimuth that does not know its angle after power-on."""
        corrections = compass_path(self.config)
        compass = open_compass(self.config, self.station.board)
        reader = CompassReader(compass, time.monotonic, CompassFile(corrections) if corrections else None)
        start = CompassAtStart(north_facts(self.config, has_file=corrections is not None))
        source = Source("compass")
        return watch(reader, start, lambda: self.loop.status, lambda order: self.loop.post(source, order))

    def _fit_panel(self) -> PanelThread | None:
        parts, source = self.station.panel, Source("panel")
        if parts is None:
            return None
        panel = panel_thread(
            self.config,
            parts,
            lambda: self.loop.status,
            lambda order: self.loop.post(source, order),
            time.monotonic,
            knobs=Path(self.config.state.path).with_name(knobs.FILE_NAME) if self.config.keeps_files else None,
            pulses=self.station.rotor.closed_contacts,
        )
        self._tap.on_data = panel.data_received
        return panel

    def _sign_of_life(self) -> None:
        self._service_manager.alive()
        self.station.beat()
