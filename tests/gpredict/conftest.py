"""Debian's Gpredict, a virtual screen and the box for the tests of this folder: `make test-gpredict` runs them.

Knows how the parts are put together. Gpredict and its keys are in `window`, its satellite in `sky`, the wire in `tap`.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from rotator.box.app import App
from rotator.config.load import parse
from tests.boxes import free_port
from tests.foreign.conftest import start_box
from tests.gpredict.sky import Satellite, Station
from tests.gpredict.tap import Tap, tapped
from tests.gpredict.window import Gpredict, gpredict, screen, until, write_files

__all__ = ["start_box"]

HOME = Station(latitude_deg=50.0, longitude_deg=10.0)
OFF = (0, 0)
ENGLISH = {"LC_ALL": "C.UTF-8"}


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Only where they are asked for by name: they take more than a minute."""
    asked = any("tests/gpredict" in argument for argument in config.args)
    return None if asked or collection_path == Path(__file__) else True


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--picture", metavar="FILE.png", help="keep a picture of Gpredict tracking; needs imagemagick")


@pytest.fixture
def picture(request: pytest.FixtureRequest) -> Path | None:
    file = request.config.getoption("--picture")
    return file and Path(file).absolute()


@pytest.fixture
def start_gpredict(
    need_program: Callable[[str, str], str], tmp_path: Path
) -> Iterator[Callable[..., tuple[Gpredict, Tap]]]:
    """Gpredict with one satellite and one rotator, and a tap on the wire from there to the box's rotctld port."""
    for program, package in (("gpredict", "gpredict"), ("Xvfb", "xvfb"), ("xdotool", "xdotool")):
        need_program(program, package)
    with ExitStack() as running:

        def start(satellite: Satellite, port: int, language: Mapping[str, str] = ENGLISH) -> tuple[Gpredict, Tap]:
            tap = running.enter_context(tapped(port))
            write_files(tmp_path, HOME, satellite, tap.port)
            desk = running.enter_context(screen())
            return running.enter_context(gpredict(desk, tmp_path, language)), tap

        yield start


@dataclass(slots=True)
class WatchedBox:
    """The whole box in this process, with a record of every change of its motor relays."""

    app: App
    rotctld_port: int
    gs232_port: int
    drives: list[tuple[float, tuple[int, int]]] = field(default_factory=list)
    """When (on the clock of time.monotonic), and the two axes' drives from then on."""

    @property
    def driving(self) -> tuple[int, int]:
        return self.drives[-1][1] if self.drives else OFF

    @property
    def angles_deg(self) -> tuple[float | None, float | None]:
        status = self.app.loop.status
        return status.azimuth.angle_deg, status.elevation.angle_deg

    @property
    def faulty(self) -> bool:
        return bool(self.app.loop.status.faults)

    def off_since_s(self) -> float:
        """When the last motor went off. Waits for it."""
        until(lambda: self.driving == OFF, "the motors run on")
        return self.drives[-1][0]


@pytest.fixture
def watched_box(tmp_path: Path) -> Iterator[Callable[[str], WatchedBox]]:
    """A simulated station of the given rotor, running until the test's end; then every relay is off."""
    with ExitStack() as running:

        def start(rotor: str) -> WatchedBox:
            ports = free_port(), free_port()
            links = "".join(
                f'[[link]]\nprotocol = "{protocol}"\ntcp = "127.0.0.1:{port}"\n'
                for protocol, port in zip(("rotctld", "gs232b"), ports, strict=True)
            )
            box = WatchedBox(App(parse(f'{rotor}\n[state]\npath = "{tmp_path}/state.json"\n{links}', "test")), *ports)
            running.enter_context(_running(box))
            return box

        yield start


@contextmanager
def _running(box: WatchedBox) -> Iterator[None]:
    world = box.app.station.world
    assert world is not None

    def see(_now_s: float, _changes: Mapping[int, bool]) -> None:
        if world.drives() != box.driving:
            box.drives.append((time.monotonic(), world.drives()))

    world.gpio.on_edges.append(see)
    loops: list[asyncio.AbstractEventLoop] = []
    stop = asyncio.Event()

    async def run() -> None:
        loops.append(asyncio.get_running_loop())
        await box.app.run(stop)

    with ThreadPoolExecutor(1) as thread:
        running = thread.submit(asyncio.run, run())
        try:
            until(
                lambda: running.done() or all(link.wire.state != "closed" for link in box.app.links),
                "the links do not open",
            )
            yield
        finally:
            if not running.done():
                loops[0].call_soon_threadsafe(stop.set)
            running.result()
    assert world.drives() == OFF
