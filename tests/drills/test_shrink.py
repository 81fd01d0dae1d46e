"""A counterexample shrinks to what it needs, and no further."""

from __future__ import annotations

from benchmarks.drills.accusations import AWAY, Violation
from benchmarks.drills.script import Drill, Event
from benchmarks.drills.shrink import AFTER_S, Shrinking

NEEDED = {("rotctld", "aim"), ("world", "weld")}


def drill() -> Drill:
    events = [Event(float(at_s), "gs232b", "ask") for at_s in range(10, 90)]
    events += [Event(40.0, "rotctld", "aim", (1.0, 2.0)), Event(60.0, "world", "weld", ("azimuth", 1.0))]
    events.sort(key=lambda event: event.at_s)
    tables = {"azimuth": {"speed_dps": 3.0, "max_deg": 450.0}, "mount": {"flip": "over-top"}}
    return Drill("relay-pot", "g5500", 100.0, (0.0, 0.0), tables, "elevation", tuple(events), "7.1")


def shows(tried: Drill) -> Violation | None:
    """Two events, one after the other, on a slow motor."""
    at_s = {(event.who, event.what): event.at_s for event in tried.events}
    slow = "speed_dps" in tried.tables.get("azimuth", {})
    return Violation(at_s["world", "weld"] + 5.0, AWAY, "azimuth", "") if at_s.keys() >= NEEDED and slow else None


def test_what_is_left_is_what_it_needs() -> None:
    found = shows(drill())
    assert found
    shrinking = Shrinking(drill(), found, shows, 1e6)
    shrinking.run()
    least, shown = shrinking.best
    assert {(event.who, event.what) for event in least.events} == NEEDED
    assert len(least.events) == len(NEEDED)
    assert least.tables == {"azimuth": {"speed_dps": 3.0}}
    assert least.commissioning == ""
    assert least.seconds == shown.at_s + AFTER_S
