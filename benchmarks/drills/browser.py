"""A person on the page in a drill: what a paired browser sends, and when. Drawn from a stream of its own.

Knows what people do with a page: they take the antenna, hold a button, point, set a mode, give the antenna back, and
say that they have looked at the relays. Does not know which orders the box obeys. A held button sends its sign several
times a second until the person lets it go, or its connection is lost.
"""

from __future__ import annotations

import random
from typing import cast

from benchmarks.drills.arcs import draw_arc
from benchmarks.drills.boxes import BOTH, Mast
from benchmarks.drills.script import CLOCK, PAGE, Arg, Event
from hw.ports import Direction
from rotator.exchange.orders import Jog
from rotator.exchange.sources import Source
from rotator.protocols.console import parse
from rotator.protocols.methods import PersonCommand
from rotator.protocols.operating import Operating
from rotator.protocols.panel_words import TURNS
from rotator.protocols.session import Box, Tracking
from rotator.web.live import LEASE_S

LOOKS_ON = 0.35
"""The share of drills with a browser."""
STALLS = 0.2
"""The share of those in which the page's event loop stands still for a while."""
SIGN_S = 0.1
WAYS = ("cw", "ccw", "up", "down")
MODES = ("auto", "manual", "jog", "park")


class Browser:
    """A session of the page: lines as on the console, and `hold WAY` or `hold off` for the button that is held."""

    idle_s = None
    closed = False

    def __init__(self, box: Box, tracking: Tracking, source: Source) -> None:
        self._operating = Operating(box, tracking, source)
        self._held: Jog | None = None

    def receive(self, data: bytes) -> list[bytes]:
        match data.split():
            case [b"hold", b"off"]:
                jog = Jog(self._held.axis, Direction.OFF, held=True) if self._held else None
                self._held = None
                return [self._operating.do(jog).encode()] if jog else []
            case [b"hold", way]:
                jog = Jog(*TURNS[way.decode()], LEASE_S, held=True)
                if self._held is not None and (self._held.axis, self._held.direction) != (jog.axis, jog.direction):
                    self._operating.do(Jog(self._held.axis, Direction.OFF, held=True))
                self._held = jog
                return [self._operating.do(jog).encode()]
        command = cast(PersonCommand, parse(data.rstrip(b"\n")))  # a drill asks nothing here
        return [self._operating.do(command).encode()]

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return []


def draw_browser(seed: str, mast: Mast, seconds: float, moments_s: list[float]) -> list[Event]:
    """The browser's events in the drill with this seed, most of them soon after another event; empty: no browser."""
    chance = random.Random(f"{seed}/page")
    if chance.random() >= LOOKS_ON:
        return []
    events: list[Event] = []
    for _ in range(chance.choice((1, 2, 3, 5))):
        at_s = chance.uniform(0.0, seconds)
        if chance.random() < 0.7:
            at_s = max(0.0, chance.choice(moments_s) + chance.uniform(-0.5, 6.0))
        for what, *args in _errand(chance, mast, at_s):
            events += _press(chance, at_s, what, args)
            at_s = events[-1].at_s + chance.choice((0.05, 0.5, 2.0, 10.0))
    if chance.random() < STALLS:
        at_s = chance.choice(events).at_s + chance.uniform(-0.5, 3.0)
        events.append(Event(round(max(0.0, at_s), 3), CLOCK, "page-stalled", (chance.choice((0.5, 1.5, 5.0, 20.0)),)))
    return [event for event in events if event.at_s < seconds]


def _errand(chance: random.Random, mast: Mast, at_s: float) -> list[tuple[str, *tuple[Arg, ...]]]:
    """The orders that a person gives one after the other."""
    way, axis = chance.choice(WAYS), chance.choice(BOTH)
    azimuth_deg, elevation_deg = (float(chance.randrange(round(top_deg))) for top_deg in mast.top_deg)
    aim: tuple[str, *tuple[Arg, ...]] = ("aim", azimuth_deg, elevation_deg)
    match chance.randrange(10):
        case 0:
            return [("take",), aim, ("give-back",)]
        case 1:
            return [("take",), ("hold", way), ("hold", chance.choice(WAYS))]
        case 2:
            return [("hold", way)]
        case 3:
            return [aim, ("hold", way), ("give-back",)]
        case 4 if not mast.has_panel:
            return [("mode", chance.choice(MODES)), aim, ("hold", way), ("mode", chance.choice(MODES))]
        case 5:
            return [("stop",), ("resume",), ("hold", way)]
        case 6:
            return [("relays-checked", axis), ("jog", chance.choice(WAYS), 2.0)]
        case 7:
            return [("take",), ("give-back",)]
        case 8:
            return [("track", draw_arc(chance, at_s)), *([("give-back",)] if chance.random() < 0.3 else [])]
        case _:
            return [("jog", way, chance.choice((0.1, 1.0, 5.0))), ("give-back",)]


def _press(chance: random.Random, at_s: float, what: str, args: list[Arg]) -> list[Event]:
    """The events of one press. A held button sends its signs; the end of a hold may be lost."""
    if what != "hold":
        return [Event(round(at_s, 3), PAGE, what, tuple(args))]
    count = round(chance.choice((0.1, 0.4, 1.0, 3.0, 8.0)) / SIGN_S)
    signs = [Event(round(at_s + SIGN_S * number, 3), PAGE, what, tuple(args)) for number in range(count)]
    if chance.random() < 0.6:
        signs.append(Event(round(at_s + SIGN_S * count, 3), PAGE, what, ("off",)))
    return signs
