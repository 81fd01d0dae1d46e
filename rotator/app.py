"""The composition root: from a configuration to hardware, controller and links, running.

With `station` and `simulation`, its other parts, the only code that names concrete classes. Knows how the parts fit
together, and in which order they start and stop.
"""

from __future__ import annotations

import asyncio
import itertools
import logging
import threading
import time
from pathlib import Path
from typing import Any, Protocol

from hw.guard import Guard
from hw.ports import Axis
from rotator.config.load import ConfigError
from rotator.config.model import AxisTable, Config, Link, address
from rotator.config.save import save_calibration
from rotator.control.axis import AxisSettings
from rotator.control.calibration import Calibration
from rotator.control.controller import Controller, Settings
from rotator.control.motion import Motor
from rotator.control.mount import Mount, Range
from rotator.control.sensing import Window
from rotator.display import DisplayThread
from rotator.door import Door
from rotator.links.pty import PtyLink
from rotator.links.serial import SerialLink
from rotator.links.tcp import TcpLink
from rotator.links.wire import Wire
from rotator.loop import ControlLoop
from rotator.orders import Source
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld import RotctldSession
from rotator.protocols.session import Box, Session
from rotator.simulation import SIM_CALIBRATION_RAW
from rotator.station import Station
from rotator.views import lcd

log = logging.getLogger(__name__)

SAVE_EVERY_S = 1.0
JOIN_S = 2.0


class RunningLink(Protocol):
    wire: Wire

    async def open(self) -> None: ...

    async def run(self) -> None: ...


def build_mount(config: Config) -> Mount:
    return Mount(
        azimuth=Range(config.azimuth.min_deg, config.azimuth.max_deg),
        elevation=Range(config.elevation.min_deg, config.elevation.max_deg),
        park_azimuth_deg=config.mount.park_azimuth_deg,
        park_elevation_deg=config.mount.park_elevation_deg,
    )


def build_controller(config: Config) -> Controller:
    simulated = config.rotor.hardware == "sim"
    mount = build_mount(config)

    def axis(which: Axis, table: AxisTable, limits: Range) -> AxisSettings:
        points = table.calibration
        if points is None and simulated:
            low_raw, high_raw = SIM_CALIBRATION_RAW
            points = [(low_raw, table.min_deg), (high_raw, table.max_deg)]
        return AxisSettings(
            axis=which,
            limits=limits,
            tolerance_deg=table.tolerance_deg,
            motor=Motor(table.speed_dps, table.speed_dps * table.coast_s),
            window=Window(table.lowest_reading, table.highest_reading),
            calibration=None if points is None else Calibration(tuple(points)),
            missing=() if simulated else missing(table),
        )

    return Controller(
        Settings(
            azimuth=axis(Axis.AZIMUTH, config.azimuth, mount.azimuth),
            elevation=axis(Axis.ELEVATION, config.elevation, mount.elevation),
            mount=mount,
            period_s=1 / config.control.rate_hz,
            simulated=simulated,
        )
    )


def missing(table: AxisTable) -> tuple[str, ...]:
    """What a person has still to do before an axis of real hardware may be aimed."""
    said = table.model_fields_set
    checks = {
        "calibration": table.calibration is not None,
        "limits": {"min_deg", "max_deg"} <= said,
        "direction check": table.direction_checked,
    }
    return tuple(name for name, done in checks.items() if not done)


def session_maker(link: Link, box: Box) -> Session:
    """A fresh conversation on a link, in its protocol."""
    match link.protocol:
        case "gs232a" | "gs232b":
            return Gs232Session(
                box,
                Dialect.A if link.protocol == "gs232a" else Dialect.B,
                ack=b"\r" if link.ack == "cr" else b"",
                may_calibrate=link.may_calibrate,
            )
        case "gs232-f1efw":
            return F1efwSession(box)
        case "rotctld":
            return RotctldSession(box)


