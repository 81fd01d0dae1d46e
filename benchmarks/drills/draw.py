"""A drill at random from a seed: a box, programs and people that give it orders, and a world that fails it.

Knows how often each event happens. The same seed and number draw the same drill. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import KINDS, ROTORS, Mast, draw_mast
from benchmarks.drills.browser import draw_browser
from benchmarks.drills.mishaps import times, trouble, troubles
from benchmarks.drills.mounts import mounted
from benchmarks.drills.outages import draw_outages
from benchmarks.drills.scattered import panel, person, program
from benchmarks.drills.script import COMMON_LINKS, PEOPLE, Drill, Event
from benchmarks.drills.stories import stories
from benchmarks.drills.unusual import prolonged, relinked, tabled, unusual

STORIES, LEFT_ALONE = 0.9, 0.5
SHORTEST_S, LONGEST_S = 30.0, 900.0


def draw(seed: str, kind: str = "") -> Drill:
    """`kind`: of the rotor; empty: any."""
    chance = random.Random(seed)
    rotor = KINDS[kind] if kind else chance.choice(ROTORS)
    mast = mounted(random.Random(f"{seed} mount"), draw_mast(chance, rotor))
    mast = unusual(random.Random(f"{seed} unusual"), mast)
    if chance.random() < STORIES:
        told, ends_s = stories(chance, mast, lambda: trouble(chance, mast))
        return _drill(mast, ends_s, told, seed)
    seconds = round(SHORTEST_S * (LONGEST_S / SHORTEST_S) ** chance.random(), 1)
    events: list[Event] = []
    for who in chance.sample(COMMON_LINKS, chance.choice((1, 1, 1, 2, 3))):
        events += program(chance, mast, who, seconds)
    for who in PEOPLE:
        if chance.random() < 0.4:
            events += person(chance, mast, who, seconds)
    if mast.has_panel:
        events += panel(chance, seconds)
    moments_s = [event.at_s for event in events] or [0.0]
    events += troubles(chance, mast, seconds, moments_s)
    events += times(chance, seconds, moments_s)
    events = [event for event in events if event.at_s < seconds]
    return _drill(mast, seconds, events, seed)


def _drill(mast: Mast, seconds: float, events: list[Event], seed: str) -> Drill:
    events = events + draw_browser(seed, mast, seconds, [event.at_s for event in events] or [0.0])
    other = random.Random(f"{seed} other")
    events, seconds = prolonged(other, mast, tabled(other, relinked(other, events)), seconds)
    outages, seconds = draw_outages(seed, mast, seconds)
    return Drill(
        kind=mast.rotor.kind,
        profile=mast.rotor.profile,
        seconds=seconds,
        start_deg=mast.start_deg,
        tables=mast.tables,
        commissioning=mast.commissioning,
        left_alone=bool(mast.commissioning) and other.random() < LEFT_ALONE,
        events=tuple(sorted(events + outages, key=lambda event: event.at_s)),
        seed=seed,
    )
