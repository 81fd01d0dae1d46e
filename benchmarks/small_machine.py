"""The box on a fifth of a core: run `python -m benchmarks.small_machine [MINUTES]`, as root; 60 minutes unless told.

The box runs as a process of its own, in real time, on its simulated station, under a quota of CPU time. A client
outside of the quota tracks a moving target once a second, asks once a second, jogs and stops. Relay edges carry the
time at which the simulated line changed. Prints how soon a stop opens the relay, how late the cycles were, every fault,
and what the box used of its fifth.
"""

from __future__ import annotations

import json
import os
import random
import select
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import tty
from dataclasses import dataclass
from pathlib import Path

from benchmarks.quota import NoQuotaError, fifth_of_a_core

CONFIG = """
[[link]]
protocol = "gs232b"
pty = "{folder}/gs232"
[state]
path = "{folder}/state.json"
[page]
listen = "127.0.0.1:{port}"
[relays]
dead_time_s = 0.05
[sim.azimuth]
start_deg = 225
"""
BOX = """
import asyncio, json, logging, sys
from pathlib import Path
from rotator.app import App
from rotator.config.load import load
from rotator.runtime.signals import SignalThread

class Counted(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.lines = []
    def emit(self, record):
        self.lines.append(record.getMessage())

async def main():
    said = Counted()
    logging.getLogger().addHandler(said)
    app = App(load(Path(sys.argv[1])))
    gpio, relays = app.station.world.gpio, app.config.relays
    edges, late_s = [], []
    def note(at_s, changes):
        edges.extend((at_s, pin, changes[pin]) for pin in (relays.azimuth_cw, relays.azimuth_ccw) if pin in changes)
    gpio.on_edges.append(note)
    stop, loop = asyncio.Event(), asyncio.get_running_loop()
    async def watch():
        while True:
            late_s.append(app.loop.status.cycle_late_s)
            await asyncio.sleep(0.05)
    watcher = asyncio.create_task(watch())
    with SignalThread(lambda: loop.call_soon_threadsafe(stop.set)):
        await app.run(stop)
    watcher.cancel()
    print(json.dumps({"edges": edges, "late_s": max(late_s), "said": said.lines}))

asyncio.run(main())
"""
STOP_EVERY_S = 10.0
ANSWER_S = 5.0


@dataclass(frozen=True, slots=True)
class Result:
    """Of one run. Times in milliseconds."""

    stops_ms: list[float]
    """From the last byte of S to the relay's line."""
    unmet: int
    """Stops after which a relay that was closed did not open within a second."""
    idle: int
    """Stops that came before the jog had closed a relay: it first waits until the axis stands."""
    answers_ms: list[float]
    """From C2 to its whole answer, as the client saw it."""
    worst_late_ms: float
    """The latest control cycle."""
    warnings: list[str]
    """Everything that the box logged, from warnings up."""
    used: float
    """Its share of a core."""


class _Client:
    def __init__(self, path: Path) -> None:
        self._fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._fd)
        self._chance = random.Random(1)
        self.answers_ms: list[float] = []
        self.stops_s: list[float] = []

    def send(self, command: str) -> float:
        sent_s = time.monotonic()
        os.write(self._fd, f"{command}\r".encode())
        return sent_s

    def ask(self) -> None:
        sent_s, reply = self.send("C2"), b""
        while not reply.endswith(b"\n"):
            if not select.select([self._fd], [], [], ANSWER_S)[0]:
                raise SystemExit("the box does not answer")
            reply += os.read(self._fd, 256)
        self.answers_ms.append(1000 * (time.monotonic() - sent_s))

    def second(self, count: int) -> None:
        """A second of tracking: an order, a question; every STOP_EVERY_S a jog and a stop instead."""
        end_s = time.monotonic() + 1.0
        if count % STOP_EVERY_S == STOP_EVERY_S - 1:
            self.send("R" if count % 20 < STOP_EVERY_S else "L")
            time.sleep(0.5 + 0.1 * self._chance.random())
            self.stops_s.append(self.send("S"))
        else:
            self.send(f"W{(225 + count % 60) % 360:03d} {15 + count % 60 // 2:03d}")
            self.ask()
        time.sleep(max(0.0, end_s - time.monotonic()))


def measure(seconds: float) -> Result:
    """Raises NoQuotaError."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        config = folder / "rotator.toml"
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        config.write_text(CONFIG.format(folder=folder, port=port))
        box = subprocess.Popen([sys.executable, "-c", BOX, str(config)], stdout=subprocess.PIPE, text=True)
        try:
            while not (folder / "gs232").exists():
                if box.poll() is not None:
                    raise SystemExit("the box does not start")
                time.sleep(0.05)
            client = _Client(folder / "gs232")
            client.ask()
            with fifth_of_a_core(box.pid):
                before_s, started_s = _cpu_s(box.pid), time.monotonic()
                for count in range(round(seconds)):
                    client.second(count)
                used = (_cpu_s(box.pid) - before_s) / (time.monotonic() - started_s)
        finally:
            box.terminate()
            out, _ = box.communicate()
    told = json.loads(out)
    edges: list[tuple[float, int, bool]] = told["edges"]
    met = [sent_s for sent_s in client.stops_s if _closed(edges, sent_s)]
    after_ms = [
        min((1000 * (at_s - sent_s) for at_s, _, on in edges if at_s >= sent_s and not on), default=1e9)
        for sent_s in met
    ]
    stops_ms = [wait_ms for wait_ms in after_ms if wait_ms < 1000]
    missed, idle = len(after_ms) - len(stops_ms), len(client.stops_s) - len(met)
    return Result(stops_ms, missed, idle, client.answers_ms, 1000 * told["late_s"], told["said"], used)


def _closed(edges: list[tuple[float, int, bool]], now_s: float) -> bool:
    """Whether a relay was closed then."""
    levels = {pin: on for at_s, pin, on in edges if at_s < now_s}
    return any(levels.values())


def _cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    try:
        result = measure(60.0 * minutes)
    except NoQuotaError as fault:
        raise SystemExit(str(fault)) from None
    print(f"{minutes:g} minutes on a fifth of a core, {100 * result.used:.1f} % of a core used")
    for name, values in (("S to relay off", result.stops_ms), ("C2 to its whole answer", result.answers_ms)):
        ranked = sorted(values)
        p99_ms = ranked[int(0.99 * (len(ranked) - 1))]
        print(f"{name:24} median {statistics.median(ranked):6.2f} p99 {p99_ms:6.2f} worst {ranked[-1]:7.2f} ms")
    print(f"stops without effect: {result.unmet} ({result.idle} had no relay to open)")
    print(f"latest cycle: {result.worst_late_ms:.0f} ms late")
    print(f"warnings and faults: {len(result.warnings)}", *result.warnings, sep="\n  ")


if __name__ == "__main__":
    main()
