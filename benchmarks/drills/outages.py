"""Failures around the box: a program that is killed or ends again and again, a card that refuses to be written,
a bus that hangs as the program begins.

Drawn with a random stream of its own, so that the rest of the drill stays the same. Knows how often each failure
happens. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.script import CLOCK, COMMON_LINKS, PEOPLE, PROGRAM, WORLD, Event

LOOPS, CARDS, BUSES = 0.1, 0.15, 0.04
"""The shares of drills with a program that ends again and again, and with a card that refuses."""


def draw_outages(seed: str, mast: Mast, seconds: float) -> tuple[list[Event], float]:
    """The events of the outages, and the seconds that the drill then lasts."""
    chance = random.Random(f"{seed} outages")
    events: list[Event] = []
    if chance.random() < CARDS:
        events.append(_at(chance.choice((0.0, chance.uniform(0.0, seconds))), WORLD, "card", chance.choice((1.0, 2.0))))
        if chance.random() < 0.5:
            events.append(_at(events[0].at_s + chance.uniform(1.0, seconds), WORLD, "card", 0.0))
        if chance.random() < 0.6:
            what = chance.choice(("kill", "restart"))
            events.append(_at(chance.uniform(0.0, seconds), PROGRAM, what, chance.choice((0.5, 2.0, 5.0))))
    if chance.random() < LOOPS:
        loop, seconds = _loop(chance, mast, seconds)
        events += loop
    if chance.random() < BUSES:
        begins_s = chance.choice([0.0, *(event.at_s for event in events if event.who == PROGRAM)])
        events.append(_at(begins_s, CLOCK, "hung", chance.choice((1.0, 4.0, 8.0, 30.0))))
    return [event for event in events if event.at_s < seconds], seconds


def _loop(chance: random.Random, mast: Mast, begins_s: float) -> tuple[list[Event], float]:
    """A program that repeats its order, an axis that an obstacle may hold, and a box that ends again and again."""
    what, every_s, count = chance.choice(("kill", "restart")), chance.uniform(4.0, 20.0), chance.randrange(4, 16)
    axis, link = chance.randrange(2), chance.choice(COMMON_LINKS)
    aim_deg = [round(chance.uniform(0.2, 0.8) * top_deg) for top_deg in mast.top_deg]
    aim_deg[axis] = round(mast.top_deg[axis] * chance.choice((0.0, 0.1, 0.9, 1.0)))
    ends_s = begins_s + every_s * (count + 1)
    events = [_at(begins_s, link, "stream", *map(float, aim_deg), 0.0, 0.0, 1.0, float(round(ends_s - begins_s)))]
    if mast.rotor.geared and chance.random() < 0.7:
        name = chance.choice([each for each in ("motor-stalled", "stop-early") if each in mast.rotor.faults] or [""])
        if name:
            events.append(_at(begins_s + chance.uniform(-0.2, 5.0), WORLD, "fault", f"{BOTH[axis]}-{name}"))
    away_s = chance.choice((0.5, 2.0))
    for number in range(1, count + 1):
        at_s = begins_s + every_s * number
        events.append(_at(at_s, PROGRAM, what, away_s))
        if chance.random() < 0.2:
            events.append(_at(at_s + chance.uniform(0.0, every_s), link, "stop"))
    if chance.random() < 0.3:
        events.append(_at(chance.uniform(begins_s, ends_s), chance.choice(PEOPLE), "resume"))
    return events, ends_s


def _at(at_s: float, who: str, what: str, *args: float | str) -> Event:
    rounded = tuple(round(each, 3) if isinstance(each, float) else each for each in args)
    return Event(round(max(0.0, at_s), 3), who, what, rounded)
