"""A guide through questions, written as one path from top to bottom: statuses and entries in, text and orders out.

Knows how a question is asked and what happens with an entry that does not fit. Pure: no clock, no terminal, no file.
Does not know what is asked: each subclass writes its own path.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace

from rotator.calibrating.entries import NUMBER_FORM, TAP_S, Entry, Number, Press, StopNow, Unknown, Word
from rotator.calibrating.question import NO, YES, Choice, Question
from rotator.calibrating.results import Result
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Jog, Order, Stop
from rotator.exchange.spoken import sender
from rotator.exchange.status import AxisStatus, Status

Steps = Generator[None, None, None]
"""Every `yield` waits for the next status or entry."""
Asked = Generator[None, None, object]
"""Ends with an entry, or with an event that happened meanwhile."""

ANSWERS = (Word, Number, Unknown)
BACK = (Choice("Back", "b"),)
TO_NUMBER = Question(choices=BACK)
NOTHING_SAVED = "Nothing is saved."
LEFT = "Left: nothing is saved."
ORDER_TAKEN_S = 0.5
"""An order shows in the status after this time at the latest."""
CONFIRM_S = 5.0
"""A motor controller reports its angle within this time after it was connected, or after the operator confirmed it."""


@dataclass(frozen=True, slots=True)
class StepResult:
    """What one step leads to."""

    lines: tuple[str, ...]
    orders: tuple[Order, ...]


class Abandoned(Exception):  # noqa: N818 - the guide ends here; the program has not failed
    """The guide cannot go on. The text is the last line the operator sees."""


def refused(reason: object) -> Abandoned:
    """The end of a guide that cannot go on for this reason, a sentence without its full stop."""
    return Abandoned(f"Refused: {reason}. {NOTHING_SAVED}")


def position_unknown(axis: AxisStatus) -> bool:
    """A controller behind a gear does not know its angle after power-on."""
    return axis.fault is not None and axis.fault.kind is FaultKind.POSITION_UNKNOWN


class Guide:
    """Call `step` with every status and every entry until `ended`.

    `keys` lists what the operator can type. Angles outside `least_deg` to `greatest_deg` are refused.
    """

    result: Result | None = None
    """None: it has not ended, or without a result."""

    def __init__(self, keys: str, least_deg: float, greatest_deg: float) -> None:
        self.prompt = ""
        """The question that is open now, for a terminal."""
        self.question = Question()
        """The same for a view with buttons, and what else is to be seen there."""
        self.asked = 0
        """How many questions there have been: an answer to another one than the latest comes too late."""
        self.stages: tuple[str, ...] = ()
        self.stage = ""
        """One of `stages`: how far it is."""
        self.remarks: list[str] = []
        """What it has said since the latest answer or movement, without what belongs to a question."""
        self.ended = False
        self._keys = keys
        self._least_deg, self._greatest_deg = least_deg, greatest_deg
        self._latest: Status | None = None
        self._entry: Entry | None = None
        self._event: object = None
        """What happened with this status; it ends an open question as an entry does."""
        self._lines: list[str] = []
        self._orders: list[Order] = []
        self._asking = False
        """A question is open."""
        self._accepts = ""
        """What the open question accepts."""
        self._steps = self._path()

    def step(self, status: Status, entry: Entry | None = None) -> StepResult:
        try:
            self._take(status, entry)
            if entry is Word.QUIT:
                raise Abandoned(LEFT)
            if not self._asking and isinstance(entry, ANSWERS):
                self._say("Not taken: wait until the box asks.")
            next(self._steps)
        except StopIteration:
            self.ended = True
        except Abandoned as reason:
            self._say(str(reason))
            self.ended = True
        if self.ended:
            self.prompt = ""
            self._orders.append(Stop())
        result = StepResult(tuple(self._lines), tuple(self._orders))
        self._lines.clear()
        self._orders.clear()
        return result

    def ready(self, entry: Entry) -> bool:
        """Whether an entry that was typed ahead may be given to `step` now."""
        raise NotImplementedError

    def _path(self) -> Steps:
        raise NotImplementedError

    def _press(self, press: Press, *, may_turn: bool) -> None:
        """The operator wants to turn an axis while a question is open."""
        raise NotImplementedError

    def _take(self, status: Status, entry: Entry | None) -> None:
        """Note the status and the entry. Raises Abandoned where the status ends the guide."""
        self._latest, self._entry = status, entry
        if status.latched:
            # Over the console's socket, or at the panel: what this guide orders has no effect any more.
            raise Abandoned(f"Stopped by {sender(status.latched)}: the motors stand. {NOTHING_SAVED}")

    def _halt(self) -> None:
        self._orders.append(Stop())

    # --- the latest status

    @property
    def _status(self) -> Status:
        assert self._latest is not None, "the path runs only in a step, and a step has a status"
        return self._latest

    @property
    def _now_s(self) -> float:
        return self._status.at_s

    @property
    def _axis(self) -> AxisStatus:
        """The axis that is being set up."""
        raise NotImplementedError

    def _await_axis(self) -> Steps:
        """Wait until the axis has a reading, or its controller reports that it does not know its angle."""
        began_s = self._now_s
        while self._axis.raw is None and not position_unknown(self._axis) and self._now_s - began_s < CONFIRM_S:
            yield

    # --- one question

    def _show(self, prompt: str, page: Question) -> None:
        """From now on this is asked, or waited for."""
        if page != self.question:
            self.asked += 1
        self.prompt, self.question = prompt, page

    def _ask(
        self,
        prompt: str,
        accepts: str,
        page: Question | None = None,
        *,
        may_turn: bool = True,
        may_go_back: bool = False,
    ) -> Asked:
        """Ask, and end with the next entry or event. Presses are obeyed meanwhile. `accepts`: what may be typed.

        `page`: the same for a view with buttons, of a guide that such a view can show.
        """
        self._accepts, self._asking = accepts, True
        self._show(prompt, replace(page or Question(prompt), turns=may_turn))
        try:
            while True:
                yield
                match self._entry:
                    case Press() as press:
                        self._press(press, may_turn=may_turn)
                    case StopNow():
                        self._halt()
                    case Unknown(text, form):
                        self._say(f"{text.strip()!r} means nothing here. {form or f'{accepts} ? lists all keys.'}")
                    case Word.HELP:
                        self._say(f"{accepts} {self._keys}")
                    case Word.BACK if not may_go_back:
                        self._say(f"There is nothing to take back here. {accepts}")
                    case entry if entry is not None and self._event is None:
                        self.remarks.clear()
                        return entry
                if self._event is not None:
                    # An entry that came in the same instant answered the question before this event.
                    return self._event
        finally:
            self._asking = False

    def _agrees(
        self,
        title: str,
        picture: str = "",
        hint: tuple[str, ...] = (),
        *,
        yes: str = "Yes",
        no: str = "No",
        prompt: str = "",
    ) -> Generator[None, None, bool]:
        """`title`: the question; `prompt`: the same for a terminal, where it is another sentence."""
        page = Question(title, hint, picture, (replace(YES, words=yes), replace(NO, words=no)))
        prompt = prompt or f"{title} y or n:"
        while True:
            match (yield from self._ask(prompt, "Type y for yes or n for no.", page, may_turn=False)):
                case Word.YES:
                    return True
                case Word.NO:
                    return False
                case event if event is self._event:
                    pass
                case _:
                    self._say(self._accepts)

    def _number(
        self, prompt: str, proposed: float | None, page: Question = TO_NUMBER
    ) -> Generator[None, None, float | None]:
        """An angle in degrees. None: the operator wants to repeat the step before."""
        shown = prompt if proposed is None else f"{prompt} [{proposed:g}]"
        enter = "" if proposed is None else f"Enter alone takes {proposed:g}; "
        accepts = f"{NUMBER_FORM} {enter}n or b: one step back."
        page = replace(page, title=page.title or prompt, number=True, proposed=proposed)
        while True:
            match (yield from self._ask(shown, accepts, page, may_turn=False, may_go_back=True)):
                case Number(value) if self._is_angle(value):
                    self._lead(f"  Understood: {value:g}°.")
                    return value
                case Number(_):
                    pass
                case Word.ENTER if proposed is not None:
                    self._lead(f"  Taken: {proposed:g}°.")
                    return proposed
                case Word.NO | Word.BACK:
                    return None
                case event if event is self._event:
                    pass
                case _:
                    self._say(self._accepts)

    def _is_angle(self, angle_deg: float) -> bool:
        """Whether the axis can have this angle; if not, say so."""
        if self._least_deg <= angle_deg <= self._greatest_deg:
            return True
        self._say(f"{angle_deg:g}° is no angle of this axis: {self._least_deg:g} to {self._greatest_deg:g}.")
        return False

    def _say(self, *lines: str) -> None:
        self._lines += lines
        self.remarks += [line.strip() for line in lines if line]

    def _lead(self, *lines: str) -> None:
        """In a terminal, what a view with buttons shows with its question."""
        self._lines += lines

    def _head(self, head: str, *below: str) -> None:
        """In a terminal, the head of a new part and what is to be known for it."""
        self._lead("", head, *(f"   {line}" for line in below))


class SteeringGuide(Guide):
    """With it a person steers the whole antenna, by presses for either axis. An answer waits until it stands again.

    `tap_s`: how long one key press turns an axis.
    """

    def __init__(self, keys: str, tap_s: float = TAP_S) -> None:
        super().__init__(keys, -360.0, 720.0)
        self._tap_s = tap_s
        self._pressed_s: float | None = None
        """When the latest press was ordered; None: there was none."""

    def ready(self, entry: Entry) -> bool:
        if isinstance(entry, StopNow):
            return True
        pressed = self._pressed_s is not None and self._now_s - self._pressed_s < ORDER_TAKEN_S
        return self._asking and not (pressed or self._latest is None or self._latest.moving)

    @property
    def _axis(self) -> AxisStatus:
        return self._status.azimuth

    def _press(self, press: Press, *, may_turn: bool) -> None:
        if not may_turn:
            self._say(f"It turns again after your answer. {self._accepts}")
        elif press.seconds > 0:
            self._pressed_s = self._now_s
            seconds = self._tap_s if press.seconds == TAP_S else press.seconds
            self._orders.append(Jog(press.axis, press.direction, seconds))
