"""A walk through questions, written down as one path from top to bottom: statuses and answers in, text and orders out.

Knows how a question is put and what becomes of an answer that does not fit. Pure: no clock, no terminal, no file. Knows
nothing of what is asked: that is each guide's.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from rotator.calibrating.answers import Answer, Enter, Halt, No, Number, Press, Quit, Unknown, Yes
from rotator.orders import Order, Stop
from rotator.status import Status

Steps = Generator[None, None, None]
"""Every `yield` waits for the next status or answer."""
Asked = Generator[None, None, object]
"""Ends with an answer, or with something that has happened meanwhile."""


@dataclass(frozen=True, slots=True)
class Turn:
    """What a step leads to."""

    lines: tuple[str, ...]
    orders: tuple[Order, ...]


class Refused(Exception):  # noqa: N818 - the walk ends here; it is no failure of the program
    """It makes no sense to go on."""


class Walk:
    """Call `step` with every status and every answer until `ended`. `keys`: what a person can type."""

    def __init__(self, keys: str, least_deg: float, greatest_deg: float) -> None:
        self.prompt = ""
        """What is asked just now."""
        self.ended = False
        self._keys = keys
        self._least_deg, self._greatest_deg = least_deg, greatest_deg
        self._status: Status | None = None
        self._answer: Answer | None = None
        self._event: object = None
        """What has happened with this status, for whoever waits for an answer."""
        self._lines: list[str] = []
        self._orders: list[Order] = []
        self._asking = False
        """A question is open."""
        self._walking = self._walk()

    def step(self, status: Status, answer: Answer | None = None) -> Turn:
        try:
            self._take(status, answer)
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

    def ready(self, answer: Answer) -> bool:
        """Whether an answer typed ahead is to be given now."""
        raise NotImplementedError

    def _walk(self) -> Steps:
        raise NotImplementedError

    def _press(self, press: Press, *, may_turn: bool) -> None:
        """A person wants to turn something, while a question is open."""
        raise NotImplementedError

    def _take(self, status: Status, answer: Answer | None) -> None:
        """Raises Refused where that is the end of it."""
        self._status, self._answer = status, answer

    def _halt(self) -> None:
        self._orders.append(Stop())

    # --- one question

    def _ask(self, prompt: str, *, may_turn: bool = True) -> Asked:
        """The next thing that happens: an answer, or an event. Presses are obeyed meanwhile."""
        self.prompt, self._asking = prompt, True
        try:
            while True:
                yield
                match self._answer:
                    case Press() as press:
                        self._press(press, may_turn=may_turn)
                    case Halt():
                        self._halt()
                    case Unknown(text):
                        self._say(f"{text.strip()!r} means nothing here. {self._keys}")
                    case answer if answer is not None and self._event is None:
                        return answer
                if self._event is not None:
                    # An answer that came in the same instant was to a question of before.
                    return self._event
        finally:
            self._asking = False

    def _agrees(self, prompt: str) -> Generator[None, None, bool]:
        while True:
            match (yield from self._ask(prompt, may_turn=False)):
                case Yes():
                    return True
                case No():
                    return False
                case event if event is self._event:
                    pass
                case _:
                    self._say("y or n, please.")

    def _number(self, prompt: str, proposed: float | None) -> Generator[None, None, float | None]:
        """An angle; None: the person would rather do the step before again."""
        shown = prompt if proposed is None else f"{prompt} [{proposed:g}]"
        while True:
            match (yield from self._ask(shown, may_turn=False)):
                case Number(value) if self._is_angle(value):
                    return value
                case Number(_):
                    pass
                case Enter() if proposed is not None:
                    return proposed
                case No():
                    return None
                case event if event is self._event:
                    pass
                case _:
                    self._say("A number of degrees and Enter, please; n to read again.")

    def _is_angle(self, angle_deg: float) -> bool:
        """Whether there can be such an angle; if not, that is said."""
        if self._least_deg <= angle_deg <= self._greatest_deg:
            return True
        self._say(f"{angle_deg:g}° is no angle of this axis: {self._least_deg:g} to {self._greatest_deg:g}.")
        return False

    def _say(self, *lines: str) -> None:
        self._lines += lines
