"""Passes for a day, one after the other, in simulated time and in this one process: its memory must stay flat.

The box is a rehearsal's: protocol, controller, drivers and simulated chips. Orders come once a second as from a
tracking program, and every third pass is stopped half way. Read after each simulated hour: memory that is the
process's own, and Python's blocks.
"""

from __future__ import annotations

import gc
import random
import sys
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.soak.crowd import FLIGHTS
from firmware_sim.clock import SimClock
from rotator.config.load import parse
from rotator.exchange.orders import Stop
from rotator.exchange.sources import Source
from rotator.rehearsal.plants import BoxPlant

HOUR_S = 3600.0
PAUSE_S = 60.0
MOST_KIB_PER_H = 1024.0
SETTLES = 6
"""Readings, one an hour, until every table of the process is filled; half of them where there are fewer than twelve."""
AFTER_STOP_S = 2.0


@dataclass
class Flown:
    kib: list[int] = field(default_factory=list)
    """Private memory after each simulated hour."""
    blocks: list[int] = field(default_factory=list)
    passes: int = 0
    relay_starts: int = 0
    found: list[str] = field(default_factory=list)

    def growth_per_h(self, values: list[int]) -> float:
        settled = _settled(values)
        return (settled[-1] - settled[0]) / max(1, len(settled) - 1)


def soak(hours: float, seed: int) -> Flown:
    chance, flown = random.Random(seed), Flown()
    clock = SimClock()
    plant = BoxPlant(parse("", "soak"), clock, (180.0, 0.0), "gs232")
    read_s = HOUR_S
    while clock() < hours * HOUR_S:
        _fly(plant, clock, chance, flown)
        while clock() >= read_s:
            read_s += HOUR_S
            gc.collect()
            flown.kib.append(_private_kib())
            flown.blocks.append(sys.getallocatedblocks())
            print(f"{clock() / HOUR_S:5.1f} h  {flown.kib[-1]} KiB  {flown.blocks[-1]} blocks", file=sys.stderr)
    flown.relay_starts = plant.relay_starts() or 0
    if plant.world.shorted_s:
        flown.found.append(f"both directions of a motor had current for {plant.world.shorted_s} s")
    if plant.status.faults:
        flown.found.append(f"faults: {plant.status.faults}")
    if not flown.kib:
        return flown
    if (growth := flown.growth_per_h(flown.kib)) > MOST_KIB_PER_H:
        flown.found.append(f"memory grew by {growth:.0f} KiB an hour")
    return flown


def _fly(plant: BoxPlant, clock: SimClock, chance: random.Random, flown: Flown) -> None:
    flight, began_s = chance.choice(FLIGHTS), clock()
    flown.passes += 1
    stops_s = flight.end_s / 2 if flown.passes % 3 == 0 else flight.end_s
    while (at_s := clock() - began_s) < stops_s:
        azimuth_deg, elevation_deg = flight.at(at_s)
        plant.order(azimuth_deg, max(0.0, elevation_deg))
        plant.run_until(clock() + 1.0)
    plant.post(Source("console"), Stop())
    plant.run_until(clock() + AFTER_STOP_S)
    if plant.world.drives() != (0, 0):
        flown.found.append(f"a relay is on {AFTER_STOP_S:g} s after a stop, in pass {flown.passes}")
    plant.run_until(clock() + PAUSE_S)


def _settled(values: list[int]) -> list[int]:
    return values[min(SETTLES, len(values) // 2) :]


def _private_kib() -> int:
    rollup = [line.split() for line in Path("/proc/self/smaps_rollup").read_text().splitlines()]
    return sum(int(words[1]) for words in rollup if words[0].startswith("Private_"))


def figures(flown: Flown) -> dict[str, str]:
    """The table's rows: a name and its figure."""
    if not (settled := _settled(flown.kib)):
        return {"simulated time": "less than an hour"}
    return {
        "simulated time": f"{len(flown.kib)} h, {flown.passes} passes",
        "motor starts": f"{flown.relay_starts}",
        "private memory": f"{settled[0] / 1024:.1f} MiB after the first hours, {settled[-1] / 1024:.1f} MiB at the end",
        "its growth": f"{flown.growth_per_h(flown.kib):+.1f} KiB an hour",
        "blocks of Python's memory": f"{flown.growth_per_h(flown.blocks):+.0f} an hour",
    }
