"""How soon the box answers and lets go, whatever else goes on: run `python -m benchmarks.running.busy [CASE ...]`.

A box in a process of its own, in real time, on a simulated I2C bus that takes a real bus's time, flies the shipped
passes: an order a second and a question, and now and then a jog and a stop, by `S` on the link or by STOP on the page.
Each case is another burden (`--list`). Edges of the relays carry the time at which the simulated line changed. Beside
the answers stand those of an asyncio server that sends a fixed one. The exit code is 1 where a limit of docs/page.md is
missed. Some cases need root: the kernel's quota of CPU time.
"""

from __future__ import annotations

import argparse
import asyncio
import http.client
import math
import os
import random
import resource
import statistics
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AsyncExitStack
from dataclasses import dataclass, field
from itertools import cycle
from pathlib import Path
from typing import Any

from benchmarks.running.beside import compiling, fixed_answers_ms, programs
from benchmarks.running.box import PATIENCE_S, Box
from benchmarks.running.browsers import browsers
from benchmarks.running.programs import Program, program
from benchmarks.running.quota import NoQuotaError, fifth_of_a_core
from benchmarks.running.words import ALL, STATION
from benchmarks.sky_now import as_json, crowd
from rotator.config.load import shipped
from rotator.orbits.earth import Site
from rotator.rehearsal.passes import find_pass, shipped_names

PROFILES = {"relay-pot": "simulated", "relay-pulse": "u100"}
"""Each kind of rotor with relays, by its shipped configuration."""
START_DEG = 225.0
HOMED = (f"confirm azimuth {START_DEG:g}", "confirm elevation 0")
DEAD_TIME_S = {"relay-pot": 0.05, "relay-pulse": 0.5}
JOG_S = 0.6
"""So long at least a jog lasts; with the motor's coast before it a relay has closed by then."""
IN_VAIN_S = 5.0
"""A relay that opens later has not opened for this stop."""
SATELLITES = 60
"""Over it in the case of browsers."""
NICE, RTTIME_US = -10, 500_000
"""LimitRTTIME of install/rotator.service, and the niceness whose share is that of its CPUWeight against one process."""
LATE_MS, CORE, MORE_MS, WORST_MORE_MS, LEAST_HZ = 10.0, 0.15, 1.0, 10.0, 9.5
"""Limits: of a late cycle (p99), of a core, of how much later a stop comes than alone, and of pictures a second."""


@dataclass(frozen=True, slots=True)
class Case:
    """What goes on beside."""

    told: str
    display: bool = False
    programs: int = 0
    browsers: int = 0
    fifth: bool = False
    compilers: int = 0
    as_service: bool = False

    @property
    def ways(self) -> tuple[str, ...]:
        return ("S",) if self.fifth else ("S", "STOP")


CASES = {
    "alone": Case("nothing else"),
    "display": Case("the display is written all the time", display=True),
    "programs": Case("a hundred rotctld programs ask ten times a second, and one never reads", programs=100),
    "browsers": Case("fifty browsers look on", browsers=50),
    "fifth": Case("on a fifth of a core", fifth=True),
    "compilers": Case("three processes compile in the same fifth", fifth=True, compilers=3),
    "service": Case("the same, with the priorities of the service", fifth=True, compilers=3, as_service=True),
}


@dataclass(slots=True)
class Stops:
    after_ms: list[float] = field(default_factory=list)
    """From the last byte of each stop to the relay's line."""
    unmet: int = 0
    """Stops after which a closed relay did not open."""
    idle: int = 0
    """Stops that came before the jog had closed a relay."""


def opened(sent_s: Iterable[float], edges: Sequence[tuple[float, int, bool]]) -> Stops:
    stops = Stops()
    for at_s in sent_s:
        if not any({pin: on for edge_s, pin, on in edges if edge_s < at_s}.values()):
            stops.idle += 1
            continue
        off_s = min((edge_s for edge_s, _, on in edges if edge_s >= at_s and not on), default=math.inf)
        if off_s - at_s < IN_VAIN_S:
            stops.after_ms.append(1000 * (off_s - at_s))
        else:
            stops.unmet += 1
    return stops