class ControlThread:
    """The control loop in its thread, and its end as something asyncio can wait for."""

    def __init__(self, loop: ControlLoop) -> None:
        self._loop = loop
        self._events = asyncio.get_running_loop()
        self.ended: asyncio.Future[Exception | None] = self._events.create_future()
        self._thread = threading.Thread(target=self._run, name="control", daemon=True)

    def start(self) -> None:
        self._thread.start()

    async def join(self) -> Exception | None:
        """What stopped the loop, if something did. A thread that hangs on a dead bus is left behind: relays are off."""
        try:
            return await asyncio.wait_for(self.ended, JOIN_S)
        except TimeoutError:
            log.error("the control thread does not end; the relays are off")
            return None

    def _run(self) -> None:
        failure: Exception | None = None
        try:
            self._loop.run()
        except Exception as fault:
            # It travels to whoever waits for the box; the loop has switched everything off on its way out.
            log.exception("the control thread failed")
            failure = fault
        self._events.call_soon_threadsafe(self._end, failure)

    def _end(self, failure: Exception | None) -> None:
        if not self.ended.done():
            self.ended.set_result(failure)


class App:
    """The whole box, in real time. Build it, `await run(stop)`, and every relay is off when that returns."""

    def __init__(self, config: Config, path: Path | None = None, station: Station | None = None) -> None:
        self.config = config
        self._path = path
        self.station = station or Station(config, time.monotonic, time.sleep)
        mount = build_mount(config)
        self.loop = ControlLoop(
            build_controller(config),
            self.station.bank,
            self.station.sensors,
            time.monotonic,
            1 / config.control.rate_hz,
        )
        self.console = Door(self.loop, mount, Source("console"))
        self.links = [self._link(link, mount) for link in config.link]
        self._guard = Guard(self.station.bank, time.monotonic)

    def lcd_rows(self, now_s: float) -> tuple[str, str]:
        return lcd.rows(self.loop.status, now_s)

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, or whatever stopped the control thread."""
        display = DisplayThread(self.station.display, self.lcd_rows, time.monotonic) if self.station.display else None
        control = ControlThread(self.loop)
        tasks: list[asyncio.Task[object]] = []
        self._guard.start()
        try:
            control.start()
            for link in self.links:
                await link.open()
                tasks.append(asyncio.create_task(link.run(), name=link.wire.name))
            if display:
                display.start()
            tasks.append(asyncio.create_task(self._keep_calibrations()))
            tasks.append(asyncio.create_task(stop.wait()))
            ending: list[asyncio.Future[Any]] = [control.ended, *tasks]
            await asyncio.wait(ending, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self.loop.stop()
            self._guard.stop()
            for task in tasks:
                task.cancel()
            outcomes: list[object] = [*await asyncio.gather(*tasks, return_exceptions=True)]
            outcomes.append(await control.join())
            if display:
                await asyncio.to_thread(display.stop)
            self.station.close()
        for outcome in outcomes:
            if isinstance(outcome, Exception):
                raise outcome

    def _link(self, link: Link, mount: Mount) -> RunningLink:
        wire = Wire(link.name or link.protocol, link.protocol, link.where)
        connections = itertools.count(1)

        def session() -> Session:
            return session_maker(link, Door(self.loop, mount, Source(wire.name, next(connections))))

        if link.pty is not None:
            return PtyLink(wire, Path(link.pty), session)
        if link.serial is not None:
            return SerialLink(wire, link.serial, link.baud, session)
        host, port = address(link.where)
        return TcpLink(wire, host, port, session)

    async def _keep_calibrations(self) -> None:
        """Save a calibration taken over a link (O, F) as soon as it is there."""
        kept = {axis: self.loop.status.axis(axis).calibration for axis in Axis}
        while True:
            await asyncio.sleep(SAVE_EVERY_S)
            for axis in Axis:
                points = self.loop.status.axis(axis).calibration
                if points is None or points == kept[axis]:
                    continue
                kept[axis] = points
                if self._path is None:
                    log.warning("%s: new calibration, lost at the end: run with --config to keep it", axis.value)
                    continue
                try:
                    await asyncio.to_thread(save_calibration, self._path, axis.value, points)
                    log.info("%s: calibration saved in %s", axis.value, self._path)
                except (OSError, ConfigError) as fault:
                    log.error("%s: calibration cannot be saved: %s", axis.value, fault)
