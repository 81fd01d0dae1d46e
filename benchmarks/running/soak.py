"""A busy box in real time, for an hour or as long as you like: run `python -m benchmarks.running.soak --hours 1`.

A bout is busy for a while: programs on every link ask and track, a person is at panel and console, browsers, watchers
and a terminal look on (`crowd`). Then everything that gives orders leaves, and the box is stopped. In that quiet no
relay may be on, each link must answer, and memory, files and threads are read. At the end each link must still turn
the antenna. Prints a table of figures; exit code 1, with what is wrong.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import re
import statistics
import sys
import tempfile
import time
import tomllib
from collections import Counter
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path

from benchmarks.running.box import PATIENCE_S, Box
from benchmarks.running.crowd import READY, Crowd
from benchmarks.running.programs import heard, program, stop
from benchmarks.running.words import ALL, STATION
from firmware_sim import world_file
from rotator.runtime.sensor_thread import SLOW

BUSY_S, COASTS_S, QUIET_S = 100.0, 4.0, 10.0
LOOK_S, AWAY_DEG = 0.1, 30.0
SETTLES_S = 600.0
MOST_KIB_PER_H = 1024.0
CONFIG = """
[sim.azimuth]
start_deg = 200
[lcd]
kind = "pcf8574"
[panel]
azimuth_knob = 0
elevation_knob = 1
jog = 2
reference = 3
mode_msb = 10
mode_lsb = 9
calibrate = 11
stop = 19
azimuth_meter = 0
elevation_meter = 1
lamp_auto = 4
lamp_data = 6
lamp_motor = 7
lamp_stop = 8
"""


@dataclass(frozen=True, slots=True)
class Held:
    """What the process holds while nobody gives an order."""

    at_s: float
    """Since the start of the soak."""
    private_kib: int
    blocks: int
    """Blocks of Python's own memory, after a garbage collection."""
    tasks: int
    files: int
    threads: tuple[str, ...]

    @property
    def own_threads(self) -> tuple[str, ...]:
        """Without asyncio's worker threads, of which there are as many as were needed at a time; six at most."""
        return tuple(name for name in self.threads if not name.startswith("asyncio_"))


@dataclass
class Soaked:
    """What was seen."""

    held: list[Held] = field(default_factory=list)
    found: list[str] = field(default_factory=list)
    """What is wrong."""
    lasted_s: float = 0.0
    answers: int = 0
    orders: int = 0
    relay_starts: int = 0
    saved: int = 0
    """How often the state file was written."""
    said: list[str] = field(default_factory=list)

    @property
    def settled(self) -> list[Held]:
        """After the first ten minutes, or the first third of a short soak."""
        from_s = min(SETTLES_S, self.lasted_s / 3)
        return [each for each in self.held if each.at_s >= from_s]

    def growth_per_h(self, value: str) -> float:
        """The median of the slopes between all pairs of moments: a few odd moments do not matter."""
        pairs = combinations(self.settled, 2)
        slopes = [(getattr(b, value) - getattr(a, value)) / (b.at_s - a.at_s) * 3600 for a, b in pairs]
        return statistics.median(slopes) if slopes else 0.0


ERROR = re.compile(r"(\S+ )?E ")
"""With the moment, or without it."""
NO_TURN = (SLOW, "late: ", "the event loop stands still")
"""Why axes are stopped, as they should be, when the box gets no turn on a busy machine."""


def mistakes(said: list[str]) -> list[str]:
    """The errors in a log, each without its moment."""
    errors = [line for line in said if ERROR.match(line) or "Traceback" in line or "protocol failed" in line]
    wrong = Counter(ERROR.sub("", line) for line in errors if not any(words in line for words in NO_TURN))
    return [f"log, {count} times: {text}" for text, count in wrong.items()]


