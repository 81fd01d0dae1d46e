"""The card of a drill may refuse or hang. On every kind of rotor the drill goes on, is the same each time, and finds
nothing wrong with the box."""

from __future__ import annotations

import pytest

from benchmarks.drills.boxes import ROTORS, Rotor
from benchmarks.drills.card import HANGS, NAMES, REFUSES, WAYS, WORKS
from benchmarks.drills.play import play
from benchmarks.drills.script import Drill, Event
from tests.search import some

ORDERS = (
    Event(1.5, "console", "confirm", ("azimuth", 0.0)),
    Event(1.6, "console", "confirm", ("elevation", 0.0)),
    Event(2.0, "gs232b", "aim", (120.0, 40.0)),
    Event(5.0, "console", "stop"),
    Event(6.0, "console", "resume"),
    Event(7.0, "gs232b", "jog", ("cw",)),
    Event(8.0, "console", "stop"),
)
AGAIN = (
    Event(16.0, "gs232b", "aim", (60.0, 20.0)),
    Event(18.0, "console", "resume"),
    Event(19.0, "gs232b", "aim", (60.0, 20.0)),
)
ENDS: dict[str, tuple[Event, ...]] = {
    "goes on": (),
    "is killed": (Event(12.0, "program", "kill", (2.0,)),),
    "ends properly": (Event(12.0, "program", "restart", (2.0,)),),
}


def drilled(rotor: Rotor, *events: Event) -> Drill:
    tables = {"digipot": {axis: {"start_deg": 90.0} for axis in ("azimuth", "elevation")}}
    every = tuple(sorted((*ORDERS, *AGAIN, *events), key=lambda event: event.at_s))
    return Drill(
        rotor.kind, rotor.profile, 30.0, (90.0, 90.0), tables if rotor.kind == "digipot" else {}, "", every, "card"
    )


HANGING_S = (0.0, 10.0), (0.0, 40.0), (4.0, 2.5), (7.5, 40.0), (11.9, 3.0)
"""When the card begins to hang, and for how long."""
HANGING = [(rotor, *hang_s, end) for end in ENDS for hang_s in HANGING_S for rotor in ROTORS]


@pytest.mark.search
@pytest.mark.parametrize(
    ("rotor", "begins_s", "lasts_s", "end"), some(HANGING), ids=lambda part: getattr(part, "kind", str(part))
)
def test_a_card_that_hangs(rotor: Rotor, begins_s: float, lasts_s: float, end: str) -> None:
    hang = Event(begins_s, "world", "card", (HANGS,)), Event(begins_s + lasts_s, "world", "card", (WORKS,))
    assert play(drilled(rotor, *hang, *ENDS[end])).violations == []


@pytest.mark.long
@pytest.mark.parametrize("rotor", ROTORS, ids=lambda rotor: rotor.kind)
def test_a_card_that_hangs_and_then_refuses_is_the_same_each_time(rotor: Rotor) -> None:
    states = ((0.5, HANGS), (4.0, REFUSES), (7.5, HANGS), (14.5, WORKS))
    events = tuple(Event(at_s, "world", "card", (state,)) for at_s, state in states)
    drill = drilled(rotor, *events, *ENDS["is killed"])
    first = play(drill)
    assert first.violations == []
    assert len(play(drill).said) == len(first.said)


@pytest.mark.long
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("rotor", ROTORS[:2], ids=lambda rotor: rotor.kind)
def test_files_that_are_changed_under_the_box(rotor: Rotor, way: str, end: str) -> None:
    for at_s in (0.2, 4.0, 11.5):
        changes = (Event(at_s, "world", "file", (name, way)) for name in NAMES)
        assert play(drilled(rotor, *changes, *ENDS[end])).violations == []
