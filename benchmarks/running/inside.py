"""`rotator` as a user starts it, with one more thread that looks at the box and answers questions about it.

Run as `python -m benchmarks.running.inside SOCKET run --config FILE`. Each connection to the Unix socket SOCKET asks
one word, and is answered with one line of JSON. `seen`: what happened since the last time: the edges of the relays'
lines, how late each control cycle was, the log. `held`: what the process holds after a garbage collection, and what is
true in the simulated world. `write`: from now on the display is written all the time, the most that a bus carries.
"""

from __future__ import annotations

import asyncio
import gc
import json
import logging
import socket
import sys
import threading
from collections.abc import Iterator, Mapping
from itertools import count
from typing import Any

from rotator.__main__ import main as rotator
from rotator.box.app import App

PROBE = "probe"
"""The first word in the names of the threads that are not the box's own."""
LOOK_S = 0.01


class Probe(logging.Handler):
    """Looks at a box from when it begins to run in this event loop."""

    def __init__(self, app: App, events: asyncio.AbstractEventLoop) -> None:
        super().__init__(logging.WARNING)
        self._app, self._events = app, events
        assert self._app.station.world is not None, "it is simulated"
        self._world = self._app.station.world
        self._edges: list[tuple[float, int, bool]] = []
        self._late_ms: dict[float, float] = {}
        self._said: list[str] = []
        relays = self._app.config.relays
        self._pins = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
        self._world.gpio.on_edges.append(self._note)
        self.setFormatter(logging.Formatter("%(levelname).1s %(message)s"))
        logging.getLogger().addHandler(self)
        threading.Thread(target=self._watch, name=f"{PROBE} watch", daemon=True).start()

    def emit(self, record: logging.LogRecord) -> None:
        self._said.append(self.format(record))

    def _note(self, at_s: float, changes: Mapping[int, bool]) -> None:
        self._edges.extend((at_s, pin, changes[pin]) for pin in self._pins if pin in changes)

    def _watch(self) -> None:
        pause = threading.Event()
        while not pause.wait(LOOK_S):
            status = self._app.loop.status
            self._late_ms[status.at_s] = 1000 * status.cycle_late_s

    def seen(self) -> dict[str, Any]:
        edges, self._edges = self._edges, []
        late_ms, self._late_ms = self._late_ms, {}
        said, self._said = self._said, []
        return {"edges": edges, "late_ms": list(late_ms.values()), "said": said}

    def held(self) -> dict[str, Any]:
        gc.collect()
        world, names = self._world, (thread.name for thread in threading.enumerate())
        return {
            "threads": sorted(name for name in names if not name.startswith(PROBE)),
            "tasks": len(asyncio.all_tasks(self._events)),
            "blocks": sys.getallocatedblocks(),
            "antenna_deg": world.antenna(),
            "drives": world.drives(),
            "relay_starts": world.relay_starts,
            "shorted_s": world.shorted_s,
        }

    def write(self) -> dict[str, Any]:
        threading.Thread(target=self._keep_writing, name=f"{PROBE} write", daemon=True).start()
        return {}

    def _keep_writing(self) -> None:
        assert self._app.station.display is not None
        for number in count():
            self._app.station.display.show((f"row {number}", f"row {number}"))


def questions(place: str) -> Iterator[tuple[socket.socket, str]]:
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(place)
    listener.listen()
    while True:
        connection, _ = listener.accept()
        with connection:
            yield connection, connection.recv(100).decode()


def answer_all(place: str, probe: Probe) -> None:
    for connection, word in questions(place):
        answers = {"seen": probe.seen, "held": probe.held, "write": probe.write}
        connection.sendall(json.dumps(answers[word]()).encode() + b"\n")


def main() -> None:
    place, *command = sys.argv[1:]
    runs = App.run

    async def probed(app: App, stop: asyncio.Event) -> None:
        probe = Probe(app, asyncio.get_running_loop())
        threading.Thread(target=answer_all, args=(place, probe), name=PROBE, daemon=True).start()
        await runs(app, stop)

    App.run = probed  # type: ignore[method-assign, assignment]
    sys.argv = ["rotator", *command]
    rotator()


if __name__ == "__main__":
    main()
