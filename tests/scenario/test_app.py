"""The whole box in real time, in this process: threads, links, drivers and a simulated rotor, from start to stop."""

from __future__ import annotations

import asyncio
import os
import socket
import threading
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import AngleSensor, AngleSource, Axis, CharacterDisplay, Direction, HardwareError
from hw.safety.guard import GUARD_THREAD
from rotator.assembly.kept_files import build_state, build_tries
from rotator.assembly.station import open_station
from rotator.box.app import App
from rotator.config.load import parse, shipped
from rotator.config.model import Config
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Tries
from rotator.exchange.orders import Jog
from rotator.exchange.sources import Source
from rotator.links.wire import LinkError
from rotator.runtime.anew import Anew
from rotator.runtime.display import DISPLAY_THREAD
from rotator.runtime.engine import CONTROL_THREAD
from rotator.runtime.sensor_thread import SENSORS_THREAD
from tests.boxes import free_port

PATIENCE_S = 60.0
OFF = (0, 0)
THREADS = {CONTROL_THREAD, GUARD_THREAD, SENSORS_THREAD, DISPLAY_THREAD}
"""The threads of the shipped station."""


class Relays:
    """The motor relays of a simulated station, watched from the event loop."""

    def __init__(self, world: SimRelayPotRotor) -> None:
        self._world = world
        self._events = asyncio.get_running_loop()
        self._changed = asyncio.Event()
        world.gpio.on_edges.append(self._see)

    def _see(self, _now_s: float, _changes: Mapping[int, bool]) -> None:
        if not self._events.is_closed():
            self._events.call_soon_threadsafe(self._changed.set)

    async def until(self, meets: Callable[[tuple[int, int]], bool]) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while not meets(self._world.drives()):
                self._changed.clear()
                await self._changed.wait()


class Line:
    """A tracking program's end of a link."""

    def __init__(self, reader: asyncio.StreamReader, send: Callable[[bytes], object]) -> None:
        self._reader = reader
        self.send = send

    async def answer(self) -> bytes:
        return await asyncio.wait_for(self._reader.readuntil(b"\n"), PATIENCE_S)

    async def ask(self, data: bytes) -> bytes:
        self.send(data)
        return await self.answer()


@asynccontextmanager
async def terminal(path: Path) -> AsyncIterator[Line]:
    fd = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    file = os.fdopen(fd, "r+b", buffering=0)
    reader = asyncio.StreamReader()
    transport, _ = await asyncio.get_running_loop().connect_read_pipe(
        lambda: asyncio.StreamReaderProtocol(reader), file
    )
    try:
        yield Line(reader, lambda data: os.write(fd, data))
    finally:
        transport.close()


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def config(tmp_path: Path, port: int) -> Config:
    """The shipped simulated station, in a place of its own."""
    text = shipped().replace("run/gs232", f"{tmp_path}/gs232").replace("4533", str(port))
    return parse(text + f'\n[state]\npath = "{tmp_path}/state.json"\n', "shipped")


async def links_open(app: App, task: asyncio.Task[None]) -> None:
    """They open within the first turns of the event loop."""
    async with asyncio.timeout(PATIENCE_S):
        while not task.done() and any(link.wire.state == "closed" for link in app.links):
            await asyncio.sleep(0)


@asynccontextmanager
async def running(app: App) -> AsyncIterator[tuple[SimRelayPotRotor, Relays]]:
    """The box once its links are open; stopped afterwards, with every relay off."""
    world = app.station.world
    assert isinstance(world, SimRelayPotRotor)
    relays = Relays(world)
    stop = asyncio.Event()
    task = asyncio.create_task(app.run(stop))
    await links_open(app, task)
    try:
        yield world, relays
    finally:
        stop.set()
        await asyncio.wait_for(task, PATIENCE_S)
        assert world.drives() == OFF


def position(reply: bytes) -> tuple[int, int]:
    assert reply.startswith(b"AZ=")
    return int(reply[3:6]), int(reply[11:14])


@pytest.mark.parametrize("axis", list(Axis))
def test_an_axis_that_is_set_up_on_the_page_is_released_and_the_other_is_not(tmp_path: Path, axis: Axis) -> None:
    text = f'[state]\npath = "{tmp_path}/state.json"\n[sim]\nworld = "{tmp_path}/world"\n'
    tried = Tries(2, FaultKind.END_STOP, (440.0, None), (440.0, None))
    config = parse(text, "a test's file")
    kept = build_tries(config, build_state(config))
    assert kept is not None
    kept.save(dict.fromkeys(Axis, tried))
    anew, other = Anew(), next(each for each in Axis if each is not axis)
    anew.sets_up = axis

    async def set_up() -> None:
        app, stop = App(config, anew=anew), asyncio.Event()
        task = asyncio.create_task(app.run(stop))
        async with asyncio.timeout(PATIENCE_S):
            while not task.done() and app.loop.status.axis(other).angle_deg is None:
                await asyncio.sleep(0.01)
            app.loop.post(Source("console", 1), Jog(other, Direction.PLUS, 0.5))
            while not task.done() and not app.loop.status.axis(other).tries.driven:
                await asyncio.sleep(0.01)
        stop.set()
        await task

    asyncio.run(set_up())
    again = build_tries(config, build_state(config))
    assert again is not None
    assert again.load() == {each: NO_TRIES if each is axis else tried for each in Axis}


