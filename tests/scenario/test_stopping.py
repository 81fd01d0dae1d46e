"""How the box ends: whatever fails while it stops, every other part is stopped and every relay is off.

The whole box in real time, in this process. A proper end on every kind of rotor: `tests/rotors/test_proper_end.py`.
"""

from __future__ import annotations

import asyncio
import os
import threading
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.buses.gpio import holders
from hw.ports import HardwareError
from hw.safety.guard import GUARD_THREAD
from rotator.box.app import App
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.exchange.orders import Aim
from rotator.links.wire import Wire
from rotator.panel.thread import PANEL_THREADS
from rotator.rotors.relays import RelayRotor
from rotator.runtime.display import DISPLAY_THREAD
from rotator.runtime.engine import CONTROL_THREAD
from rotator.runtime.sensor_thread import SENSORS_THREAD
from tests.boxes import free_port

PATIENCE_S = 60.0
LOOK_S = 0.02
CHIP, PINS = "/dev/gpiochip0", range(28)
OFF = (0, 0)
THREADS = {CONTROL_THREAD, GUARD_THREAD, SENSORS_THREAD, DISPLAY_THREAD, *PANEL_THREADS}
STATION = """
[lcd]
kind = "pcf8574"
[panel]
stop = 16
jog = 0
lamp_motor = 3
[state]
path = "{folder}/state.json"
[[link]]
protocol = "gs232b"
pty = "{folder}/gs232"
[[link]]
protocol = "rotctld"
tcp = "127.0.0.1:{port}"
[[link]]
protocol = "n1mm"
udp = "127.0.0.1:{port}"
[[link]]
protocol = "wsjtx"
file = "{folder}/azel.dat"
[[link]]
protocol = "easycomm2"
serial = "loop://"
[[link]]
protocol = "rotctld-follow"
connect = "127.0.0.1:9"
"""


@pytest.fixture
def config(tmp_path: Path) -> Config:
    """Relays, a display, a panel and every kind of link."""
    return parse(STATION.format(folder=tmp_path, port=free_port()), "test")


async def until(done: Callable[[], bool]) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while not done():
            await asyncio.sleep(LOOK_S)


async def run_until_it_turns(app: App, then: Callable[[], object] = lambda: None, *, stop_it: bool = True) -> None:
    """Run the box, send it round, do `then` while it turns, stop it, and wait for its end."""
    stop = asyncio.Event()
    task = asyncio.create_task(app.run(stop))
    await until(lambda: task.done() or app.loop.status.azimuth.angle_deg is not None)
    app.console.order(Aim(200.0, None))
    await until(lambda: task.done() or app.loop.status.moving)
    then()
    if stop_it:
        stop.set()
    await asyncio.wait_for(task, PATIENCE_S)


def world_of(app: App) -> SimRelayPotRotor:
    assert isinstance(app.station.world, SimRelayPotRotor)
    return app.station.world


def check_everything_stopped(app: App) -> None:
    world = world_of(app)
    assert world.relay_starts > 0, "a motor ran"
    assert world.drives() == OFF
    assert not holders(world.gpio, CHIP, PINS), "every line has been given back"
    assert not [thread.name for thread in threading.enumerate() if thread.name in THREADS]
    assert {link.wire.state for link in app.links} == {"closed"}
    folder = Path(app.config.state.path).parent
    assert not any((folder / name).exists() for name in ("gs232", "monitor", "console"))


# --- parts that fail when they are stopped


class Relays:
    """Does something in the moment in which a motor's relay has opened. The lines are locked meanwhile."""

    def __init__(self, app: App, then: Callable[[], None]) -> None:
        relays = app.config.relays
        self.pins = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
        self._then = then
        world_of(app).gpio.on_edges.append(self._see)

    def _see(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        if any(changes.get(pin) is False for pin in self.pins):
            self._then()


def a_switched_line_reports_an_error(app: App) -> None:
    """The control thread cannot switch off as it ends."""

    def fail() -> None:
        raise OSError(5, os.strerror(5))

    Relays(app, fail)


def lines_are_taken_away_after_the_loop(app: App) -> None:
    """The control thread has switched off, and the guard cannot do so again: the lines are inputs."""

    def take_away() -> None:
        for pin in relays.pins:
            world_of(app).gpio._header.lines[pin].driven = None

    relays = Relays(app, take_away)


class FailingLink:
    """A link whose driver has a bug that shows when it ends, or when `broken` is set."""

    def __init__(self) -> None:
        self.wire = Wire("failing", "none", "nowhere")
        self.broken = asyncio.Event()

    async def open(self) -> None:
        self.wire.state = "open"

    async def run(self) -> None:
        try:
            await self.broken.wait()
        finally:
            raise ZeroDivisionError("a bug in a link's run")

    def close(self) -> None:
        self.wire.state = "closed"
        raise ZeroDivisionError("a bug in a link's close")


def a_driver_cannot_be_closed(app: App) -> None:
    def fail() -> None:
        raise OSError(9, os.strerror(9))

    app.station._opened.callback(fail)


@pytest.mark.parametrize(
    ("breaks", "failure"),
    [
        (a_switched_line_reports_an_error, "GPIO: cannot switch .*: Input/output error"),
        (lines_are_taken_away_after_the_loop, "GPIO: cannot switch .*: Operation not permitted"),
        (a_driver_cannot_be_closed, "Bad file descriptor"),
        (lambda app: app.links.insert(0, FailingLink()), "a bug in a link's run"),
    ],
    ids=["control thread", "guard", "hardware", "link"],
)
def test_a_part_that_cannot_be_stopped_skips_no_other(
    config: Config, breaks: Callable[[App], None], failure: str
) -> None:
    app = App(config)
    breaks(app)
    with pytest.raises((HardwareError, OSError, ZeroDivisionError), match=failure):
        asyncio.run(run_until_it_turns(app))
    check_everything_stopped(app)


def test_a_guard_that_dies_ends_the_box(config: Config, caplog: pytest.LogCaptureFixture) -> None:
    app = App(config)
    rotor, world = app.station.rotor, world_of(app)
    assert isinstance(rotor, RelayRotor)

    def end_the_guard_alone() -> None:
        rotor._guard._stopping.set()
        for thread in threading.enumerate():
            if thread.name == GUARD_THREAD:
                thread.join(PATIENCE_S)
        rotor._guard._stopping.clear()

    async def run() -> None:
        task = asyncio.create_task(app.run(asyncio.Event()))
        await until(lambda: app.loop.status.azimuth.angle_deg is not None)
        app.console.order(Aim(200.0, None))
        await until(lambda: world.drives() != OFF)
        await asyncio.to_thread(end_the_guard_alone)
        await asyncio.wait_for(task, PATIENCE_S)

    with pytest.raises(HardwareError, match="the guard, which ends expired commands, has died"):
        asyncio.run(run())
    check_everything_stopped(app)
    assert "the control thread failed: the guard" in caplog.text


# --- twice


def test_everything_can_be_closed_twice(config: Config) -> None:
    app = App(config)
    asyncio.run(run_until_it_turns(app))

    async def again() -> None:
        for part in app._parts():
            await part.close()

    asyncio.run(again())
    check_everything_stopped(app)
