"""The composition root: from a configuration to hardware, controller and links, running.

With `station` and `simulation`, its other parts, the only code that names concrete classes. Knows how the parts fit
together, and in which order they start and stop.
"""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.config.model import AxisTable, Config, SimAxisTable
from rotator.control.axis import AxisSettings
from rotator.control.calibration import Calibration
from rotator.control.controller import Controller, Settings
from rotator.control.motion import Motor
from rotator.control.mount import Mount, Range
from rotator.control.offsets import Offsets, offsets
from rotator.control.sensing import Window
from rotator.display import DisplayThread
from rotator.door import Door
from rotator.engine import Engine, process_end
from rotator.keeping import Keeper
from rotator.links.monitor import MonitorSocket
from rotator.loop import ControlLoop
from rotator.orders import Source
from rotator.overhearing import Tape
from rotator.simulation import SIM_CALIBRATION_RAW
from rotator.station import Station
from rotator.status import LearntMotor
from rotator.store.learnt import LearntFile, Motors
from rotator.supervisor import Supervisor, runtime_folder
from rotator.switchboard import build_links
from rotator.views import lcd


def build_offsets(config: Config) -> Offsets:
    declination_deg = config.mount.declination_deg if config.mount.north == "magnetic" else None
    return offsets(config.azimuth.offset_deg, config.elevation.offset_deg, declination_deg)


def build_mount(config: Config) -> Mount:
    shift, azimuth, elevation = build_offsets(config), config.azimuth, config.elevation
    return Mount(
        azimuth=Range(azimuth.min_deg + shift.azimuth_deg, azimuth.max_deg + shift.azimuth_deg),
        elevation=Range(elevation.min_deg + shift.elevation_deg, elevation.max_deg + shift.elevation_deg),
        park_azimuth_deg=config.mount.park_azimuth_deg,
        park_elevation_deg=config.mount.park_elevation_deg,
        flip=config.mount.flip == "over-top",
        horizon=tuple(config.mount.horizon),
    )


def build_learnt(config: Config) -> LearntFile:
    """The file of what the motors taught; figures learnt under another description of the motor do not count."""

    def begun(table: AxisTable, sim: SimAxisTable) -> dict[str, object]:
        said: dict[str, object] = {"hardware": config.rotor.hardware}
        said |= {"speed_dps": table.speed_dps, "coast_s": table.coast_s}
        if config.rotor.hardware == "sim":
            said["sim"] = sim.model_dump(include={"speed_dps", "lag_s", "relay_delay_s"})
        return said

    return LearntFile(
        Path(config.state.path),
        {
            Axis.AZIMUTH: begun(config.azimuth, config.sim.azimuth),
            Axis.ELEVATION: begun(config.elevation, config.sim.elevation),
        },
    )


def build_controller(
    config: Config, learnt: Mapping[Axis, Motors] | None = None, commissioning: Axis | None = None
) -> Controller:
    """`learnt`: what earlier runs know of the motors. `commissioning`: an axis to be taken for one never set up."""
    simulated = config.rotor.hardware == "sim"
    mount = build_mount(config)
    shift = build_offsets(config)

    def motor(found: LearntMotor) -> Motor:
        return Motor(found.speed_dps, found.coast_deg)

    def axis(which: Axis, table: AxisTable, limits: Range) -> AxisSettings:
        points = table.calibration
        if points is None and simulated:
            low_raw, high_raw = SIM_CALIBRATION_RAW
            points = [(low_raw, table.min_deg), (high_raw, table.max_deg)]
        if which is commissioning:
            points = None
        known = (learnt or {}).get(which)
        return AxisSettings(
            axis=which,
            limits=limits,
            tolerance_deg=table.tolerance_deg,
            motor=Motor(table.speed_dps, table.speed_dps * table.coast_s),
            window=Window(table.lowest_reading, table.highest_reading),
            calibration=None if points is None else Calibration(shift.reported(which, tuple(points))),
            missing=EVERYTHING if which is commissioning else () if simulated else missing(table),
            longest_run_s=table.longest_run_s,
            rest_s=table.rest_s,
            master=config.relays.master is not None,
            learnt=known and (motor(known[0]), motor(known[1])),
        )

    return Controller(
        Settings(
            azimuth=axis(Axis.AZIMUTH, config.azimuth, mount.azimuth),
            elevation=axis(Axis.ELEVATION, config.elevation, mount.elevation),
            mount=mount,
            period_s=1 / config.control.rate_hz,
            simulated=simulated,
            park_after_s=config.mount.park_after_s,
        )
    )