# --- running


def test_w_moves_c2_answers_s_stops(config: Config, tmp_path: Path) -> None:
    async def talk() -> None:
        app = App(config)
        async with running(app) as (world, relays), terminal(tmp_path / "gs232") as line:
            assert await line.ask(b"C2\r") == b"AZ=000  EL=000\r\n"
            wire = app.links[0].wire
            assert (wire.last_in, wire.last_out) == (b"C2\r", b"AZ=000  EL=000\r\n")
            line.send(b"W235 025\r")
            await relays.until((1, 1).__eq__)
            async with asyncio.timeout(PATIENCE_S):
                while position(await line.ask(b"C2\r"))[0] < 3 or world.antenna()[1] <= 0.0:
                    pass
            assert world.drives()[0] == 1
            line.send(b"S\r")
            await relays.until(OFF.__eq__)
            azimuth_deg, elevation_deg = world.antenna()
            assert 2 < azimuth_deg < 200
            assert 0 < elevation_deg < 25

    asyncio.run(talk())


def test_every_relay_is_off_after_a_stop_in_mid_motion(config: Config, tmp_path: Path) -> None:
    async def talk() -> SimRelayPotRotor:
        async with running(App(config)) as (world, relays), terminal(tmp_path / "gs232") as line:
            line.send(b"R\rU\r")
            await relays.until((1, 1).__eq__)
        return world

    world = asyncio.run(talk())
    assert world.drives() == OFF
    assert world.relay_starts == 2, "once off, nothing switches a motor on again"
    assert not (tmp_path / "gs232").is_symlink()


# --- ends without a stop


def check_all_gone(app: App) -> None:
    assert app.station.world is not None
    assert app.station.world.drives() == OFF
    assert not THREADS & {thread.name for thread in threading.enumerate()}
    assert all(link.wire.state == "closed" for link in app.links)


def test_a_port_in_use_ends_it_and_leaves_nothing(config: Config, tmp_path: Path, port: int) -> None:
    app = App(config)
    with (
        socket.create_server(("127.0.0.1", port)),
        pytest.raises(LinkError, match=rf"^127\.0\.0\.1:{port}: cannot listen there: Address already in use"),
    ):
        asyncio.run(app.run(asyncio.Event()))
    assert not (tmp_path / "gs232").is_symlink(), "the link that was open already"
    check_all_gone(app)


class FailsInMotion:
    """A sensor whose driver has a bug that shows once the motors run."""

    source = AngleSource.MEASURED

    def __init__(self, sensor: AngleSensor, world: SimRelayPotRotor) -> None:
        self._sensor = sensor
        self._world = world

    def read(self) -> float:
        if self._world.drives() != OFF:
            raise ZeroDivisionError("a bug in a driver")
        return self._sensor.read()


def test_a_bug_in_the_control_thread_switches_off_and_is_told(config: Config, tmp_path: Path) -> None:
    async def talk(app: App) -> None:
        assert isinstance(app.station.world, SimRelayPotRotor)
        relays = Relays(app.station.world)
        task = asyncio.create_task(app.run(asyncio.Event()))
        await links_open(app, task)
        async with terminal(tmp_path / "gs232") as line:
            line.send(b"R\r")
            await asyncio.wait_for(task, PATIENCE_S)
        await relays.until(OFF.__eq__)

    app = App(config)
    world = app.station.world
    assert isinstance(world, SimRelayPotRotor)
    sensors: Any = app.station.rotor.sensors
    sensors[Axis.AZIMUTH] = FailsInMotion(sensors[Axis.AZIMUTH], world)
    with pytest.raises(ZeroDivisionError, match="a bug in a driver"):
        asyncio.run(talk(app))
    assert world.relay_starts == 1, "the motor did run"
    check_all_gone(app)


class FailsToShow:
    """A display whose driver has a bug that shows once the motors run."""

    def __init__(self, display: CharacterDisplay, world: SimRelayPotRotor) -> None:
        self._display = display
        self._world = world

    def reset(self) -> None:
        self._display.reset()

    def show(self, rows: Sequence[str]) -> None:
        if self._world.drives() != OFF:
            raise KeyError("a bug in the display's driver")
        self._display.show(rows)


def test_so_does_a_bug_in_any_other_thread(config: Config, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A display that shows old angles for ever is worse than a box that starts anew."""

    async def talk(app: App) -> None:
        task = asyncio.create_task(app.run(asyncio.Event()))
        await links_open(app, task)
        async with terminal(tmp_path / "gs232") as line:
            line.send(b"R\r")
            await asyncio.wait_for(task, PATIENCE_S)

    station = open_station(config)
    world: Any = station.world
    assert station.display is not None
    station.display = FailsToShow(station.display, world)
    app = App(config, station=station)
    with pytest.raises(HardwareError, match="the thread 'display' has ended by a mistake of the program"):
        asyncio.run(talk(app))
    assert world.relay_starts == 1, "the motor did run"
    assert "a bug in the display's driver" in caplog.text
    check_all_gone(app)
