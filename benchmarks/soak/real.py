"""The running box in real time: every link busy, and quiet moments in which it is measured.

A bout is busy for a while; then everything that gives orders leaves, and the box is stopped. In that quiet no relay may
be on, each link must answer, and memory, files and threads are read. At the end each link must still turn the antenna.
Relays and motors are read from the simulated world's own file.
"""

from __future__ import annotations

import asyncio
import random
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.fuzz_box import PATIENCE_S
from benchmarks.soak.box import Box
from benchmarks.soak.crowd import READY, Crowd
from benchmarks.soak.programs import program
from benchmarks.soak.soaked import Soaked, judge, read_log
from benchmarks.soak.words import STOP, WORDS

BUSY_S, COASTS_S, QUIET_S = 100.0, 4.0, 10.0
LOOK_S = 0.1
AWAY_DEG = 30.0


async def soak(seconds: float, seed: int) -> Soaked:
    seen = Soaked()
    with tempfile.TemporaryDirectory() as folder:
        box = Box(Path(folder))
        box.start()
        try:
            await _answers(box)
            await box.holds(0.0)
            await box.says(*READY)
            await _bouts(box, seed, seconds, seen)
            seen.found += await _still_turned_by_all(box)
            seen.relay_starts = box.world().relay_starts or 0
        finally:
            if code := await box.stop():
                seen.found.append(f"exit code {code}")
        world = box.world()
        if world.drives != (0, 0):
            seen.found.append(f"a relay is on at the end: {world.drives}")
        if world.shorted_s:
            seen.found.append(f"both directions of a motor had current for {world.shorted_s} s")
        read_log(box.log, seen)
    judge(seen)
    return seen


async def _answers(box: Box) -> None:
    give_up_s = time.monotonic() + 3 * PATIENCE_S
    while time.monotonic() < give_up_s:
        await asyncio.sleep(0.5)
        try:
            if await _heard(box, "rotctld", 1.0):
                return
        except OSError:
            continue
    raise SystemExit("the box does not start")


async def _bouts(box: Box, seed: int, seconds: float, seen: Soaked) -> None:
    assert box.process is not None
    began_s, bout, changed = time.monotonic(), 0, 0.0
    state = box.folder / "state.json"
    while time.monotonic() - began_s < seconds:
        crowd = Crowd(box, random.Random(f"{seed} {bout}"))
        ends_s = time.monotonic() + BUSY_S
        quiet_ends_s = ends_s + COASTS_S + QUIET_S
        await crowd.work(bout, ends_s)
        await box.says(*READY)
        await _stop(box)
        await asyncio.sleep(COASTS_S)
        seen.found += await _stands(box, quiet_ends_s)
        seen.found += crowd.unanswered
        for words in WORDS:
            if words.has and not await _heard(box, words.protocol, PATIENCE_S):
                seen.found.append(f"no right answer on {words.protocol} in the quiet")
        seen.answers += crowd.answers
        seen.orders += crowd.orders
        if state.exists() and state.stat().st_mtime != changed:
            changed, seen.saved = state.stat().st_mtime, seen.saved + 1
        # What left has left: the box closes what it held for the last of them.
        await asyncio.sleep(1.0)
        seen.held.append(await box.holds(time.monotonic() - began_s))
        seen.lasted_s = time.monotonic() - began_s
        _print(seen)
        if box.process.poll() is not None:
            seen.found.append(f"the box ended with exit code {box.process.returncode}")
            return
        bout += 1


def _print(seen: Soaked) -> None:
    now, wrong = seen.held[-1], "; ".join(seen.found[-3:])
    print(
        f"{seen.lasted_s:6.0f} s  {now.private_kib} KiB  {now.blocks} blocks  {now.files} files  {now.tasks} tasks  "
        f"{len(now.threads)} threads  {wrong}",
        file=sys.stderr,
        flush=True,
    )


async def _heard(box: Box, protocol: str, patience_s: float) -> bool:
    """By a program that comes for one question."""
    each = program(box, protocol)
    await each.open()
    try:
        return await each.hears(patience_s)
    finally:
        each.close()


async def _stop(box: Box) -> None:
    each = program(box, "rotctld")
    await each.open()
    each.send(STOP)
    await each.hears(PATIENCE_S)
    each.close()


async def _stands(box: Box, until_s: float) -> list[str]:
    """There was no order since the stop: no relay is on."""
    world = box.world()
    while time.monotonic() < until_s:
        await asyncio.sleep(LOOK_S)
        before, world = world, box.world()
        if world.drives != (0, 0):
            return [f"a relay is on without an order: {world.drives} at {world.antenna_deg}"]
        if world.at_s == before.at_s:
            await asyncio.sleep(2.0)
            if box.world().at_s == world.at_s:
                return ["the simulated world has stopped"]
    return []


async def _still_turned_by_all(box: Box) -> list[str]:
    """An order on each link, one after the other: a relay closes, and a stop opens it."""
    found = []
    for words in WORDS:
        each = program(box, words.protocol)
        await each.open()
        try:
            if words.has and words.lasting:  # a box that asks us, or reports by itself, has found us now
                await each.hears(PATIENCE_S)
            at_deg = box.world().antenna_deg[0]
            goal_deg = at_deg % 360 + (AWAY_DEG if at_deg < 225 else -AWAY_DEG)
            # The first content of a file, and the first position of another rotor, are no orders.
            for nearer in (1, 0):
                each.send(words.order((goal_deg - nearer) % 360, 10.0))
                await asyncio.sleep(1.1)
            if not await _driven(box):
                found.append(f"an order on {words.protocol} turns nothing: {await box.says('status')}")
        finally:
            await _stop(box)
            each.close()
        await asyncio.sleep(COASTS_S)
        if box.world().drives != (0, 0):
            found.append(f"turns after a stop: {words.protocol}")
    return found


async def _driven(box: Box) -> bool:
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        if box.world().drives != (0, 0):
            return True
        await asyncio.sleep(LOOK_S)
    return False
