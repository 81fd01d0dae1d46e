"""A drill at random from a seed: a box, programs and people that give it orders, and a world that fails it.

Knows which parts a drill has. The same seed draws the same drill. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import KINDS, draw_mast
from benchmarks.drills.browser import draw_browser
from benchmarks.drills.mounts import braked, mounted, sensed
from benchmarks.drills.outages import draw_outages, trouble
from benchmarks.drills.script import Drill
from benchmarks.drills.stories import stories
from benchmarks.drills.variants import alone, varied

LEFT_ALONE = 0.5
BESIDE = "s"


def draw(seed: str, kind: str) -> Drill:
    """A seed that ends in `BESIDE` draws a box beside forbidden sectors."""
    chance = random.Random(seed)
    mast = draw_mast(chance, KINDS[kind], beside_sectors=seed.endswith(BESIDE))
    mast = mounted(random.Random(f"{seed} mount"), mast)
    mast = sensed(random.Random(f"{seed} sensors"), mast)
    mast = varied(random.Random(f"{seed} variants"), mast)
    mast = braked(random.Random(f"{seed} brakes"), mast)
    if not seed.endswith(BESIDE):  # sectors are of two axes
        mast = alone(random.Random(f"{seed} alone"), mast)
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
