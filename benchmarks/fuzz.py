"""Hostile bytes for as long as you like: run `python -m benchmarks.fuzz --minutes 10`.

Two boxes run as a user starts them, with every protocol that TCP or UDP carries and a pseudo-terminal. Clients come and
go, send good, damaged and random bytes in random pieces, read or do not, leave politely or not. On the first box every
link is read_only: no bytes may move the antenna by a tenth of a degree. On the second one orders count:
it must stay within its range, and obey a stop. Both must answer a good question on every link all along, log no
mistake of ours, and not grow. What is found is printed with the seed.
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
import tty
from contextlib import suppress
from pathlib import Path

from benchmarks.fuzz_box import PATIENCE_S, Box
from benchmarks.fuzz_words import DATAGRAMS, GS232, SPOKEN, nasty

CLIENTS = 6
"""At a time on each box."""
STILL_DEG, BEYOND_DEG = 0.1, 3.0
TOP_AZIMUTH_DEG, TOP_ELEVATION_DEG = 450, 180


async def client(box: Box, chance: random.Random, until_s: float) -> None:
    """Comes, talks and goes, again and again."""
    while time.monotonic() < until_s:
        protocol = chance.choice(tuple(box.ports))
        pieces = SPOKEN[protocol][0] if protocol in SPOKEN else (b"W235 025\r", b"W100 -10\n", b"W1")
        with suppress(OSError, TimeoutError):
            async with asyncio.timeout(PATIENCE_S):
                reader, writer = await asyncio.open_connection("127.0.0.1", box.ports[protocol])
                box.clients += 1
                reads = chance.random() < 0.8
                try:
                    for _ in range(chance.randrange(1, 30)):
                        data = nasty(chance, pieces)
                        step = chance.choice((1, 3, 7, 64, 100_000)) if len(data) < 400 else 100_000
                        for start in range(0, len(data), step):
                            if not writer.transport.is_closing():
                                writer.write(data[start : start + step])
                            await asyncio.sleep(0)
                        box.sent += len(data)
                        if writer.transport.is_closing():
                            break
                        if reads:
                            with suppress(TimeoutError):
                                async with asyncio.timeout(0.02):
                                    await reader.read(65_536)
                        await asyncio.sleep(chance.random() * 0.02)
                finally:
                    writer.transport.abort() if chance.random() < 0.5 else writer.close()


async def terminal(box: Box, chance: random.Random, until_s: float) -> None:
    """The same through the pseudo-terminal, opened and closed."""
    while time.monotonic() < until_s:
        fd = os.open(box.pty, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            tty.setraw(fd)
            for _ in range(chance.randrange(1, 30)):
                data = nasty(chance, GS232)[:2000]
                with suppress(BlockingIOError):
                    box.sent += os.write(fd, data)
                if chance.random() < 0.8:
                    with suppress(BlockingIOError):
                        os.read(fd, 65_536)
                await asyncio.sleep(chance.random() * 0.05)
        finally:
            os.close(fd)


async def datagrams(box: Box, chance: random.Random, until_s: float) -> None:
    """The same by UDP, from addresses that come and go."""
    while time.monotonic() < until_s:
        protocol = chance.choice(tuple(box.udp_ports))
        with socket.socket(type=socket.SOCK_DGRAM) as sender:
            sender.setblocking(False)
            sender.bind((f"127.0.0.{chance.randrange(1, 100)}", 0))
            for _ in range(chance.randrange(1, 30)):
                data = nasty(chance, DATAGRAMS[protocol])
                with suppress(OSError):
                    box.sent += sender.sendto(data, ("127.0.0.1", box.udp_ports[protocol]))
                await asyncio.sleep(chance.random() * 0.02)


async def watch(box: Box, until_s: float) -> list[str]:
    """What is wrong, as soon as something is."""
    name = "read-only box" if box.read_only else "box"
    while time.monotonic() < until_s:
        assert box.process is not None
        if box.process.poll() is not None:
            return [f"{name}: ended with exit code {box.process.returncode}"]
        for protocol, (_, question, has) in SPOKEN.items():
            if await box.ask(protocol, question, has) is None:
                return [f"{name}: no right answer to {question!r} on {protocol}"]
            box.answered += 1
        where = await box.position()
        if where is None:
            return [f"{name}: no position"]
        azimuth_deg, elevation_deg = where
        if box.read_only and max(abs(azimuth_deg - 235), abs(elevation_deg - 25)) > STILL_DEG:
            return [f"{name}: moved to {where}"]
        low, high_az, high_el = -BEYOND_DEG, TOP_AZIMUTH_DEG + BEYOND_DEG, TOP_ELEVATION_DEG + BEYOND_DEG
        if not (low <= azimuth_deg <= high_az and low <= elevation_deg <= high_el):
            return [f"{name}: out of its range, at {where}"]
        box.sizes_kib.append(box.resident_kib())
        await asyncio.sleep(0.5)
    return []


async def stops(box: Box) -> list[str]:
    """All senders have ended: a stop, and it stands."""
    await box.ask("rotctld", b"\nS\n", b"RPRT")
    async with asyncio.timeout(PATIENCE_S):
        while b"MOVING" in (await box.ask("rotctld", b"\ns\n", b"\n") or b"MOVING"):
            await asyncio.sleep(0.05)
    before = await box.position()
    await asyncio.sleep(1.0)
    after = await box.position()
    still = before and after and max(abs(a - b) for a, b in zip(before, after, strict=True)) <= STILL_DEG
    return [] if still else [f"turns after a stop: from {before} to {after}"]


async def fuzz(minutes: float, seed: int) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        boxes = [Box(read_only, Path(folder) / str(read_only)) for read_only in (True, False)]
        try:
            for box in boxes:
                box.folder.mkdir()
                await box.start()
            until_s = time.monotonic() + 60 * minutes
            async with asyncio.TaskGroup() as group:
                watchers = [group.create_task(watch(box, until_s)) for box in boxes]
                for number, box in enumerate(boxes):
                    for each in range(CLIENTS):
                        group.create_task(client(box, random.Random(f"{seed} {number} {each}"), until_s))
                    group.create_task(terminal(box, random.Random(f"{seed} {number}"), until_s))
                    group.create_task(datagrams(box, random.Random(f"{seed} {number} udp"), until_s))
            found = [each for watcher in watchers for each in watcher.result()]
            for box in boxes:
                found += await stops(box)
        finally:
            for box in boxes:
                if box.process is not None and (code := box.stop()):
                    found = [f"exit code {code}"]
        for box in boxes:
            found += _told(box)
        return found


def _told(box: Box) -> list[str]:
    """Print what was done to a box; returns what its log should not have."""
    log = box.log.read_text(errors="replace").splitlines()
    early, end = box.sizes_kib[len(box.sizes_kib) // 10], box.sizes_kib[-1]
    print(
        f"{'read-only' if box.read_only else 'obeying':>9}: {box.clients} connections, {box.sent / 1e6:.1f} MB, "
        f"{box.answered} good questions answered, {len(log)} log lines, resident {early} kB early, {end} kB at the end"
    )
    late = [line for line in log if " E FAULT" in line and "late:" in line]
    if late:
        print(f"{'':>9}  it stopped {len(late)} axes because it got no turn on a machine this busy, as it should")
    bad = [line for line in log if "protocol failed" in line or "Traceback" in line or " E " in line]
    bad = [line for line in bad if line not in late]
    return [f"log: {line}" for line in dict.fromkeys(bad)] + (
        [f"grew from {early} to {end} kB"] if end > 2 * early else []
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    given = parser.parse_args()
    print(f"seed {given.seed}")
    found = asyncio.run(fuzz(given.minutes, given.seed))
    print("\n".join(found) or "nothing found")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
