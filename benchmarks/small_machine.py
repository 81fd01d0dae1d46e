"""The box on a fifth of a core: run `python -m benchmarks.small_machine [MINUTES]`, as root; 60 minutes unless told.

`--beside 3`: three processes that compile share that fifth. `--as-service`: with the unit's priorities.

The box runs as a process of its own, in real time, on its simulated station, under a quota of CPU time. A client
outside of the quota flies the shipped passes of real satellites, an order a second, asks once a second, jogs and stops.
Relay edges carry the time at which the simulated line changed. Each kind of rotor gets those minutes, one after the
other. Prints how soon a stop opens the relay, how late the cycles were, every fault, and what the box used of its
fifth.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import random
import resource
import select
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path

import tomlkit

from benchmarks.load import cpu_s
from benchmarks.quota import NoQuotaError, fifth_of_a_core
from benchmarks.stops import Stops, free_port, opened
from rotator.cli.box import RunningBox
from rotator.config.load import shipped
from rotator.rehearsal.passes import find_pass, shipped_names

KINDS = {"relay-pot": "simulated", "relay-pulse": "u100"}
"""Each kind of rotor with relays, by its shipped configuration."""
START_DEG = 225.0
HOMED = (f"confirm azimuth {START_DEG:g}", "confirm elevation 0")
DEAD_TIME_S = {"relay-pot": 0.05, "relay-pulse": 0.5}
JOG_S = 0.6
"""So long at least a jog lasts; with the motor's coast before it a relay has closed by then."""
STOP_EVERY = 10
"""A jog and a stop come each so many seconds."""
ANSWER_S = 30.0
NICE, RTTIME_US = -10, 500_000
"""LimitRTTIME of install/rotator.service, and the niceness whose share is that of its CPUWeight against one process."""
COMPILES = "s = open(__import__('argparse').__file__).read()\nwhile True: compile(s, 's', 'exec')"


@dataclass(frozen=True, slots=True)
class Result:
    """Of one run. Times in milliseconds."""

    stops: Stops
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

    def second(self, count: int, stop_every: int, orders: Iterator[str]) -> None:
        """A second of a pass: an order, a question; each `stop_every`-th a jog and a stop instead."""
        end_s = time.monotonic() + 1.0
        order = next(orders)
        if count % stop_every == stop_every - 1:
            self.send("R" if count // stop_every % 2 else "L")
            time.sleep(JOG_S + 0.1 * self._chance.random())
            self.stops_s.append(self.send("S"))
        else:
            self.send(order)
            self.ask()
        time.sleep(max(0.0, end_s - time.monotonic()))


def _as_service(pid: int) -> None:
    """Give a process that has just begun, and has no threads yet, what install/rotator.service gives the box."""
    resource.prlimit(pid, resource.RLIMIT_RTTIME, (RTTIME_US, RTTIME_US))
    os.setpriority(os.PRIO_PROCESS, pid, NICE)


@contextmanager
def _compiling(count: int, group: Path) -> Iterator[None]:
    """So many processes in the group, each of which compiles without a pause."""
    hogs = [subprocess.Popen([sys.executable, "-c", COMPILES]) for _ in range(count)]
    try:
        for hog in hogs:
            (group / "cgroup.procs").write_text(str(hog.pid))
        yield
    finally:
        for hog in hogs:
            hog.kill()
            hog.wait()


def measure(
    seconds: float,
    kind: str = "relay-pot",
    *,
    stop_every: int = STOP_EVERY,
    beside: int = 0,
    as_service: bool = False,
) -> Result:
    """`beside`: processes that compile in the same fifth. `as_service`: with the unit's priorities.

    Raises NoQuotaError.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        config = folder / "rotator.toml"
        config.write_text(_config(folder, kind))
        command = [sys.executable, "-m", "benchmarks.watched_box", str(config)]
        box = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        if as_service:
            _as_service(box.pid)
        try:
            while not (folder / "gs232").exists():
                if box.poll() is not None:
                    raise SystemExit("the box does not start")
                time.sleep(0.05)
            client = _Client(folder / "gs232")
            client.ask()
            if kind == "relay-pulse":  # a person says where it stands, as after homing
                _confirm(folder)
            orders = _passes()
            with fifth_of_a_core(box.pid) as group, _compiling(beside, group):
                before_s, started_s = cpu_s(box.pid), time.monotonic()
                for count in range(round(seconds)):
                    client.second(count, stop_every, orders)
                used = (cpu_s(box.pid) - before_s) / (time.monotonic() - started_s)
        finally:
            box.terminate()
            out, _ = box.communicate()
    told = json.loads(out)
    stops = opened(client.stops_s, told["edges"])
    return Result(stops, client.answers_ms, 1000 * told["late_s"], told["said"], used)


def _config(folder: Path, kind: str) -> str:
    """The shipped configuration on its simulated rotor, with one link, and no panel or switch to hold it."""
    values = tomllib.loads(shipped(KINDS[kind]))
    for table in ("panel", "limits", "lcd", "link"):
        values.pop(table, None)
    values.setdefault("rotor", {})["hardware"] = "sim"
    values.setdefault("relays", {})["dead_time_s"] = DEAD_TIME_S[kind]
    values |= {
        "link": [{"protocol": "gs232b", "pty": f"{folder}/gs232"}],
        "state": {"path": f"{folder}/state.json"},
        "page": {"listen": f"127.0.0.1:{free_port()}"},
    }
    values.setdefault("sim", {}).setdefault("azimuth", {})["start_deg"] = START_DEG
    return tomlkit.dumps(values)


def _confirm(folder: Path) -> None:
    with RunningBox(folder / "rotator.toml") as console:
        for words in HOMED:
            console.order(words)


def _passes() -> Iterator[str]:
    """The shipped passes one after the other, second by second, without end."""
    for name in cycle(shipped_names()):
        flown = find_pass(name)
        for t_s in range(round(flown.end_s)):
            azimuth_deg, elevation_deg = flown.at(t_s)
            yield f"W{round(azimuth_deg) % 360:03d} {max(0, round(elevation_deg)):03d}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("minutes", type=float, nargs="?", default=60.0, help="for each kind of rotor")
    parser.add_argument("--beside", type=int, default=0, help="processes that compile in the same fifth")
    parser.add_argument("--as-service", action="store_true", help="with the priorities of the service's unit")
    given = parser.parse_args()
    minutes: float = given.minutes
    for kind in KINDS:
        try:
            result = measure(60.0 * minutes, kind, beside=given.beside, as_service=given.as_service)
        except NoQuotaError as fault:
            raise SystemExit(str(fault)) from None
        _tell(kind, minutes, result)


def _tell(kind: str, minutes: float, result: Result) -> None:
    print(f"{kind}: {minutes:g} minutes on a fifth of a core, {100 * result.used:.1f} % of a core used")
    for name, values in (("S to relay off", result.stops.after_ms), ("C2 to its whole answer", result.answers_ms)):
        ranked = sorted(values) or [math.inf]
        p99_ms = ranked[int(0.99 * (len(ranked) - 1))]
        print(f"{name:24} median {statistics.median(ranked):6.2f} p99 {p99_ms:6.2f} worst {ranked[-1]:7.2f} ms")
    print(f"stops without effect: {result.stops.unmet} ({result.stops.idle} more had no relay to open)")
    print(f"latest cycle: {result.worst_late_ms:.0f} ms late")
    print(f"warnings and faults: {len(result.warnings)}", *result.warnings, sep="\n  ", flush=True)


if __name__ == "__main__":
    main()
