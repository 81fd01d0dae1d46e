"""Who keeps the box busy for a while: programs that ask and track, a person, browsers, watchers, a terminal.

Each comes, does its work until a moment, and leaves. Knows no limit and judges nothing.
"""

from __future__ import annotations

import asyncio
import os
import random
import time
from contextlib import suppress

from benchmarks.running.box import Box
from benchmarks.running.browsers import browsers
from benchmarks.running.programs import PROGRAMS
from benchmarks.running.words import ALL
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass

ASK_EVERY_S = 0.5
ANSWER_WITHIN_S = 10.0
FLIGHTS = tuple(read_pass(path) for path in sorted(SHIPPED.glob("*.csv")))
HANDS = (
    ("panel knob azimuth 0.3", "panel knob elevation 0.2", "panel mode manual"),
    ("panel mode jog", "panel jog cw 1.5"),
    ("panel mode jog", "panel jog down 1"),
    ("panel mode auto", "panel jog ccw 0.3"),
    ("panel mode park",),
    ("panel stop press", "panel stop release"),
    ("park",),
    ("jog up 1", "point 120 20"),
    ("status", "help", "nonsense", "stop"),
)
READY = ("panel stop release", "panel mode auto", "resume")
"""What makes the links obeyed again."""


class Crowd:
    """All of them, from one seed. `unanswered` grows by each question without its answer."""

    def __init__(self, box: Box, chance: random.Random) -> None:
        self._box = box
        self._chance = chance
        self.unanswered: list[str] = []
        self.answers = 0
        self.orders = 0

    async def work(self, bout: int, until_s: float) -> None:
        """One bout. Three links track at a time, mostly the same satellite; now and then each another one."""
        tracking = [ALL[(3 * bout + each) % len(ALL)].protocol for each in range(3)]
        flights = [self._chance.choice(FLIGHTS)] * 3 if bout % 4 else self._chance.sample(FLIGHTS, 3)
        async with asyncio.TaskGroup() as group:
            for words in ALL:
                flight = flights[tracking.index(words.protocol)] if words.protocol in tracking else None
                if flight or words.has:
                    group.create_task(self._program(words.protocol, flight, until_s))
            group.create_task(self._person(until_s))
            group.create_task(self._watcher(until_s, reads=True))
            group.create_task(self._watcher(until_s, reads=False))
            group.create_task(self._browsers(until_s))
            group.create_task(self._terminal(until_s, blocked=bout % 3 == 0))

    async def _program(self, protocol: str, flight: Pass | None, until_s: float) -> None:
        """Asks all along; with a flight it tracks it too, from somewhere in its middle."""
        words = self._box.words[protocol]
        each = PROGRAMS[words.place](self._box, words)
        try:
            await each.open()
            began_s = time.monotonic() - (self._chance.random() * flight.end_s / 2 if flight else 0.0)
            due_s = 0.0
            while (now_s := time.monotonic()) < until_s:
                if each.words.lasting is False:
                    each.close()
                    await each.open()
                if flight and now_s >= due_s:
                    azimuth_deg, elevation_deg = flight.at(now_s - began_s)
                    each.send(each.words.order(azimuth_deg, max(0.0, elevation_deg)))
                    self.orders += 1
                    due_s = now_s + 1.0
                    if not each.words.lasting:
                        await asyncio.sleep(0.1)
                        continue
                if each.words.has:
                    if await each.hears(20 if protocol == "n1mm" else ANSWER_WITHIN_S):
                        self.answers += 1
                    elif time.monotonic() < until_s:
                        self.unanswered.append(f"no right answer on {protocol}")
                await asyncio.sleep(ASK_EVERY_S)
        except OSError as fault:
            self.unanswered.append(f"{protocol}: {fault}")
        finally:
            each.close()

    async def _person(self, until_s: float) -> None:
        while time.monotonic() + 10.0 < until_s:
            await self._box.says(*self._chance.choice(HANDS))
            await asyncio.sleep(3.0)
            await self._box.says(*READY)
            await asyncio.sleep(5.0 + 10.0 * self._chance.random())

    async def _watcher(self, until_s: float, *, reads: bool) -> None:
        """`rotator monitor` in another terminal, which may be blocked."""
        while time.monotonic() < until_s:
            reader, writer = await asyncio.open_unix_connection(f"{self._box.folder}/monitor", limit=4096)
            leaves_s = min(until_s, time.monotonic() + 5.0 + 40.0 * self._chance.random())
            with suppress(TimeoutError):
                async with asyncio.timeout(leaves_s - time.monotonic()):
                    while not reads or await reader.read(4096):
                        await asyncio.sleep(0 if reads else 1.0)
            writer.transport.abort()

    async def _browsers(self, until_s: float) -> None:
        async with browsers(self._box.page_port, 3) as crowd:
            await asyncio.sleep(max(0.0, until_s - time.monotonic()))
        self.unanswered += [fault for browser in crowd for fault in browser.failed]

    async def _terminal(self, until_s: float, *, blocked: bool) -> None:
        """Reads the box's own picture; a blocked terminal takes nothing for half of the time."""
        events, fd = asyncio.get_running_loop(), self._box.terminal

        def read() -> None:
            with suppress(OSError):
                os.read(fd, 65_536)

        if blocked:
            await asyncio.sleep(max(0.0, (until_s - time.monotonic()) / 2))
        events.add_reader(fd, read)
        try:
            await asyncio.sleep(max(0.0, until_s - time.monotonic()))
        finally:
            events.remove_reader(fd)