EVERYTHING = ("calibration", "limits", "direction check")
"""What is missing on an axis that nobody has set up."""


def missing(table: AxisTable) -> tuple[str, ...]:
    """What a person has still to do before an axis of real hardware may be aimed."""
    said = table.model_fields_set
    done = (table.calibration is not None, {"min_deg", "max_deg"} <= said, table.direction_checked)
    return tuple(name for name, is_done in zip(EVERYTHING, done, strict=True) if not is_done)


RELAY_LINES = "relay-lines.json"
"""What the unit's ExecStopPost reads to open the relays of a program that has died."""


def monitor_path(config: Config, environment: Mapping[str, str]) -> Path:
    """Where the socket for watchers is."""
    beside = runtime_folder(environment) or Path(config.state.path).parent
    return Path(config.monitor.path) if config.monitor.path else beside / "monitor"


class App:
    """The whole box, in real time. Build it, `await run(stop)`, and every relay is off when that returns."""

    def __init__(self, config: Config, path: Path | None = None, station: Station | None = None) -> None:
        self.config = config
        self.station = station or Station(config, time.monotonic, time.sleep)
        self._supervisor = Supervisor(os.environ, time.monotonic)
        mount = build_mount(config)
        learnt = build_learnt(config)
        self.loop = ControlLoop(
            build_controller(config, learnt.load()),
            self.station.bank,
            self.station.sensors,
            time.monotonic,
            1 / config.control.rate_hz,
            after_good_step=self._sign_of_life,
        )
        self.console = Door(self.loop, mount, Source("console"))
        self._tape = Tape(datetime.now, lambda: self.loop.status)
        self.links = build_links(config.link, self.loop, mount, self._tape)
        self._engine = Engine(self.loop, self.station.bank)
        self._keeper = Keeper(self.loop, path, build_offsets(config), learnt)

    def lcd_rows(self, now_s: float) -> tuple[str, str]:
        return lcd.rows(self.loop.status, now_s)

    async def run(self, stop: asyncio.Event) -> None:
        """Run until `stop` is set. Raises LinkError, or whatever stopped the control thread."""
        display = DisplayThread(self.station.display, self.lcd_rows, time.monotonic) if self.station.display else None
        tasks: list[asyncio.Task[Any]] = []
        monitor: asyncio.Task[None] | None = None
        try:
            if self.station.sentinel:
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
            watching = MonitorSocket(monitor_path(self.config, os.environ), self._tape.listeners, self._tape.greeting)
            monitor = asyncio.create_task(watching.run(), name="monitor")
            tasks.append(asyncio.create_task(self._keeper.run()))
            tasks.append(asyncio.create_task(stop.wait()))
            self._supervisor.ready()
            ending: list[asyncio.Future[Any]] = [ended, *tasks]
            await asyncio.wait(ending, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._supervisor.stopping()
            outcomes: list[object] = [await self._engine.halt()]
            if monitor:
                # Whatever becomes of it, the box goes on: it is not among those whose end is the end.
                tasks.append(monitor)
            for task in tasks:
                task.cancel()
            outcomes += await asyncio.gather(*tasks, return_exceptions=True)
            if display:
                await asyncio.to_thread(display.stop)
            await asyncio.to_thread(self.station.close)
            await asyncio.to_thread(self._keeper.close)
            self._supervisor.close()
        for outcome in outcomes:
            if isinstance(outcome, Exception):
                raise outcome

    def _sign_of_life(self) -> None:
        self._supervisor.alive()
        self.station.beat()