def judge(seen: Soaked) -> None:
    settled = seen.settled
    if not settled:
        return
    first = settled[0]
    if (growth := seen.growth_per_h("private_kib")) > MOST_KIB_PER_H:
        seen.found.append(f"memory grew by {growth:.0f} KiB an hour")
    for each in settled:
        if each.own_threads != first.own_threads:
            before, now = Counter(first.own_threads), Counter(each.own_threads)
            seen.found.append(f"threads at {each.at_s:.0f} s: lost {sorted(before - now)}, new {sorted(now - before)}")
    third = max(1, len(settled) // 3)
    for name, values in (
        ("file descriptors", [each.files for each in settled]),
        ("asyncio tasks", [each.tasks for each in settled]),
    ):
        # The least of a third: a file may just be open while it is counted.
        if (early := min(values[:third])) < (late := min(values[-third:])):
            seen.found.append(f"{name} grew from {early} to {late}")


def figures(seen: Soaked) -> dict[str, str]:
    """The table's rows: a name and its figure."""
    settled = seen.settled or seen.held
    first, last = settled[0], settled[-1]
    return {
        "time on the running box": f"{seen.lasted_s / 3600:.2f} h",
        "links": f"{len(ALL)} protocols",
        "questions answered": f"{seen.answers}",
        "orders of passes": f"{seen.orders}",
        "motor starts": f"{seen.relay_starts}",
        "state saved": f"{seen.saved} times",
        "private memory": f"{first.private_kib / 1024:.1f} MiB after {first.at_s / 60:.0f} minutes, "
        f"{last.private_kib / 1024:.1f} MiB at the end",
        "its growth": f"{seen.growth_per_h('private_kib'):+.0f} KiB an hour",
        "blocks of Python's memory": f"{first.blocks}, then {seen.growth_per_h('blocks'):+.0f} an hour",
        "file descriptors": f"{first.files}, then {last.files}",
        "threads": f"{len(first.threads)}, then {len(last.threads)}",
        "asyncio tasks": f"{first.tasks}, then {last.tasks}",
        "stops because the machine gave no turn": f"{sum(words in line for line in seen.said for words in NO_TURN)}",
    }


async def soak(seconds: float, seed: int) -> Soaked:
    seen = Soaked()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        tables = tomllib.loads(CONFIG) | {"station": STATION}
        tables["sim"]["world"] = f"{folder}/world.json"
        box = Box(folder, tables, ALL, in_terminal=True)
        try:
            await box.answers()
            await box.says(*READY)
            await _bouts(box, seed, seconds, seen)
            seen.found += await _still_turned_by_all(box, seen.said)
            held = await box.asked("held")
            seen.relay_starts = held["relay_starts"]
            seen.said += (await box.asked("seen"))["said"]
        finally:
            if code := await box.stop():
                seen.found.append(f"exit code {code}")
        world = world_file.read(folder / "world.json")
        assert world is not None
        if world.drives != (0, 0):
            seen.found.append(f"a relay is on at the end: {world.drives}")
        if world.shorted_s:
            seen.found.append(f"both directions of a motor had current for {world.shorted_s} s")
    seen.found += mistakes(seen.said)
    judge(seen)
    return seen


async def _bouts(box: Box, seed: int, seconds: float, seen: Soaked) -> None:
    began_s, bout, changed = time.monotonic(), 0, 0.0
    state = box.folder / "state.json"
    while time.monotonic() - began_s < seconds:
        crowd = Crowd(box, random.Random(f"{seed} {bout}"))
        await crowd.work(bout, time.monotonic() + BUSY_S)
        await box.says(*READY)
        await stop(box, PATIENCE_S)
        await asyncio.sleep(COASTS_S)
        seen.said += (await box.asked("seen"))["said"]
        seen.found += crowd.unanswered
        for words in ALL:
            if words.has and not await heard(box, words.protocol, PATIENCE_S):
                seen.found.append(f"no right answer on {words.protocol} in the quiet")
        await asyncio.sleep(QUIET_S)
        quiet = await box.asked("seen")
        if quiet["edges"]:
            seen.found.append(f"a relay is on without an order: {quiet['edges']}")
        seen.said += quiet["said"]
        seen.answers += crowd.answers
        seen.orders += crowd.orders
        if state.exists() and state.stat().st_mtime != changed:
            changed, seen.saved = state.stat().st_mtime, seen.saved + 1
        held = await box.asked("held")
        if any(held["drives"]):
            seen.found.append(f"a relay is on without an order: {held['drives']}")
        seen.lasted_s = time.monotonic() - began_s
        threads = tuple(held["threads"])
        now = Held(seen.lasted_s, box.private_kib, held["blocks"], held["tasks"], box.files, threads)
        seen.held.append(now)
        print(f"{seen.lasted_s:6.0f} s  {now}  {'; '.join(seen.found[-3:])}", file=sys.stderr, flush=True)
        bout += 1


async def _still_turned_by_all(box: Box, said: list[str]) -> list[str]:
    """An order on each link, one after the other: a relay closes, and a stop opens it."""
    found = []
    for words in ALL:
        async with program(box, words.protocol) as each:
            if words.has and words.lasting:  # a box that asks us, or reports by itself, has found us now
                await each.hears(PATIENCE_S)
            at_deg = (await box.asked("held"))["antenna_deg"][0]
            goal_deg = at_deg % 360 + (AWAY_DEG if at_deg < 225 else -AWAY_DEG)
            said += (await box.asked("seen"))["said"]
            # The first content of a file, and the first position of another rotor, are no orders.
            for nearer in (1, 0):
                each.send(words.order((goal_deg - nearer) % 360, 10.0))
                await asyncio.sleep(1.1)
            if not await _driven(box, said):
                found.append(f"an order on {words.protocol} turns nothing: {await box.says('status')}")
            await stop(box, PATIENCE_S)
        await asyncio.sleep(COASTS_S)
        if any((await box.asked("held"))["drives"]):
            found.append(f"turns after a stop: {words.protocol}")
    return found


async def _driven(box: Box, said: list[str]) -> bool:
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        news = await box.asked("seen")
        said += news["said"]
        if news["edges"]:
            return True
        await asyncio.sleep(LOOK_S)
    return False


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    given = parser.parse_args()
    print(f"seed {given.seed}", file=sys.stderr)
    seen = asyncio.run(soak(3600 * given.hours, given.seed))
    print("| soak | figure |\n|---|---|")
    print("\n".join(f"| {name} | {value} |" for name, value in figures(seen).items()))
    print("\n".join(seen.found) or "nothing found", file=sys.stderr)
    sys.exit(bool(seen.found))


if __name__ == "__main__":
    main()
