"""The best chain of parts of passes, one after another, with the time to turn from each to the next.

Each pass may be begun late or left early at its cuts, on each of its courses. The search goes back from the end
(dynamic programming): the worth of a part includes the best chain that can follow it. Knows no satellite and no
mount.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from rotator.control.sky.sectors import Place
from rotator.tracking.courses import Course, SeenPass
from rotator.tracking.planned import SPARE_S
from rotator.tracking.travel import Travel

LEAST_SHARE = 0.5
LEAST_WORTH = 10.0
"""A part of a pass must be worth half of the whole pass, or ten minutes overhead."""
EVEN = 1e-6
NEARLY = 0.01
"""Chains that differ by less in worth count as equal. Then the one that turns the antenna least is taken."""


@dataclass(frozen=True, slots=True)
class Part:
    """A pass, or a part of it, flown on one course from one look to another."""

    seen: SeenPass
    course: Course
    first: int
    last: int

    @property
    def begin_s(self) -> float:
        return self.seen.moments_s[self.first]

    @property
    def end_s(self) -> float:
        return self.seen.moments_s[self.last]

    @property
    def wait_deg(self) -> Place:
        return self.course.places[self.first]

    @property
    def end_deg(self) -> Place:
        return self.course.places[self.last]

    @property
    def may_begin(self) -> bool:
        return self.course.stands[self.first]

    @property
    def may_end(self) -> bool:
        return self.course.stands[self.last]

    @property
    def worth(self) -> float:
        return self.course.gained[self.last] - self.course.gained[self.first]


class _Line:
    """A course with its cuts. `worth[at]`: worth of the best chain that begins this course at that cut."""

    def __init__(self, seen: SeenPass, course: Course, least: float) -> None:
        self.seen, self.course, self.looks = seen, course, seen.cuts
        count = len(self.looks)
        self.gained = [course.gained[look] for look in self.looks]
        self.least = least
        self.worth = [-inf] * count
        self.ends = [0] * count
        self.follows: list[_Begin | None] = [None] * count
        self._ended = [(-inf, 0)] * (count + 1)
        """For an end at each cut or later: the best worth, counted from the first look of the pass, and the cut."""

    def place(self, at: int) -> Place:
        return self.course.places[self.looks[at]]

    def set_worth(self, at: int, follows: _Begin | None) -> None:
        """Call it for each cut, from the last back to the first. `follows`: the best chain after an end at this cut."""
        self.follows[at] = follows
        self._ended[at] = self._ended[at + 1]
        if not self.course.stands[self.looks[at]]:
            return
        ended = self.gained[at] + (follows.worth if follows else 0.0)
        if ended > self._ended[at][0] + EVEN:
            self._ended[at] = ended, at
        first = bisect_left(self.gained, self.gained[at] + self.least, lo=at + 1)
        if self._ended[first][0] > -inf:
            self.worth[at], self.ends[at] = self._ended[first][0] - self.gained[at], self._ended[first][1]

    def part(self, at: int) -> Part:
        return Part(self.seen, self.course, self.looks[at], self.looks[self.ends[at]])


@dataclass(frozen=True, slots=True)
class _Begin:
    """The start of a line at a cut. `others`: every course of the same pass."""

    others: Sequence[_Line]
    line: _Line
    at: int

    @property
    def worth(self) -> float:
        return self.line.worth[self.at]


class _Later:
    """The begins found until now, from the latest time back."""

    def __init__(self, travel: Travel) -> None:
        self._travel = travel
        self._before_s: list[float] = []
        """Their times with the sign reversed, so that the list rises."""
        self._begins: list[tuple[float, Place, _Begin]] = []
        self._best: list[int] = []
        """For each begin: the index of the most valuable one up to it."""

    def add(self, at_s: float, begin: _Begin) -> None:
        self._before_s.append(-at_s)
        self._begins.append((begin.worth, begin.line.place(begin.at), begin))
        best = self._best[-1] if self._best else 0
        self._best.append(len(self._best) if begin.worth >= self._begins[best][0] else best)

    def best(self, ready_s: float, place: Place) -> _Begin | None:
        """The best next begin from this place. The antenna must be there `SPARE_S` after `ready_s`, or later."""
        anywhere = bisect_right(self._before_s, -(ready_s + self._travel.longest_s))
        most, found = 0.0, None
        if anywhere:
            most, _, found = self._begins[self._best[anywhere - 1]]
        soon = range(anywhere, bisect_right(self._before_s, -ready_s))
        better = [index for index in soon if self._begins[index][0] > most + EVEN]
        for index in sorted(better, key=lambda index: (-self._begins[index][0], -index)):
            _, there, begin = self._begins[index]
            if self._travel.reaches(place, there, -self._before_s[index] - ready_s):
                return begin
        return found


def best_chain(
    flyable: Sequence[tuple[SeenPass, Sequence[Course]]], stands_deg: Place, travel: Travel, from_s: float
) -> list[Part]:
    """The parts in order. `flyable`: each pass with its courses. `stands_deg`: the antenna's place at `from_s`."""
    of_pass = [[_Line(seen, course, _least(seen, ways)) for course in ways] for seen, ways in flyable]
    cuts = [
        (seen.moments_s[look], number, at)
        for number, (seen, _) in enumerate(flyable)
        for at, look in enumerate(seen.cuts)
    ]
    later = _Later(travel)
    for at_s, number, at in sorted(cuts, reverse=True):
        for line in of_pass[number]:
            line.set_worth(at, later.best(at_s + SPARE_S, line.place(at)))
        for line in of_pass[number]:
            if line.worth[at] > -inf:
                later.add(at_s, _Begin(of_pass[number], line, at))
    parts: list[Part] = []
    begin = _first(of_pass, stands_deg, travel, from_s)
    place, free_s = stands_deg, from_s
    while begin is not None:
        begin = _nearest(begin, place, free_s, travel, from_s)
        parts.append(begin.line.part(begin.at))
        place, free_s = parts[-1].end_deg, parts[-1].end_s
        begin = begin.line.follows[begin.line.ends[begin.at]]
    return parts


