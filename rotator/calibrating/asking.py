"""Asks a person about one axis while it may be turned: presses, faults meanwhile, and readings at rest.

Knows what is done with a press, how a direction check sees what came of it, and how a reading is taken. Knows nothing
of what the questions are for: that is the guides'.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.calibrating.answers import Answer, Halt, Press
from rotator.calibrating.readings import READINGS, SHARES, Doubt, Grain, Measured, measure
from rotator.calibrating.walk import Refused, Walk
from rotator.calibrating.watch import Move, Watch
from rotator.calibrating.words import Words, words_for
from rotator.faults import Notice
from rotator.orders import Jog, Stop
from rotator.status import Status

ACKNOWLEDGED_S = 0.3
"""A fault that is still there so long after it was acknowledged is still there."""
BEGINS_S = 3.0
"""A controller is being connected to for a while: until then that it is silent is no news."""
WRONG_WAY = "pot moves the wrong way"
"""The fault of an axis whose reading goes against its motor: that stops it before a press is over."""


@dataclass(frozen=True, slots=True)
class Known:
    """What the configuration says of the axis; degrees on the rotor's own scale."""

    axis: Axis
    min_deg: float
    max_deg: float
    lowest_reading: float
    highest_reading: float
    least_deg: float = -360.0
    greatest_deg: float = 720.0
    grain: Grain = SHARES
    settle_s: float = 0.0
    """How long it moves on when it should stand."""


@dataclass(frozen=True, slots=True)
class Commissioned:
    """What is to be saved of an axis. No points: its readings are degrees."""

    axis: Axis
    points: tuple[tuple[float, float], ...] | None
    min_deg: float
    max_deg: float


class Asking(Walk):
    """What a walk leans on that sets an axis up."""

    def __init__(self, known: Known) -> None:
        self.known = known
        self.result: Commissioned | None = None
        self._words: Words = words_for(known.axis)
        super().__init__(self._words.keys, known.least_deg, known.greatest_deg)
        self._watch = Watch(known.axis, known.grain, known.settle_s)
        self._began_s = math.inf
        self._fault = ""
        self._noticed: tuple[Notice, ...] = ()
        self._stood = False

    def ready(self, answer: Answer) -> bool:
        """A press may follow a press, all else waits for rest."""
        if isinstance(answer, Halt):
            return True
        if isinstance(answer, Press) and not self.known.settle_s:
            return not self._watch.driven and self._asking
        return self._watch.resting and self._asking

    def way(self, direction: Direction) -> str:
        return self._words.plus if direction > 0 else self._words.minus

    def reading(self, raw: float) -> str:
        """As it is shown to a person."""
        return self.known.grain.text(raw)

    def _take(self, status: Status, answer: Answer | None) -> None:
        super()._take(status, answer)
        self._began_s = min(self._began_s, status.at_s)
        self._event = self._watch.see(status)
        self._notice()

    @property
    def _tells(self) -> bool:
        """Whether its readings mean anything yet."""
        return True

    # --- directions

    def _turn(self, direction: Direction, prompt: str, sign: int) -> Generator[None, None, float]:
        """Presses that way until the reading has changed enough and always the same way (that of `sign`, if not 0)."""
        total, enough = 0.0, self.known.grain.least_turn
        while abs(total) < enough:
            event = yield from self._ask(prompt)
            if not isinstance(event, Move):
                self._say(self._words.press_first)
                continue
            if event.direction is not direction:
                continue
            if event.turned is None:
                if f": {WRONG_WAY}:" in self._fault:
                    total = -enough * direction
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
            if abs(total) < enough:
                self._say("A little further.")
        if sign and total * sign < 0:
            raise Refused(self._words.same_way)
        return total

    # --- a reading

    def _measured(self) -> Generator[None, None, Measured]:
        """Many readings of an axis at rest. Raises Doubt."""
        self.prompt = "Reading; hands off."
        self._orders.append(Stop())
        begun_s, seen_s, readings = None, None, list[float]()
        while len(readings) < READINGS:
            yield
            status = self._status
            if isinstance(self._answer, (Press, Halt)):
                raise Doubt("not while it is being read: press when the box asks again")
            if status is None or status.at_s == seen_s or not self._watch.resting:
                continue
            seen_s, axis = status.at_s, status.axis(self.known.axis)
            begun_s = seen_s if begun_s is None else begun_s
            if seen_s - begun_s < ACKNOWLEDGED_S:
                continue
            if axis.raw is not None and axis.fault is None:
                readings.append(axis.raw)
            elif axis.fault is not None:
                raise Doubt(str(axis.fault))
        return measure(readings, self.known.lowest_reading, self.known.highest_reading, self.known.grain)

    # --- what happens by the way

    def _halt(self) -> None:
        self._watch.halt()
        super()._halt()

    def _press(self, press: Press, *, may_turn: bool) -> None:
        if press.axis is not self.known.axis:
            self._say(f"This is the {self.known.axis.value}. {self._words.keys}")
        elif not may_turn:
            self._say("First answer, please; then it may turn again.")
        elif press.seconds > 0 and self._status is not None:
            if self._fault:
                # Whatever stopped it has been read by now; it comes back at once if it is still there.
                self._orders.append(Stop())
            self._watch.press(press, self._status.at_s)
            self._stood = False
            self._orders.append(Jog(press.axis, press.direction, press.seconds))

    def _notice(self) -> None:
        """Faults, turns, and an axis that is driven but stands."""
        assert self._status is not None, "a step has a status"
        axis = self._status.axis(self.known.axis)
        self._say(*(f"Note: {notice}" for notice in axis.notices if notice not in self._noticed))
        self._noticed = axis.notices
        fault = axis.fault
        if fault and fault.passing and self._status.at_s - self._began_s < BEGINS_S:
            fault = None
        text = str(fault) if fault else ""
        if text != self._fault:
            self._fault = text
            if text:
                self._say(f"FAULT {text}")
        if not self._tells:
            return
        if not self._stood and self._watch.stands():
            self._stood = True
            self._say("The reading stands still: it is at its stop, or something is wrong.")
        if isinstance(self._event, Move) and self._event.turned is not None:
            way, moved, grain = self.way(self._event.direction), self._event.turned, self.known.grain
            change = grain.text(moved.change, signed=True)
            self._say(f"  {way}: reading {grain.text(moved.before)} to {grain.text(moved.after)} ({change})")
