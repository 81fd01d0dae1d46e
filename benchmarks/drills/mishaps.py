"""Troubles of the world, each with its end, if it has one.

Knows which trouble which kind of rotor can have, and how often. Does not know orders, nor the seed.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.script import Arg

BADS = ("zero", "full", "far", "near", "last")
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