def ready_s(seen: SeenPass, begin_s: float, from_s: float) -> float:
    """When the antenna must be in place, in a plan made at `from_s`. A pass that is already up needs no waiting."""
    up_already = seen.found.aos_s is None or seen.found.aos_s < from_s
    return begin_s if up_already else begin_s - SPARE_S


def _first(of_pass: Sequence[Sequence[_Line]], stands_deg: Place, travel: Travel, from_s: float) -> _Begin | None:
    """The most valuable begin among those that the antenna reaches from its place."""
    most, best = EVEN, None
    for lines in of_pass:
        for line in lines:
            for at, look in enumerate(line.looks):
                within_s = ready_s(line.seen, line.seen.moments_s[look], from_s) - from_s
                if line.worth[at] > most and travel.reaches(stands_deg, line.place(at), within_s):
                    most, best = line.worth[at], _Begin(lines, line, at)
    return best


def _nearest(begin: _Begin, place: Place, free_s: float, travel: Travel, from_s: float) -> _Begin:
    """Of equally valuable courses, the one that begins nearest to the antenna's place."""
    seen, at = begin.line.seen, begin.at
    within_s = ready_s(seen, seen.moments_s[begin.line.looks[at]], from_s) - free_s
    as_good = [
        line
        for line in begin.others
        if line.worth[at] > begin.worth - NEARLY and travel.reaches(place, line.place(at), within_s)
    ]
    nearest = min(as_good, key=lambda line: travel.least_s(place, line.place(at)), default=begin.line)
    return _Begin(begin.others, nearest, at)


def _least(seen: SeenPass, ways: Sequence[Course]) -> float:
    """The least worth of a part that is flown."""
    most = max(course.gained[-1] for course in ways)
    return min(LEAST_SHARE * most, LEAST_WORTH * seen.followed.priority) * (1 - EVEN)