@dataclass(frozen=True, slots=True)
class Figures:
    stops: dict[str, Stops]
    """By their way."""
    answers_ms: list[float]
    late_ms: list[float]
    core: float
    memory_mib: float
    said: list[str]
    rate_hz: float = math.inf
    """The fewest pictures a second that a browser got."""
    failed: tuple[str, ...] = ()
    """Of browsers."""


async def measure(case: Case, seconds: int, kind: str = "relay-pot", *, stop_every: int = 10) -> Figures:
    """Raises NoQuotaError."""
    with tempfile.TemporaryDirectory() as folder:
        links = [each for each in ALL if each.protocol in ("gs232b", "rotctld")]
        box = Box(Path(folder), tables(kind) | (_sky(Path(folder)) if case.browsers else {}), links)
        try:
            # It has no threads yet.
            urgent_us = RTTIME_US if case.as_service else resource.RLIM_INFINITY
            resource.prlimit(box.process.pid, resource.RLIMIT_RTTIME, (urgent_us, resource.RLIM_INFINITY))
            if case.as_service:
                os.setpriority(os.PRIO_PROCESS, box.process.pid, NICE)
            await box.answers()
            if kind == "relay-pulse":  # a person says where it stands, as after homing
                await box.says(*HOMED)
            if case.display:
                await box.asked("write")
            async with AsyncExitStack() as beside:
                if case.fifth:
                    group = beside.enter_context(fifth_of_a_core(box.process.pid))
                    beside.enter_context(compiling(case.compilers, group))
                asking = await beside.enter_async_context(programs(box.ports["rotctld"], case.programs))
                crowd = await beside.enter_async_context(browsers(box.page_port, case.browsers))
                await box.asked("seen")
                used_s, began_s = box.cpu_s, time.monotonic()
                sent_s, answers_ms = await _fly(box, seconds, stop_every, case.ways)
                core = (box.cpu_s - used_s) / (time.monotonic() - began_s)
                seen, memory_mib = await box.asked("seen"), box.private_kib / 1024
                rate_hz = min((each.rate_hz() for each in crowd), default=math.inf)
        finally:
            await box.stop()
    edges = [(at_s, pin, on) for at_s, pin, on in seen["edges"]]
    return Figures(
        {way: opened(moments_s, edges) for way, moments_s in sent_s.items()},
        asking or answers_ms,
        seen["late_ms"],
        core,
        memory_mib,
        seen["said"],
        rate_hz,
        tuple(fault for each in crowd for fault in each.failed),
    )


def tables(kind: str) -> dict[str, Any]:
    """The shipped configuration on its simulated rotor, with no panel or switch to hold it."""
    values = tomllib.loads(shipped(PROFILES[kind]))
    for table in ("panel", "limits", "link"):
        values.pop(table, None)
    values.setdefault("rotor", {})["hardware"] = "sim"
    values.setdefault("relays", {})["dead_time_s"] = DEAD_TIME_S[kind]
    values.setdefault("sim", {}).setdefault("azimuth", {})["start_deg"] = START_DEG
    return values | {"lcd": {"kind": "pcf8574"}}


def _sky(folder: Path) -> dict[str, Any]:
    """What the box needs to show the sky: a place, and as many satellites over it as it shows at once."""
    sets = crowd(time.time(), SATELLITES, Site(STATION["latitude_deg"], STATION["longitude_deg"]))
    (folder / "up.json").write_text(as_json(sets), encoding="utf-8")
    return {"station": STATION, "sky": {"elements": [f"{folder}/up.json"]}}


async def _fly(
    box: Box, seconds: int, stop_every: int, ways: Sequence[str]
) -> tuple[dict[str, list[float]], list[float]]:
    """The moments of the stops by their way, and how long each answer took."""
    sent_s: dict[str, list[float]] = {way: [] for way in ways}
    answers_ms: list[float] = []
    orders, turn, chance = _passes(), cycle(("R", "L")), random.Random(1)
    by_turns = cycle(ways)
    async with program(box, "gs232b") as hand:
        for second in range(seconds):
            ends_s = time.monotonic() + 1.0
            if second % stop_every == stop_every - 1:
                hand.send(f"{next(turn)}\r".encode())
                await asyncio.sleep(JOG_S + 0.1 * chance.random())
                way = next(by_turns)
                sent_s[way].append(await _stop(box, hand, way))
            else:
                hand.send(next(orders))
                answers_ms.append(await _asked_ms(hand))
            await asyncio.sleep(max(0.0, ends_s - time.monotonic()))
    return sent_s, answers_ms


