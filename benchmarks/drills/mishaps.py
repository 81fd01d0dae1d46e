"""Troubles of the world, late cycles and ends of the program, at random moments or soon after an order.

Knows which trouble which kind of rotor can have, and how often. Does not know orders, nor the seed.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.scattered import at
from benchmarks.drills.script import CLOCK, PROGRAM, WORLD, Arg, Event

BADS = ("zero", "full", "far", "near", "last")


def _when(chance: random.Random, seconds: float, moments_s: list[float]) -> float:
    """A moment at random, often within seconds of an order: while the motor starts, runs, stops, or waits."""
    if chance.random() < 0.6:
        return chance.choice(moments_s) + chance.uniform(-0.3, 6.0)
    return chance.choice((0.0, chance.uniform(0.0, seconds)))


def troubles(chance: random.Random, mast: Mast, seconds: float, moments_s: list[float]) -> list[Event]:
    """Faults, one or several at a time, and their ends."""
    events: list[Event] = []
    for _ in range(chance.choice((0, 0, 1, 1, 1, 2, 2, 3, 4))):
        at_s, lasts_s = _when(chance, seconds, moments_s), 10.0 ** chance.uniform(-1.0, 2.5)
        begins, ends = trouble(chance, mast)
        events.append(at(at_s, WORLD, *begins))
        if ends and chance.random() < 0.7:
            events.append(at(at_s + lasts_s, WORLD, *ends))
    return events


Happening = tuple[Arg, ...]


def trouble(chance: random.Random, mast: Mast) -> tuple[tuple[str, *Happening], tuple[str, *Happening] | None]:
    rotor, axis = mast.rotor, chance.choice(BOTH)
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


def times(chance: random.Random, seconds: float, moments_s: list[float]) -> list[Event]:
    """Late cycles, a bus that hangs, and ends of the program while the world goes on."""
    events: list[Event] = []
    for _ in range(chance.choice((0, 0, 0, 1, 2))):
        at_s = _when(chance, seconds, moments_s)
        match chance.randrange(4):
            case 0:
                events.append(at(at_s, CLOCK, "stalled", chance.choice((0.5, 1.5, 5.0, 20.0))))
            case 1:
                events.append(at(at_s, CLOCK, "late", chance.choice((0.1, 0.3, 0.6, 1.0, 5.0))))
            case 2:
                events.append(at(at_s, CLOCK, "hung", chance.choice((0.1, 0.2, 0.5, 3.0))))
            case _:
                events.append(at(at_s, CLOCK, "jitter", chance.uniform(1.0, 60.0), chance.choice((0.02, 0.1, 0.3))))
    for _ in range(chance.choice((0, 0, 0, 0, 1, 2))):
        what = chance.choice(("restart", "kill"))
        events.append(at(_when(chance, seconds, moments_s), PROGRAM, what, chance.choice((0.5, 2.0, 5.0, 30.0))))
    return events
