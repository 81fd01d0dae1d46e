"""How many functions of `rotator` one cycle of the control loop calls, and one order until a relay's line is set.

With simulated chips in simulated time, so that two runs count the same; the order comes through a real
pseudo-terminal. A comprehension counts as part of its function. `benchmarks.load` prints the figures.
"""

from __future__ import annotations

import asyncio
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from types import FrameType

import rotator
from firmware_sim.clock import SimClock
from rotator.assembly.links import build_links
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.monitor.tap import Tap
from rotator.runtime.loop import ControlLoop

ROOM = str(Path(rotator.__file__).parent)
ORDER = b"W235 025\r"
CYCLES = 20
"""One of them alone depends on how many readings lie in a window then."""
COMPREHENSIONS = ("<listcomp>", "<dictcomp>", "<setcomp>", "<genexpr>")

Calls = Counter[tuple[str, str]]
"""By file and function."""


def files(calls: Calls) -> int:
    return len({file for file, _ in calls})


@contextmanager
def _counted(calls: Calls) -> Iterator[None]:
    def note(frame: FrameType, event: str, _argument: object) -> None:
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(ROOM) and code.co_name not in COMPREHENSIONS:
            calls[code.co_filename[len(ROOM) + 1 :], code.co_qualname] += 1

    sys.setprofile(note)
    try:
        yield
    finally:
        sys.setprofile(None)


def counted() -> tuple[Calls, Calls, Calls]:
    """The calls of CYCLES cycles at rest; those of the order until it waits for the control thread; and from there
    until a relay's line is set."""
    with tempfile.TemporaryDirectory() as folder:
        return asyncio.run(_counted_box(Path(folder) / "gs232"))


async def _counted_box(pty: Path) -> tuple[Calls, Calls, Calls]:
    config = parse(f'[[link]]\nprotocol = "gs232b"\npty = "{pty}"\n', "benchmark")
    clock = SimClock(1000.0)
    station = Station(config, clock, clock.sleep, add_alarm=clock.add_alarm)
    assert station.world is not None
    loop = ControlLoop(build_controller(config), station.rotor, clock, 1 / config.control.rate_hz)
    cycle, order, relay = Calls(), Calls(), Calls()
    for count in range(20 * CYCLES):
        clock.sleep(1 / config.control.rate_hz)
        with _counted(cycle if count >= 19 * CYCLES else Calls()):
            loop.cycle()
    [link] = build_links(config.link, loop, build_mount(config), Tap(datetime.now, lambda: loop.status))
    await link.open()
    running = asyncio.create_task(link.run())
    port = os.open(pty, os.O_RDWR | os.O_NOCTTY)
    os.write(port, b"C2\r")
    while link.wire.count_in < 3:
        await asyncio.sleep(0.01)
    posted = asyncio.Event()
    loop.overhear(lambda _source, _order: posted.set())
    with _counted(order):
        os.write(port, ORDER)
        await posted.wait()
    edges = len(station.world.gpio.edges)
    with _counted(relay):
        while len(station.world.gpio.edges) == edges:
            loop.act()
    running.cancel()
    await asyncio.gather(running, return_exceptions=True)
    os.close(port)
    station.close()
    return cycle, order, relay
