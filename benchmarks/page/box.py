"""The box that is measured: as in `rotator run`, in real time, on a simulated G-5500, beside a pass made for now.

Knows the control loop, the simulated relays, and what this process takes of the computer. Judges nothing.
"""

from __future__ import annotations

import asyncio
import resource
import socket
import statistics
import sys
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

from benchmarks.fuzz_box import free_port
from benchmarks.sky_now import as_json, satellite, sets_in
from rotator.box.app import App
from rotator.config.load import load
from rotator.exchange.orders import Aim, Release
from rotator.exchange.sources import Source
from rotator.orbits.earth import Site

ROTOR = """
[state]
path = "{folder}/state.json"
[page]
listen = "127.0.0.1:{page}"
[[link]]
protocol = "gs232b"
tcp = "127.0.0.1:{link}"
[station]
locator = "JO62qm"
[sky]
elements = ["{folder}/made.json"]
"""
SITE = Site(52.52, 13.375, 0.0)
NAME = "MADE"
LOOK_S = 0.02
PATIENCE_S = 60.0
HAND = Source("console")


@dataclass(frozen=True, slots=True)
class Figures:
    """Of one minute, and of the stops after it."""

    late_p99_ms: float
    core_percent: float
    link_ms: list[float]
    """From `S` on the link to the relay."""
    page_ms: list[float]
    """From STOP on the page to the relay."""
    memory_mib: float


class MeasuredBox:
    def __init__(self, app: App, config: Path, finger: asyncio.subprocess.Process) -> None:
        assert app.station.world is not None, "it is simulated"
        self._app = app
        self._world = app.station.world
        self._config = config
        self._finger = finger
        self.url = f"http://{app.config.page.listen}"

    async def figures(self, lasts_s: float, stops: int) -> Figures:
        await self._track()
        late_ms: dict[float, float] = {}
        begin_s, used_s = time.monotonic(), _used_s()
        while (now_s := time.monotonic()) < begin_s + lasts_s:
            status = self._app.loop.status
            late_ms[status.at_s] = 1000.0 * status.cycle_late_s
            await asyncio.sleep(LOOK_S)
        core_percent = 100.0 * (_used_s() - used_s) / (now_s - begin_s)
        link_ms, page_ms = [[await self._stop_ms(way) for _ in range(stops)] for way in ("S", "POST")]
        late_p99_ms = statistics.quantiles(late_ms.values(), n=100)[98]
        return Figures(late_p99_ms, core_percent, link_ms, page_ms, memory_mib())

    async def turns(self) -> None:
        """The antenna turns, far from any target."""
        self._app.loop.post(HAND, Release())
        far_deg = 50.0 if (self._app.loop.status.azimuth.angle_deg or 0.0) > 150.0 else 250.0
        self._app.loop.post(HAND, Aim(far_deg, 20.0))
        async with asyncio.timeout(PATIENCE_S):
            while self._world.drives() == (0, 0):
                await asyncio.sleep(0.01)

    def opens(self) -> asyncio.Future[float]:
        """The moment at which no relay is closed any more, on the clock of the loop."""
        loop = asyncio.get_running_loop()
        opened: asyncio.Future[float] = loop.create_future()

        def see(now_s: float, _changes: object) -> None:
            if self._world.drives() == (0, 0):
                loop.call_soon_threadsafe(lambda: None if opened.done() else opened.set_result(now_s))

        self._world.gpio.on_edges.append(see)
        opened.add_done_callback(lambda _: self._world.gpio.on_edges.remove(see))
        return opened

    async def _track(self) -> None:
        self._app.loop.post(HAND, Release())
        command = (sys.executable, "-m", "rotator", "tell", "--config", str(self._config), "track", NAME)
        asked = await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.DEVNULL)
        assert await asked.wait() == 0, "the box tracks it"
        async with asyncio.timeout(PATIENCE_S):
            while self._app.loop.status.flown is None:
                await asyncio.sleep(LOOK_S)

    async def _stop_ms(self, way: str) -> float:
        await self.turns()
        opened = self.opens()
        assert self._finger.stdin is not None
        assert self._finger.stdout is not None
        self._finger.stdin.write(f"{way}\n".encode())
        sent_s = float(await self._finger.stdout.readline())
        return 1000.0 * (await asyncio.wait_for(opened, PATIENCE_S) - sent_s)


@asynccontextmanager
async def measured_box(folder: str, lasts_s: float) -> AsyncIterator[MeasuredBox]:
    """`lasts_s`: for so long the satellite is up."""
    ports = free_port(), free_port()
    up = satellite(NAME, 90_001, time.time(), SITE, sets_in(time.time(), lasts_s))
    Path(folder, "made.json").write_text(as_json([up]), encoding="utf-8")
    config = Path(folder, "r.toml")
    config.write_text(ROTOR.format(folder=folder, page=ports[0], link=ports[1]), encoding="utf-8")
    app, stop = App(load(config), config), asyncio.Event()
    box = asyncio.create_task(app.run(stop))
    for port in ports:
        await _listens(port)
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-m", "benchmarks.page.finger", *map(str, ports))
    finger = await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe)
    try:
        yield MeasuredBox(app, config, finger)
    finally:
        finger.kill()
        await finger.wait()
        stop.set()
        await box


async def _listens(port: int) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while True:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    return
            await asyncio.sleep(LOOK_S)


def _used_s() -> float:
    """Seconds of a core, with those of what the box has computed in processes of its own."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in used)


def memory_mib() -> float:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 2**20
