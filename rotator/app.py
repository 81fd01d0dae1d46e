"""The composition root: from a configuration to hardware, controller and links, running.

With `rotator.assembly` and `rotator.rotors`, its other parts, the only code that names concrete classes. Knows how the
parts fit together, and in which order they start and stop.
"""

from __future__ import annotations

import asyncio
import itertools
import os
import time
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from rotator.assembly.links import build_links
from rotator.assembly.panel import panel_thread
from rotator.assembly.settings import build_controller, build_learnt, build_mount, build_offsets
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.links.console import ConsoleSocket, console_path
from rotator.monitor.socket import MonitorSocket
from rotator.monitor.tap import Tap
from rotator.orders import Source
from rotator.panel.thread import PanelThread
from rotator.protocols.console_session import ConsoleSession
from rotator.runtime.autosave import Autosave
from rotator.runtime.client import Client
from rotator.runtime.display import DisplayThread
from rotator.runtime.engine import Engine, process_end
from rotator.runtime.loop import ControlLoop
from rotator.runtime.service_manager import ServiceManager, runtime_folder
from rotator.store import counts, knobs
from rotator.views import lcd

RELAY_LINES = "relay-lines.json"
"""What the unit's ExecStopPost reads to open the relays of a program that has died."""


def monitor_path(config: Config, environment: Mapping[str, str]) -> Path:
    """Where the socket for watchers is."""
    beside = runtime_folder(environment) or Path(config.state.path).parent
    return Path(config.monitor.path) if config.monitor.path else beside / "monitor"


def open_station(config: Config) -> Station:
    """The hardware, in real time; what counts goes on from where it was when the program ended."""
    kept = None if config.rotor.hardware == "sim" else Path(config.state.path).with_name(counts.FILE_NAME)
    return Station(config, time.monotonic, time.sleep, counts=kept)


class App:
    """The whole box, in real time. Build it, `await run(stop)`, and every relay is off when that returns."""

    def __init__(self, config: Config, path: Path | None = None, station: Station | None = None) -> None:
        self.config = config
        self.station = station or open_station(config)
        self._supervisor = ServiceManager(os.environ, time.monotonic)
        mount = build_mount(config)
        learnt = build_learnt(config)
        self.loop = ControlLoop(
            build_controller(config, learnt.load()),
            self.station.rotor,
            time.monotonic,
            1 / config.control.rate_hz,
            after_good_step=self._sign_of_life,
        )
        self.console = Client(self.loop, mount, Source("console"))
        people = itertools.count(1)
        self._people = ConsoleSocket(
            console_path(monitor_path(config, os.environ)),
            lambda: ConsoleSession(Client(self.loop, mount, Source("console", next(people)))),
        )
        self._tap = Tap(datetime.now, lambda: self.loop.status)
        self.links = build_links(config.link, self.loop, mount, self._tap)
        self._panel = self._fit_panel()
        self._engine = Engine(self.loop, self.station.rotor)
        self._autosave = Autosave(self.loop, path, build_offsets(config), learnt)

    def lcd_rows(self, now_s: float) -> tuple[str, str]:
        return lcd.rows(self.loop.status, now_s)

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, or whatever stopped the control thread."""
        display = DisplayThread(self.station.display, self.lcd_rows, time.monotonic) if self.station.display else None
        tasks: list[asyncio.Task[Any]] = []
        beside: list[asyncio.Task[None]] = []
        try:
            if self.station.sentinel and self.station.lines:
                self._supervisor.leave(RELAY_LINES, self.station.lines.to_json())
                tasks.append(asyncio.create_task(process_end(self.station.sentinel.pid), name="sentinel"))
            ended = self._engine.start()
            for link in self.links:
                await link.open()
                tasks.append(asyncio.create_task(link.run(), name=link.wire.name))
                # Its first turn: a task cancelled before that would never close what has been opened.
                await asyncio.sleep(0)
            if display:
                display.start()
            if self._panel:
                self._panel.start()
            watching = MonitorSocket(monitor_path(self.config, os.environ), self._tap.listeners, self._tap.greeting)
            beside.append(asyncio.create_task(watching.run(), name="monitor"))
            beside.append(asyncio.create_task(self._people.run(), name="console"))
            tasks.append(asyncio.create_task(self._autosave.run()))
            tasks.append(asyncio.create_task(stop.wait()))
            self._supervisor.ready()
            ending: list[asyncio.Future[Any]] = [ended, *tasks]
            await asyncio.wait(ending, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._supervisor.stopping()
            if self._panel:
                await asyncio.to_thread(self._panel.stop)
            outcomes: list[object] = [await self._engine.halt()]
            # Whatever becomes of these, the box goes on: they are not among those whose end is the end.
            tasks += beside
            for task in tasks:
                task.cancel()
            outcomes += await asyncio.gather(*tasks, return_exceptions=True)
            if display:
                await asyncio.to_thread(display.stop)
            await asyncio.to_thread(self.station.close)
            await asyncio.to_thread(self._autosave.close)
            self._supervisor.close()
        for outcome in outcomes:
            if isinstance(outcome, Exception):
                raise outcome

    def _fit_panel(self) -> PanelThread | None:
        parts, source = self.station.panel, Source("panel")
        if parts is None:
            return None
        simulated = self.config.rotor.hardware == "sim"
        panel = panel_thread(
            self.config,
            parts,
            lambda: self.loop.status,
            lambda order: self.loop.post(source, order),
            time.monotonic,
            knobs=None if simulated else Path(self.config.state.path).with_name(knobs.FILE_NAME),
            pulses=self.station.rotor.closed_contacts,
        )
        self._tap.on_data = panel.data_received
        return panel

    def _sign_of_life(self) -> None:
        self._supervisor.alive()
        self.station.beat()
