"""A drill at random from a seed: a box, programs and people that give it orders, and a world that fails it.

Knows which parts a drill has. The same seed draws the same drill. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import KINDS, ROTORS, draw_mast
from benchmarks.drills.browser import draw_browser
from benchmarks.drills.mounts import mounted, sensed
from benchmarks.drills.outages import draw_outages, trouble
from benchmarks.drills.script import Drill
from benchmarks.drills.stories import stories

LEFT_ALONE = 0.5


def draw(seed: str, kind: str = "") -> Drill:
    """`kind`: of the rotor; empty: any."""
    chance = random.Random(seed)
    rotor = KINDS[kind] if kind else chance.choice(ROTORS)
    mast = mounted(random.Random(f"{seed} mount"), draw_mast(chance, rotor))
    mast = sensed(random.Random(f"{seed} sensors"), mast)
    events, seconds = stories(chance, mast, lambda: trouble(chance, mast))
    events += draw_browser(seed, mast, seconds, [event.at_s for event in events] or [0.0])
    outages, seconds = draw_outages(seed, mast, seconds)
    return Drill(
        kind=mast.rotor.kind,
        profile=mast.rotor.profile,
        seconds=seconds,
        start_deg=mast.start_deg,
        tables=mast.tables,
        commissioning=mast.commissioning,
        left_alone=bool(mast.commissioning) and chance.random() < LEFT_ALONE,
        events=tuple(sorted(events + outages, key=lambda event: event.at_s)),
        seed=seed,
    )
