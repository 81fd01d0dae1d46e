"""Walks a person through setting up an axis with a pot, or another sensor of shares: directions, ends, points between.

Knows what to ask, in which order, and what to refuse. Pure: no clock, no terminal, no file. The walk is written down
as one path from top to bottom (`_walk`).
"""

from __future__ import annotations

from collections.abc import Generator

from hw.ports import Direction
from rotator.calibrating.answers import Enter, Finish, No
from rotator.calibrating.asking import Asking, Commissioned, Known
from rotator.calibrating.readings import READINGS, Doubt
from rotator.calibrating.table import Point, Table
from rotator.calibrating.walk import Refused, Steps
from rotator.calibrating.watch import Move


class Guide(Asking):
    """`supply_v`: what a pot is fed with, so that readings can be told in volts too; None: it is no pot."""

    def __init__(self, known: Known, supply_v: float | None) -> None:
        super().__init__(known)
        self._supply_v = supply_v

    def reading(self, raw: float) -> str:
        volts = "" if self._supply_v is None else f" ({raw * self._supply_v:.3f} V)"
        return super().reading(raw) + volts

    def _walk(self) -> Steps:
        words, known = self._words, self.known
        self._say(*words.introduction)
        rising = yield from self._check_plus()
        yield from self._check_minus(rising=rising)
        table = Table(rising=rising)
        table = yield from self._end(table, words.low_end, known.min_deg)
        table = yield from self._end(table, words.high_end, known.max_deg)
        table = yield from self._between(table)
        self._say("", *table.lines(self._supply_v, known.lowest_reading, known.highest_reading))
        limits = yield from self._limits(table)
        self._say(*words.summary(*limits))
        if (yield from self._agrees("Save this? y or n:")):
            points = tuple((point.raw, point.angle_deg) for point in table.points)
            self.result = Commissioned(known.axis, points, *limits)
        else:
            self._say("Nothing is saved.")

    def _check_plus(self) -> Generator[None, None, bool]:
        """Whether the reading rises with the degrees."""
        words = self._words
        self._say("", *words.direction_check)
        change = yield from self._turn(Direction.PLUS, words.turn_plus, 0)
        if not (yield from self._agrees(words.did_it_turn)):
            raise Refused(words.swap)
        self._say(f"The reading {'rises' if change > 0 else 'falls'} with it: good, either will do.")
        return change > 0

    def _check_minus(self, *, rising: bool) -> Steps:
        change = yield from self._turn(Direction.MINUS, self._words.turn_minus, -1 if rising else 1)
        self._say(f"The reading {'rises' if change > 0 else 'falls'} on the way back: the directions are right.")

    def _end(self, table: Table, where: str, proposed_deg: float) -> Generator[None, None, Table]:
        self._say("", *self._words.drive_to(where))
        while True:
            event = yield from self._ask(f"At the {where}? Enter reads.")
            if isinstance(event, Enter):
                point = yield from self._read(proposed_deg)
                try:
                    if point is not None:
                        return table.with_end(point)
                except Doubt as doubt:
                    self._say(f"Refused: {doubt}.")
            elif not isinstance(event, Move):
                self._say("Drive there, then Enter.")

    def _between(self, table: Table) -> Generator[None, None, Table]:
        self._say("", *self._words.between)
        while True:
            event = yield from self._ask("Another point? Enter reads; f when there are no more.")
            match event:
                case Finish() | No():
                    return table
                case Enter():
                    point = yield from self._read(None)
                    try:
                        if point is not None:
                            table = table.with_point(point)
                            self._say(f"Taken: {table.off_line_deg(point):+.1f}° off the straight line.")
                    except Doubt as doubt:
                        self._say(f"Refused: {doubt}.")
                case _ if not isinstance(event, Move):
                    self._say("Drive to a known angle, then Enter; or f.")

    def _read(self, proposed_deg: float | None) -> Generator[None, None, Point | None]:
        """Read where it stands, and ask for the angle there. None: not believed, or to be read again."""
        try:
            measured = yield from self._measured()
        except Doubt as doubt:
            self._say(f"Refused: {doubt}.")
            return None
        self._say(f"It reads {measured.raw:.4f}, with a noise of {measured.noise:.4f} in each of {READINGS} readings.")
        angle_deg = yield from self._number("Which angle is that on the rotor's own scale?", proposed_deg)
        return None if angle_deg is None else Point(measured, angle_deg)

    def _limits(self, table: Table) -> Generator[None, None, tuple[float, float]]:
        low_deg, high_deg = table.points[0].angle_deg, table.points[-1].angle_deg
        self._say("", f"Between which angles may it be sent? They lie within {low_deg:g} to {high_deg:g}.")
        while True:
            least = yield from self._number("Lowest angle:", min(max(self.known.min_deg, low_deg), high_deg))
            most = yield from self._number("Highest angle:", max(min(self.known.max_deg, high_deg), low_deg))
            if least is not None and most is not None and low_deg <= least < most <= high_deg:
                return least, most
            self._say(f"Refused: the limits must lie within {low_deg:g} to {high_deg:g}, the lower one first.")
