"""A box as a process of its own, in real time, that keeps what its relays' lines did.

`python -m benchmarks.watched_box CONFIG` runs the box of that file until SIGTERM, and then prints one JSON object: the
edges of the relays' lines by the machine's clock, the latest control cycle, and every line of the log from warnings up.
The simulated rotor is the one that the file names.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import logging
from collections.abc import Mapping
from pathlib import Path

from benchmarks.stops import Edge
from rotator.box.app import App
from rotator.config.load import load
from rotator.runtime.signals import SignalThread

LOOK_S = 0.05


class Said(logging.Handler):
    """Keeps the log."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())


async def main(config: Path) -> None:
    said = Said()
    logging.getLogger().addHandler(said)
    app = App(load(config))
    assert app.station.world is not None
    relays = app.config.relays
    pins = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
    edges: list[Edge] = []
    late_s = [0.0]

    def note(at_s: float, changes: Mapping[int, bool]) -> None:
        edges.extend((at_s, pin, changes[pin]) for pin in pins if pin in changes)

    async def watch() -> None:
        while True:
            late_s[0] = max(late_s[0], app.loop.status.cycle_late_s)
            await asyncio.sleep(LOOK_S)

    app.station.world.gpio.on_edges.append(note)
    stop, loop = asyncio.Event(), asyncio.get_running_loop()
    watcher = asyncio.create_task(watch())

    def ended() -> None:
        loop.call_soon_threadsafe(stop.set)

    with SignalThread(ended):
        await app.run(stop)
    watcher.cancel()
    print(json.dumps({"edges": edges, "late_s": late_s[0], "said": said.lines}))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("config", type=Path)
    asyncio.run(main(parser.parse_args().config))
