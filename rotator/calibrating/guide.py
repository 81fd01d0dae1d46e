"""Walks a person through setting an axis up: statuses and answers in, text and orders out.

Knows what to ask, in which order, and what to refuse. Pure: no clock, no terminal, no file. The walk is written down
as one path from top to bottom (`_walk`).
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.calibrating.answers import Answer, Enter, Finish, No, Quit
from rotator.calibrating.asking import Asking, Known
from rotator.calibrating.readings import LEAST_TURN, READINGS, Doubt
from rotator.calibrating.table import Point, Table
from rotator.calibrating.watch import Move
from rotator.orders import Order, Stop
from rotator.status import Status


@dataclass(frozen=True, slots=True)
class Commissioned:
    """What is to be saved."""

    axis: Axis
    points: tuple[tuple[float, float], ...]
    min_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True)
class Turn:
    """What a step leads to."""

    lines: tuple[str, ...]
    orders: tuple[Order, ...]


class Refused(Exception):  # noqa: N818 - the walk ends here; it is no failure of the program
    """It makes no sense to go on."""


class Guide(Asking):
    """Call `step` with every status and every answer until `ended`; `result` is there if all went well."""

    def __init__(self, known: Known) -> None:
        super().__init__(known)
        self.result: Commissioned | None = None
        self.ended = False
        self._walking = self._walk()

    def step(self, status: Status, answer: Answer | None = None) -> Turn:
        self._take(status, answer)
        try:
            if isinstance(answer, Quit):
                raise Refused("Left: nothing is saved.")
            next(self._walking)
        except StopIteration:
            self.ended = True
        except Refused as reason:
            self._say(str(reason))
            self.ended = True
        if self.ended:
            self.prompt = ""
            self._orders.append(Stop())
        turn = Turn(tuple(self._lines), tuple(self._orders))
        self._lines.clear()
        self._orders.clear()
        return turn

    def _walk(self) -> Generator[None, None, None]:
        words, known = self._words, self.known
        self._say(*words.introduction)
        rising = yield from self._check_plus()
        yield from self._check_minus(rising=rising)
        table = Table(rising=rising)
        table = yield from self._end(table, words.low_end, known.min_deg)
        table = yield from self._end(table, words.high_end, known.max_deg)
        table = yield from self._between(table)
        self._say("", *table.lines(known.supply_v, known.lowest_reading, known.highest_reading))
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

    def _check_minus(self, *, rising: bool) -> Generator[None, None, None]:
        change = yield from self._turn(Direction.MINUS, self._words.turn_minus, -1 if rising else 1)
        self._say(f"The reading {'rises' if change > 0 else 'falls'} on the way back: the directions are right.")

    def _turn(self, direction: Direction, prompt: str, sign: int) -> Generator[None, None, float]:
        """Presses that way until the reading has changed enough and always the same way (that of `sign`, if not 0)."""
        total = 0.0
        while abs(total) < LEAST_TURN:
            event = yield from self._ask(prompt)
            if not isinstance(event, Move):
                self._say(self._words.press_first)
                continue
            if event.direction is not direction or event.turned is None:
                continue
            change, doubt = event.turned.change, event.turned.doubt()
            if not doubt and sign and change * sign < 0:
                raise Refused(self._words.same_way)
            if not doubt and change * total < 0:
                doubt = "the reading went the other way than a moment ago, though the motor ran the same way"
            if doubt:
                self._say(f"Not believed: {doubt}. Once more.")
                total = 0.0
                continue
            total += change
            if abs(total) < LEAST_TURN:
                self._say("A little further.")
        return total

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
