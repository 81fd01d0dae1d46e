"""Hostile bytes for as long as you like: run `python -m benchmarks.running.fuzz --minutes 10`.

Two boxes run as a user starts them, with every protocol that TCP, UDP or a terminal carries. Clients come and go, send
good, damaged and random bytes in random pieces, read or do not, leave politely or not. On the first box every link is
read_only: no bytes may move the antenna by a tenth of a degree. On the second one orders count: it must stay within its
range, and obey a stop. Both must answer a good question on every link all along, log no mistake of ours, and not grow.
What is found is printed with the seed.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import random
import socket
import sys
import tempfile
import time
import tomllib
import tty
from contextlib import suppress
from pathlib import Path

from benchmarks.running.box import PATIENCE_S, Box
from benchmarks.running.programs import heard, stop
from benchmarks.running.soak import mistakes
from benchmarks.running.words import ALL, STATION, Words, nasty
from tests.boxes import FAST_ROTOR

CLIENTS = 6
"""At a time on each box."""
START_DEG, TOP_DEG = (235.0, 25.0), (450.0, 180.0)
STILL_DEG, BEYOND_DEG = 0.1, 3.0
ORDERS_ONLY = "macdoppler"
"""It has nothing but orders, and is no link to be read_only."""


class Target(Box):
    """A box under fire."""

    def __init__(self, folder: Path, *, read_only: bool) -> None:
        self.name = "read-only box" if read_only else "box"
        self.read_only = read_only
        tables = tomllib.loads(FAST_ROTOR) | {"station": STATION}
        for axis, start_deg in zip(("azimuth", "elevation"), START_DEG, strict=True):
            tables["sim"][axis]["start_deg"] = start_deg
        words = [each for each in ALL if each.place in TALKS and not (read_only and each.protocol == ORDERS_ONLY)]
        super().__init__(folder, tables, words, read_only=read_only)
        self.sizes_kib: list[int] = []
        self.sent = self.clients = self.answered = 0

    async def antenna_deg(self) -> tuple[float, float]:
        azimuth_deg, elevation_deg = (await self.asked("held"))["antenna_deg"]
        return azimuth_deg, elevation_deg


async def client(box: Target, chance: random.Random, until_s: float) -> None:
    """Comes, talks and goes, again and again."""
    while time.monotonic() < until_s:
        words = chance.choice(tuple(box.words.values()))
        with suppress(OSError, TimeoutError):
            async with asyncio.timeout(PATIENCE_S):
                box.clients += 1
                await TALKS[words.place](box, chance, words)


async def over_tcp(box: Target, chance: random.Random, words: Words) -> None:
    reader, writer = await asyncio.open_connection("127.0.0.1", box.ports[words.protocol])
    reads = chance.random() < 0.8
    try:
        for _ in range(chance.randrange(1, 30)):
            data = nasty(chance, words.pieces)
            step = chance.choice((1, 3, 7, 64, 100_000)) if len(data) < 400 else 100_000
            for start in range(0, len(data), step):
                if writer.transport.is_closing():
                    return
                writer.write(data[start : start + step])
                await asyncio.sleep(0)
            box.sent += len(data)
            if reads:
                with suppress(TimeoutError):
                    async with asyncio.timeout(0.02):
                        await reader.read(65_536)
            await asyncio.sleep(chance.random() * 0.02)
    finally:
        writer.transport.abort() if chance.random() < 0.5 else writer.close()


async def at_terminal(box: Target, chance: random.Random, words: Words) -> None:
    """Through the pseudo-terminal, opened and closed."""
    fd = os.open(box.place(words.protocol), os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        tty.setraw(fd)
        for _ in range(chance.randrange(1, 30)):
            with suppress(BlockingIOError):
                box.sent += os.write(fd, nasty(chance, words.pieces)[:2000])
            if chance.random() < 0.8:
                with suppress(BlockingIOError):
                    os.read(fd, 65_536)
            await asyncio.sleep(chance.random() * 0.05)
    finally:
        os.close(fd)


async def by_datagrams(box: Target, chance: random.Random, words: Words) -> None:
    """From addresses that come and go."""
    with socket.socket(type=socket.SOCK_DGRAM) as sender:
        sender.setblocking(False)
        sender.bind((f"127.0.0.{chance.randrange(1, 100)}", 0))
        for _ in range(chance.randrange(1, 30)):
            with suppress(OSError):
                box.sent += sender.sendto(nasty(chance, words.pieces), ("127.0.0.1", box.ports[words.protocol]))
            await asyncio.sleep(chance.random() * 0.02)


TALKS = {"tcp": over_tcp, "pty": at_terminal, "udp": by_datagrams}


async def watch(box: Target, until_s: float) -> list[str]:
    """What is wrong, as soon as something is."""
    while time.monotonic() < until_s:
        if box.process.poll() is not None:
            return [f"{box.name}: ended with exit code {box.process.returncode}"]
        for words in box.words.values():
            if words.question and words.place == "tcp":
                if not await heard(box, words.protocol, PATIENCE_S):
                    return [f"{box.name}: no right answer to {words.question!r} on {words.protocol}"]
                box.answered += 1
        places_deg = await box.antenna_deg()
        moved_deg = [abs(now - begun) for now, begun in zip(places_deg, START_DEG, strict=True)]
        if box.read_only and max(moved_deg) > STILL_DEG:
            return [f"{box.name}: moved to {places_deg}"]
        if not all(-BEYOND_DEG <= at <= top + BEYOND_DEG for at, top in zip(places_deg, TOP_DEG, strict=True)):
            return [f"{box.name}: out of its range, at {places_deg}"]
        box.sizes_kib.append(box.private_kib)
        await asyncio.sleep(0.5)
    return []


async def stops(box: Target) -> list[str]:
    """All senders have ended: a stop, and it stands."""
    await stop(box, PATIENCE_S)
    await asyncio.sleep(2.0)
    await box.asked("seen")
    await asyncio.sleep(1.0)
    edges = (await box.asked("seen"))["edges"]
    drives = (await box.asked("held"))["drives"]
    return [f"{box.name}: turns after a stop: {edges}"] if edges or any(drives) else []


async def fuzz(minutes: float, seed: int) -> list[str]:
    found: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        boxes = []
        for read_only in (True, False):
            place = Path(folder, str(read_only))
            place.mkdir()
            boxes.append(Target(place, read_only=read_only))
        try:
            for box in boxes:
                await box.answers()
            until_s = time.monotonic() + 60 * minutes
            async with asyncio.TaskGroup() as group:
                watchers = [group.create_task(watch(box, until_s)) for box in boxes]
                for number, box in enumerate(boxes):
                    for each in range(CLIENTS):
                        group.create_task(client(box, random.Random(f"{seed} {number} {each}"), until_s))
            found += [each for watcher in watchers for each in watcher.result()]
            for box in boxes:
                if box.process.poll() is None:
                    found += [*await stops(box), *_told(box)]
        finally:
            codes = [await box.stop() for box in boxes]
        found += [f"exit code {code}" for code in codes if code]
        for box in boxes:
            found += mistakes(Path(box.folder, "said.txt").read_text(errors="replace").splitlines())
    return found


def _told(box: Target) -> list[str]:
    """Print what was done to a box; returns whether it grew."""
    early, end = box.sizes_kib[len(box.sizes_kib) // 10], box.sizes_kib[-1]
    print(
        f"{box.name:>13}: {box.clients} connections, {box.sent / 1e6:.1f} MB, {box.answered} good questions answered, "
        f"{early} KiB early, {end} KiB at the end"
    )
    return [f"{box.name}: grew from {early} to {end} KiB"] if end > 2 * early else []


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    given = parser.parse_args()
    print(f"seed {given.seed}")
    found = asyncio.run(fuzz(given.minutes, given.seed))
    print("\n".join(found) or "nothing found")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
