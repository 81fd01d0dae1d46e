"""What goes wrong in a drill: troubles of the world, each with its end, and failures around the box.

A program that is killed or ends again and again, a card that refuses or hangs, files that are changed under the box, a
bus that hangs as the program begins, a page that hangs: drawn with a random stream of its own. Knows which trouble
which kind of rotor can have, and how often each failure happens. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.card import HANGS, NAMES, REFUSES, REFUSES_LATER, WAYS, WORKS
from benchmarks.drills.script import CLOCK, LINKS, PEOPLE, PROGRAM, WORLD, Arg, Event

BADS = ("zero", "full", "far", "near", "last")
Happening = tuple[Arg, ...]


def trouble(chance: random.Random, mast: Mast) -> tuple[tuple[str, *Happening], tuple[str, *Happening] | None]:
    rotor, axis = mast.rotor, chance.choice(mast.axes)
    choices = ["fault", "fault"]
    if rotor.relays:
        choices += ["weld", "weld", "pace", "push", "sticks"]
    if mast.has_pots:
        choices += ["every", "burst", "noise", "drift", "stands"]
    if rotor.sporadic or rotor.shared_sporadic:
        choices += ["sporadic", "sporadic"]
    match chance.choice(choices):
        case "weld":
            return ("weld", axis, float(chance.choice((-1, 1)))), ("unweld", axis)
        case "pace":
            return ("pace", axis, chance.uniform(0.3, 1.5)), ("pace", axis, 1.0)
        case "sticks":
            return ("sticks", axis, chance.uniform(0.02, 0.15)), ("sticks", axis, 0.0)
        case "push":
            return ("push", axis, chance.choice((-1, 1)) * chance.uniform(0.05, 0.5)), ("push", axis, 0.0)
        case "every":
            return ("every", axis, float(chance.randrange(2, 33)), chance.choice(BADS)), ("every", axis, 0.0, "zero")
        case "burst":
            return ("burst", axis, chance.uniform(0.05, 3.0), chance.choice(BADS)), None
        case "noise":
            return ("noise", axis, chance.uniform(0.1, 1.0)), ("noise", axis, 0.0)
        case "drift":
            return ("drift", axis, chance.uniform(-0.1, 0.1), chance.uniform(1.0, 10.0)), None
        case "stands":
            return ("stands", axis, 1.0), ("stands", axis, 0.0)
        case "sporadic":
            name = chance.choice([*(f"{axis}-{name}" for name in rotor.sporadic), *rotor.shared_sporadic])
            return ("fault", f"{name}:{chance.randrange(2, 40)}"), ("clear", name)
    names = [f"{axis}-{name}" for name in rotor.faults] + list(rotor.shared)
    if mast.has_switches:
        names += [f"{axis}-low-switch-open", f"{axis}-high-switch-open"]
    name = chance.choice(names)
    return ("fault", name), ("clear", name)


LOOPS, CARDS, FILES, BUSES, PAGES = 0.1, 0.2, 0.06, 0.04, 0.06
"""The shares of drills with each of these failures."""
HANGS_S = (1.0, 4.0, 10.0, 60.0, 300.0)


def draw_outages(seed: str, mast: Mast, seconds: float) -> tuple[list[Event], float]:
    """The events of the outages, and the seconds that the drill then lasts."""
    chance = random.Random(f"{seed} outages")
    events: list[Event] = []
    if chance.random() < CARDS:
        at_s, state = chance.choice((0.0, chance.uniform(0.0, seconds))), chance.choice((REFUSES, REFUSES_LATER, HANGS))
        events.append(_at(at_s, WORLD, "card", state))
        if state == HANGS:
            events += _while_it_hangs(chance, at_s)
        if chance.random() < 0.5:
            lasts_s = chance.choice(HANGS_S) if state == HANGS else chance.uniform(1.0, seconds)
            events.append(_at(at_s + lasts_s, WORLD, "card", WORKS))
        if chance.random() < 0.6:
            what = chance.choice(("kill", "restart"))
            events.append(_at(chance.uniform(0.0, seconds), PROGRAM, what, chance.choice((0.5, 2.0, 5.0))))
    if chance.random() < LOOPS:
        loop, seconds = _loop(chance, mast, seconds)
        events += loop
    if chance.random() < FILES:
        for name in chance.sample(NAMES, chance.choice((1, 1, 2, len(NAMES)))):
            events.append(_at(chance.uniform(0.0, seconds), WORLD, "file", name, chance.choice(WAYS)))
        events.append(_at(chance.uniform(0.0, seconds), PROGRAM, chance.choice(("kill", "restart")), 2.0))
    if chance.random() < PAGES:
        events.append(_at(chance.uniform(0.0, seconds), CLOCK, "page-stalled", chance.choice((0.5, 1.5, 5.0, 20.0))))
    if chance.random() < BUSES:
        begins_s = chance.choice([0.0, *(event.at_s for event in events if event.who == PROGRAM)])
        events.append(_at(begins_s, CLOCK, "hung", chance.choice((1.0, 4.0, 8.0, 30.0))))
    return [event for event in events if event.at_s < seconds], seconds


def _loop(chance: random.Random, mast: Mast, begins_s: float) -> tuple[list[Event], float]:
    """A program that repeats its order, an axis that an obstacle may hold, and a box that ends again and again."""
    what, every_s, count = chance.choice(("kill", "restart")), chance.uniform(4.0, 20.0), chance.randrange(4, 16)
    axis, link = chance.randrange(2), chance.choice(LINKS)
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


def _while_it_hangs(chance: random.Random, at_s: float) -> list[Event]:
    """What writes files: stops, releases, and a program that ends meanwhile."""
    who, events = chance.choice(PEOPLE), []
    for what in chance.choice((("stop",), ("stop", "resume"), ("stop", "resume", "stop"), ("storm", "resume"))):
        at_s += chance.uniform(0.1, 5.0)
        events.append(_at(at_s, who, what))
    at_s += chance.choice((0.3, 3.0, 8.0))
    if chance.random() < 0.7:
        events.append(_at(at_s, PROGRAM, chance.choice(("kill", "restart")), chance.choice((0.5, 2.0))))
        at_s += 2.5
    link = chance.choice(LINKS)
    for _ in range(chance.choice((0, 1, 2))):
        events.append(_at(at_s, link, "aim", float(chance.randrange(360)), float(chance.randrange(90))))
        at_s += chance.choice((0.5, 5.0))
    return events


def _at(at_s: float, who: str, what: str, *args: float | str) -> Event:
    rounded = tuple(round(each, 3) if isinstance(each, float) else each for each in args)
    return Event(round(max(0.0, at_s), 3), who, what, rounded)
