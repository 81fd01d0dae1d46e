"""Stories: an order, a mishap, a stop and the next order within seconds of each other, as things go wrong on a mast.

Events at independent random moments seldom meet within the second in which a bug shows. A story puts them one after
the other, with pauses from none to a few seconds. Knows the order of events. Does not judge.
"""

from __future__ import annotations

import random

from benchmarks.drills.boxes import BOTH, COUNTED, Mast
from benchmarks.drills.script import CLOCK, PANEL, PEOPLE, PROGRAM, WORLD, Event
from benchmarks.drills.telling import TURNS_S, WAYS, Telling, Trouble


class Story(Telling):
    """One story after `at_s`; `ends_s` is when it is over. `trouble` draws a trouble of the world, and its end."""

    def __init__(self, chance: random.Random, mast: Mast, at_s: float, trouble: Trouble) -> None:
        super().__init__(chance, mast, at_s, trouble)
        self._tell()

    def _tell(self) -> None:
        chance = self._chance
        self._move()
        if chance.random() < 0.7:
            self._pause()
            self._mishap()
        for _ in range(chance.choice((0, 1, 1, 2))):
            self._pause()
            self._stop()
        if chance.random() < 0.7:
            self._pause()
            self._let_go()
        for _ in range(chance.choice((0, 1, 1, 2))):
            self._pause()
            if chance.random() < 0.5:
                self._way = 1 - self._way
            self._move()
            if chance.random() < 0.5:
                self._pause()
                self._stop()
        self.ends_s += chance.choice((5.0, 5.0, 15.0, 15.0, 30.0, 90.0))

    def _move(self) -> None:
        """An order that turns the axis of this story its way for a while."""
        way = WAYS[self._axis][self._way]
        if self._mast.commissioning and self._chance.random() < 0.6:
            self._set_up()
            return
        if self._mast.has_panel:
            if self._chance.random() < 0.3:
                self._move_at_panel(way)
                return
            self._turn("auto")
        aim_deg = [self._far(0), self._far(1)]
        match self._chance.randrange(14):
            case 0:
                self._jog(self._link, way)
            case 1:
                self._jog(self._other, way)
            case 2:
                self._press(way)
            case 3 | 8:
                self._insist(aim_deg)
            case 9:
                self._waver()
            case 10 | 11:
                self._track()
            case 12:
                (self._recognised, self._waits)[self._chance.randrange(2)]()
            case 4 if "gs232" in self._link:
                self._add(self._link, "list", 2.0, *aim_deg, self._near(0), self._near(1), *aim_deg)
                self._pause()
                self._add(self._link, "run-list")
            case 5:
                self._add(self._link, "park")
            case 6 if self._mast.rotor.kind in COUNTED:
                self._add(self._person, "home", BOTH[self._axis])
            case 13:
                self._add(self._person, "storm")
            case 7:
                what, args = (("aim-azimuth", aim_deg[:1]), ("aim-elevation", aim_deg[1:]))[self._axis]
                self._add(self._link, what, *args)
            case _:
                self._add(self._link, "aim", *aim_deg)

    def _jog(self, link: str, way: str) -> None:
        """A program jogs, and sometimes its connection ends before it has stopped."""
        self._add(link, "jog", way)
        if self._chance.random() < 0.3:
            self._pause()
            self._add(link, "leave")

    def _press(self, way: str) -> None:
        for _ in range(self._chance.choice((1, 3, 12))):
            self._add(self._person, "jog", way, self._chance.choice((0.5, 2.0, 5.0)))
            self.ends_s += self._chance.choice((0.5, 2.0, 5.5))

    def _set_up(self) -> None:
        """The set-up of an axis: a person drives it to the nearer stop, presses again to be sure, and turns back."""
        axis = BOTH.index(self._mast.commissioning)
        top_deg, start_deg = self._mast.top_deg[axis], self._mast.start_deg[axis]
        there, back = WAYS[axis] if start_deg > top_deg / 2.0 else WAYS[axis][::-1]
        for _ in range(self._chance.choice((1, 3, 12, 20))):
            self._add(self._person, "jog", there, 2.0)
            self.ends_s += 2.0
        self.ends_s += self._chance.choice((0.5, 12.0))
        self._add(self._person, "jog", there, 2.0)
        self.ends_s += self._chance.choice((0.3, 1.0))
        self._add(self._person, "jog", back, 2.0)

    def _move_at_panel(self, way: str) -> None:
        if self._chance.random() < 0.7:
            self._turn("jog")
            self._add(PANEL, "jog", way, self._chance.choice((0.1, 0.5, 3.0)))
        else:
            self._turn("manual")
            self._add(PANEL, "knob", BOTH[self._axis], self._chance.random())
            self.ends_s += TURNS_S

    def _mishap(self) -> None:
        chance, axis = self._chance, BOTH[self._axis]
        match chance.randrange(8):
            case 0:
                self._add(CLOCK, "late", chance.choice((0.3, 0.6, 1.5, 5.0)))
            case 1:
                self._add(CLOCK, "hung", chance.choice((0.2, 1.0, 8.0)))
            case 2:
                self._add(PROGRAM, chance.choice(("kill", "kill", "restart")), chance.choice((0.5, 2.0, 10.0)))
                self.ends_s += 10.0
            case 3 if self._mast.rotor.relays:
                self._add(WORLD, "weld", axis, 1.0 if self._way == 0 else -1.0)
            case 4 if self._mast.rotor.geared:
                self._add(WORLD, "fault", f"{axis}-motor-stalled")
            case _:
                begins, ends = self._trouble()
                self._add(WORLD, *begins)
                if ends and chance.random() < 0.4:
                    self._pause()
                    self._add(WORLD, *ends)

    def _stop(self) -> None:
        if self._mast.has_panel and self._chance.random() < 0.3:
            self._stop_at_panel()
            return
        match self._chance.randrange(10):
            case 9:
                self._add(self._person, *self._chance.choice((("track", "off"), ("let-go",))))
            case 0 | 1:
                self._add(self._link, "stop")
            case 2 | 3:
                self._add(self._other, "stop")
            case 4:
                self._add(self._link, "stop-axis", BOTH[self._axis])
            case 5:
                # A program stops one axis and then the other, in one write, under its own flood.
                self._add("gs232b", "flood", self._near(0), self._near(1), 0.0, 500.0, 200.0)
                self.ends_s += 0.399
                for axis in BOTH:
                    self._add("gs232b", "stop-axis", axis)
            case 6:
                self._add(self._link, "leave")
                self._add(self._other, "leave")
            case _:
                self._add(self._person, "stop")

    def _stop_at_panel(self) -> None:
        if self._chance.random() < 0.5:
            self._turn(self._chance.choice(("park", "manual", "jog")))
            return
        self._add(PANEL, "stop", "press")
        self._pause()
        self._add(PANEL, "stop", "release")

    def _let_go(self) -> None:
        if self._mast.has_panel and self._chance.random() < 0.3:
            self._turn(self._chance.choice(("auto", "manual", "jog")))
            return
        self._add(*((self._person, "resume") if self._chance.random() < 0.6 else (self._link, "stop")))
        if self._mast.rotor.kind in COUNTED and self._chance.random() < 0.5:
            for axis in BOTH:  # a person looks where the antenna stands, and says so
                self._add(self._person, "confirm", axis, 0.0)


def stories(chance: random.Random, mast: Mast, trouble: Trouble) -> tuple[list[Event], float]:
    """A few stories one after the other, and when the last one is over."""
    events: list[Event] = []
    at_s = chance.choice((0.2, 3.0))
    for axis in BOTH:
        if mast.rotor.relays and chance.random() < (0.6 if axis == mast.commissioning else 0.3):
            events.append(Event(0.0, WORLD, "sticks", (axis, round(chance.uniform(0.02, 0.15), 3))))
        if mast.rotor.kind in COUNTED and chance.random() < 0.8:
            events.append(Event(0.1, chance.choice(PEOPLE), "confirm", (axis, 0.0)))
    for _ in range(chance.choice((1, 1, 2, 3))):
        story = Story(chance, mast, at_s, trouble)
        events += story.events
        at_s = story.ends_s
    return events, at_s