async def _asked_ms(hand: Program) -> float:
    began_s = time.monotonic()
    if not await hand.hears(PATIENCE_S):
        raise SystemExit("the box does not answer")
    return 1000 * (time.monotonic() - began_s)


async def _stop(box: Box, hand: Program, way: str) -> float:
    """Returns when it was sent. A stop on the page is released again."""
    if way == "S":
        sent_s = time.monotonic()
        hand.send(b"S\r")
        return sent_s
    sent_s = await asyncio.to_thread(_press_stop, box.page_port)
    await box.says("resume")
    return sent_s


def _press_stop(port: int) -> float:
    sent_s = time.monotonic()
    page = http.client.HTTPConnection("127.0.0.1", port)
    page.request("POST", "/api/stop")
    assert page.getresponse().status == 200
    page.close()
    return sent_s


def _passes() -> Iterator[bytes]:
    """The shipped passes one after the other, second by second, without end."""
    for name in cycle(shipped_names()):
        flown = find_pass(name)
        for t_s in range(round(flown.end_s)):
            azimuth_deg, elevation_deg = flown.at(t_s)
            yield b"W%03d %03d\r" % (round(azimuth_deg) % 360, max(0, round(elevation_deg)))


def told(values: Sequence[float]) -> str:
    """Median, p99 and worst."""
    ranked = sorted(values)
    return (
        f"{statistics.median(ranked):.2f}, {ranked[int(0.99 * (len(ranked) - 1))]:.2f}, {ranked[-1]:.2f}"
        if ranked
        else "–"
    )


def missed(its: Figures, alone: Figures) -> Iterator[str]:
    """The limits of docs/page.md that are not kept."""
    if statistics.quantiles(its.late_ms, n=100)[98] > LATE_MS:
        yield f"a cycle more than {LATE_MS:g} ms late (p99)"
    if its.core > CORE:
        yield f"more than {CORE:.0%} of a core"
    for way, stops in its.stops.items():
        before_ms, now_ms = alone.stops[way].after_ms, stops.after_ms
        later_ms = statistics.median(now_ms) - statistics.median(before_ms)
        if later_ms > MORE_MS or max(now_ms) > max(before_ms) + WORST_MORE_MS:
            yield f"{way} opens the relay later than alone"
    if its.rate_hz < LEAST_HZ:
        yield f"{its.rate_hz:.1f} pictures a second"
    yield from its.failed


async def main(names: Sequence[str], seconds: int, kind: str) -> int:
    print("median, p99, worst | `S` to relay, ms | STOP, ms | answer, ms | cycle late, ms | of a core | MiB | said")
    print("--|--|--|--|--|--|--|--")
    for count in (1, 100):
        print(f"a fixed answer for {count} | | | {told(await fixed_answers_ms(count, 10.0))}", flush=True)
    failed: list[str] = []
    alone: Figures | None = None
    for name in names:
        its = await measure(CASES[name], seconds, kind)
        alone = alone or its
        stops = [its.stops.get(way, Stops()) for way in ("S", "STOP")]
        cells = [*(told(each.after_ms) for each in stops), told(its.answers_ms), told(its.late_ms)]
        print(
            CASES[name].told, *cells, f"{its.core:.1%}", f"{its.memory_mib:.1f}", len(its.said), sep=" | ", flush=True
        )
        print("".join(f"    {line}\n" for line in its.said), end="")
        if unmet := sum(each.unmet for each in stops):
            failed.append(f"{name}: {unmet} stops without effect")
        if name == "browsers":
            failed += [f"{name}: {each}" for each in missed(its, alone)]
    print(*(f"missed: {each}" for each in failed), sep="\n")
    return int(bool(failed))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}; without any, the first four")
    parser.add_argument("--seconds", type=int, default=120, help="for each case")
    parser.add_argument("--kind", choices=list(PROFILES), default="relay-pot")
    given = parser.parse_args()
    try:
        sys.exit(asyncio.run(main(given.cases or list(CASES)[:4], given.seconds, given.kind)))
    except NoQuotaError as fault:
        sys.exit(str(fault))
