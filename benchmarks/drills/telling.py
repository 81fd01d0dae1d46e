"""The parts of a drill's story: its moments and angles, and what programs and trackers send for a while.

Knows one program, another one, a person and an axis of the mast. Does not know which part of a story comes when:
`stories` does.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from benchmarks.drills.arcs import draw_arc
from benchmarks.drills.boxes import Mast
from benchmarks.drills.script import CLOCK, LINKS, PANEL, PEOPLE, Arg, Event

PAUSES_S = (0.0, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0, 8.0)
INSISTS_S = (20.0, 60.0, 90.0)
"""For how long a program repeats its order, once a second."""
WAYS = (("cw", "ccw"), ("up", "down"))
TURNS_S = 1.3
"""A mode switch counts when it has stood still for a second."""

Trouble = Callable[[], tuple[tuple[str, *tuple[Arg, ...]], tuple[str, *tuple[Arg, ...]] | None]]


class Telling:
    """The events of one story after `at_s`; `ends_s` is when it is over. `trouble` draws a trouble and its end."""

    def __init__(self, chance: random.Random, mast: Mast, at_s: float, trouble: Trouble) -> None:
        self.events: list[Event] = []
        self.ends_s = at_s
        self._chance = chance
        self._mast = mast
        self._trouble = trouble
        self._link, self._other = chance.sample(LINKS, 2)
        self._person = chance.choice(PEOPLE)
        self._axis = chance.randrange(2)
        self._way = chance.randrange(2)
        self._mode = ""
        """The position of the panel's mode switch; empty: as an earlier story has left it."""

    def _pause(self) -> None:
        self.ends_s += self._chance.choice(PAUSES_S)

    def _add(self, who: str, what: str, *args: Arg) -> None:
        rounded = tuple(round(each, 3) if isinstance(each, float) else each for each in args)
        self.events.append(Event(round(self.ends_s, 3), who, what, rounded))

    def _turn(self, mode: str) -> None:
        """Turn the panel's mode switch, unless it already has that position."""
        if mode != self._mode:
            self._mode = mode
            self._add(PANEL, "mode", mode)
            self.ends_s += TURNS_S

    def _insist(self, aim_deg: list[float]) -> None:
        """A program that tracks repeats its order; the next events of the story come meanwhile."""
        count = round(self._chance.choice(INSISTS_S))
        self._add(self._link, "stream", *aim_deg, 0.0, 0.0, 1.0, float(count))
        self.ends_s += self._chance.choice((0.5, 5.0))

    def _track(self) -> None:
        """A person tracks; the next events of the story may come while the plan is computed."""
        chance = self._chance
        self._add(CLOCK, "plans", chance.choice((0.1, 1.0, 3.0, 10.0)))
        if chance.random() < 0.05:
            self._add(CLOCK, "plans-fail", 1.0)
        words = draw_arc(chance, self.ends_s) if chance.random() < 0.9 else f"{self._near(0):g} {self._near(1):g}"
        self._add(self._person, "track", words)
        self.ends_s += chance.choice((0.0, 0.5, 2.0, 4.0, 15.0, 40.0))
        if chance.random() < 0.1:
            self._add(CLOCK, "set", chance.choice((-30.0, 0.5, 10.0)))

    def _recognised(self) -> None:
        """A program sends the directions of a target. The box recognises it and plans, while the story goes on."""
        words, every_s = draw_arc(self._chance, self.ends_s), self._chance.choice((0.5, 1.0, 2.0))
        self._add(CLOCK, "plans", self._chance.choice((0.1, 1.0, 3.0)))
        self._add(self._link, "arc", words, every_s, round(self._chance.choice((20.0, 60.0, 90.0)) / every_s))
        self.ends_s += self._chance.choice((2.0, 5.0, 15.0))
        self._add(self._link, "recognised", words)
        self._pause()

    def _waits(self) -> None:
        """A program waits at the horizon for a rise. The box gives it the turn that the whole pass needs."""
        lasts_s, rises_s = self._chance.choice((40.0, 120.0, 300.0)), self._chance.choice((10.0, 30.0, 60.0))
        azimuth_deg = self._chance.choice((0, 10, 170, self._chance.randrange(360)))
        side, top_deg = self._chance.choice((-1, 1)), self._chance.choice((30, 85))
        words = f"arc {self.ends_s + rises_s:.1f} {lasts_s:g} 600 {azimuth_deg} {side} {top_deg}"
        self._add(CLOCK, "plans", self._chance.choice((0.1, 1.0, 3.0)))
        self._add(self._link, "arc", words, 1.0, round(rises_s + self._chance.choice((0.0, 20.0, 60.0))))
        self.ends_s += self._chance.choice((2.0, 5.0, 9.0))
        self._add(self._link, "waits", words)
        self._pause()

    def _waver(self) -> None:
        """A program jogs to and fro."""
        for turn in range(8):
            self._add(self._link, "jog", WAYS[self._axis][turn % 2])
            self.ends_s += self._chance.choice((0.03, 0.06, 0.1, 0.3))

    def _far(self, axis: int) -> float:
        """An angle near the end of the range, in the direction of this story."""
        top_deg = self._mast.top_deg[axis]
        if axis != self._axis:
            return round(self._chance.uniform(0.0, top_deg))
        return round(
            self._chance.uniform(0.8, 1.0) * top_deg if self._way == 0 else self._chance.uniform(0.0, 0.2) * top_deg
        )

    def _near(self, axis: int) -> float:
        return round(self._chance.uniform(0.3, 0.7) * self._mast.top_deg[axis])
