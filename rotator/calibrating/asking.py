"""Asks a person one thing at a time while an axis may be turned: questions, answers, and readings at rest.

Knows how a question is put, what is done with a press, a stop or a fault meanwhile, and how a reading is taken. Knows
nothing of what the questions are for: that is the guide's.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.calibrating.answers import Answer, Enter, Halt, No, Number, Press, Unknown, Yes
from rotator.calibrating.readings import READINGS, Doubt, Measured, measure
from rotator.calibrating.watch import Move, Watch
from rotator.calibrating.words import Words, words_for
from rotator.orders import Jog, Order, Stop
from rotator.status import Status

ACKNOWLEDGED_S = 0.3
"""A fault that is still there so long after it was acknowledged is still there."""


@dataclass(frozen=True, slots=True)
class Known:
    """What the configuration says of the axis."""

    axis: Axis
    min_deg: float
    max_deg: float
    lowest_reading: float
    highest_reading: float
    supply_v: float
    least_deg: float = -360.0
    greatest_deg: float = 720.0


Asked = Generator[None, None, "Answer | Move"]


class Asking:
    """What a walk leans on. Every `yield` waits for the next status or answer."""

    def __init__(self, known: Known) -> None:
        self.known = known
        self.prompt = ""
        """What is asked just now."""
        self._words: Words = words_for(known.axis)
        self._watch = Watch(known.axis)
        self._status: Status | None = None
        self._answer: Answer | None = None
        self._move: Move | None = None
        self._fault = ""
        self._noticed: tuple[str, ...] = ()
        self._stood = False
        self._measuring = False
        self._lines: list[str] = []
        self._orders: list[Order] = []

    def ready(self, answer: Answer) -> bool:
        """Whether an answer typed ahead is to be given now: a press may follow a press, all else waits for rest."""
        if isinstance(answer, Halt):
            return True
        if isinstance(answer, Press):
            return not self._watch.driven and not self._measuring
        return self._watch.resting and not self._measuring

    def way(self, direction: Direction) -> str:
        return self._words.plus if direction > 0 else self._words.minus

    def _take(self, status: Status, answer: Answer | None) -> None:
        self._status, self._answer = status, answer
        self._move = self._watch.see(status)
        self._notice()

    # --- one question

    def _ask(self, prompt: str, *, may_turn: bool = True) -> Asked:
        """The next thing that happens: an answer, or the end of a turn. Presses are obeyed meanwhile."""
        self.prompt = prompt
        while True:
            yield
            match self._answer:
                case Press() as press:
                    self._press(press, may_turn=may_turn)
                case Halt():
                    self._watch.halt()
                    self._orders.append(Stop())
                case Unknown(text):
                    self._say(f"{text.strip()!r} means nothing here. {self._words.keys}")
                case answer if answer is not None and self._move is None:
                    return answer
            if self._move is not None:
                # An answer that came in the same instant was to a question of before.
                return self._move

    def _agrees(self, prompt: str) -> Generator[None, None, bool]:
        while True:
            match (yield from self._ask(prompt, may_turn=False)):
                case Yes():
                    return True
                case No():
                    return False
                case Move():
                    pass
                case _:
                    self._say("y or n, please.")

    def _number(self, prompt: str, proposed: float | None) -> Generator[None, None, float | None]:
        """None: the person would rather read again."""
        shown = prompt if proposed is None else f"{prompt} [{proposed:g}]"
        while True:
            match (yield from self._ask(shown, may_turn=False)):
                case Number(value) if self.known.least_deg <= value <= self.known.greatest_deg:
                    return value
                case Number(value):
                    self._say(f"{value:g}° is no angle of this axis: {self._words.scale}.")
                case Enter() if proposed is not None:
                    return proposed
                case No():
                    return None
                case Move():
                    pass
                case _:
                    self._say("A number of degrees and Enter, please; n to read again.")

    def _measured(self) -> Generator[None, None, Measured]:
        """Many readings of an axis at rest. Raises Doubt."""
        self.prompt = "Reading; hands off."
        self._measuring = True
        self._orders.append(Stop())
        try:
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
            return measure(readings, self.known.lowest_reading, self.known.highest_reading)
        finally:
            self._measuring = False

    # --- what happens by the way

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
        text = str(fault) if fault else ""
        if text != self._fault:
            self._fault = text
            if text:
                self._say(f"FAULT {text}")
        if not self._stood and self._watch.stands():
            self._stood = True
            self._say("The reading stands still: it is at its stop, or something is wrong.")
        if self._move is not None and self._move.turned is not None:
            way, moved = self.way(self._move.direction), self._move.turned
            self._say(f"  {way}: reading {moved.before:.4f} to {moved.after:.4f} ({moved.change:+.4f})")

    def _say(self, *lines: str) -> None:
        self._lines += lines
