"""Walks a person through setting up an axis whose readings are degrees: a count, a controller, a model, gravity.

There is no table to be made: only directions, the end stop of a count, and the limits. Pure, and one path from top to
bottom, as the guide for pots is. Knows no driver: what is different about a kind of rotor it is told (`Kind`).
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import AngleSource, Direction
from rotator.calibrating.answers import Enter, Halt, Number
from rotator.calibrating.asking import Asking, Commissioned, Known
from rotator.calibrating.readings import Doubt
from rotator.calibrating.table import LEAST_SPAN_DEG
from rotator.calibrating.walk import Refused, Steps
from rotator.calibrating.watch import Move
from rotator.faults import FaultKind, Missing
from rotator.orders import Confirm, Home, Stop
from rotator.status import AxisStatus

BEGIN_S = 0.5
"""An order has been heard within this."""
PLACED_S = 5.0
"""A controller knows its place so soon after it was told."""


@dataclass(frozen=True, slots=True)
class Kind:
    """What the guide has to know of the rotor."""

    rotor: str
    """Its type, as the file has it."""
    source: AngleSource
    """How its angle is known: measured, counted or modelled."""
    shift_deg: float = 0.0
    """Added to the rotor's own scale to have what the box reports."""
    warning: str = ""
    """What a person should expect of the first press; empty: nothing."""


class DegreesGuide(Asking):
    def __init__(self, known: Known, kind: Kind) -> None:
        super().__init__(known)
        self._kind = kind

    def _walk(self) -> Steps:
        words = self._words
        self._say(*words.introduction)
        if self._kind.warning:
            self._say("", self._kind.warning)
        yield from self._place()
        self._say("", *words.direction_check)
        if self._kind.source is AngleSource.COUNTED:
            yield from self._check_by_eye()
            yield from self._home()
        else:
            yield from self._check_by_reading()
        number = 3 if self._kind.source is AngleSource.COUNTED else 2
        low_deg = yield from self._limit(f"{number}. The lowest", self.known.min_deg, self.known.least_deg)
        high_deg = yield from self._limit(f"{number + 1}. The highest", self.known.max_deg, low_deg + LEAST_SPAN_DEG)
        self._say(*words.degrees_summary(low_deg, high_deg))
        if (yield from self._agrees("Save this? y or n:")):
            self.result = Commissioned(self.known.axis, None, low_deg, high_deg)
        else:
            self._say("Nothing is saved.")

    # --- where it stands

    def _place(self) -> Steps:
        """A controller behind a gear does not know where it stands after power-on; nothing moves before that."""
        yield
        began_s = self._now_s
        while self._raw is None and not self._unplaced and self._now_s - began_s < PLACED_S:
            yield
        while self._unplaced:
            self._say("", "The controller does not know where it stands. Look at the antenna.")
            angle_deg = yield from self._number("Which angle is that on the rotor's own scale?", None)
            if angle_deg is not None:
                yield from self._confirm(angle_deg)

    def _confirm(self, angle_deg: float) -> Steps:
        self._orders.append(Confirm(self.known.axis, angle_deg + self._kind.shift_deg))
        began_s = self._now_s
        while self._unplaced and self._now_s - began_s < PLACED_S:
            yield
        self._say("It does not take it." if self._unplaced else f"It stands at {self._shown()}.")

    @property
    def _unplaced(self) -> bool:
        fault = self._axis.fault
        return fault is not None and fault.kind is FaultKind.POSITION_UNKNOWN

    # --- directions

    def _check_by_reading(self) -> Steps:
        """What drives it is not what measures it, or may not be: both must agree with the eye."""
        words = self._words
        change = yield from self._turn(Direction.PLUS, words.turn_plus, 0)
        if not (yield from self._agrees(words.did_it_turn)):
            raise Refused(words.wrong_way(self._kind.rotor))
        if change < 0:
            raise Refused(words.reads_backwards)
        yield from self._turn(Direction.MINUS, words.turn_minus, -1)
        self._say("The degrees grow and shrink as they should: the directions are right.")

    def _check_by_eye(self) -> Steps:
        """A count takes its direction from the relays: only the eye sees which way it turned."""
        words = self._words
        for direction, prompt, question in (
            (Direction.PLUS, words.turn_plus, words.did_it_turn),
            (Direction.MINUS, words.turn_minus, words.did_it_turn_back),
        ):
            while True:
                event = yield from self._ask(prompt)
                if isinstance(event, Move) and event.direction is direction:
                    break
                if not isinstance(event, Move):
                    self._say(words.press_first)
            if not (yield from self._agrees(question)):
                raise Refused(words.swap)
        self._say("The directions are right.")

    # --- the end stop

    def _home(self) -> Steps:
        self._say("", "2. The end stop, where the count begins.", *self._words.homing)
        if not self._lost:
            # What it counted with relays that were exchanged is not where it stands.
            question = f"It says that it stands at {self._shown()}. Look for the stop all the same? y or n:"
            if (yield from self._agrees(question)):
                yield from self._homing()
        while self._lost or self._fault:
            if not (yield from self._agrees("Look for it now? y or n:")):
                raise Refused("Left: without its end stop it does not know where it stands. Nothing is saved.")
            yield from self._homing()
        self._say(f"It stands at {self._shown()}.")

    def _homing(self) -> Steps:
        """Until it stands again, whatever came of it."""
        if self._fault:
            self._orders.append(Stop())
        self._orders.append(Home(self.known.axis))
        self.prompt = "It looks for its stop; s stops it."
        began_s = self._now_s
        while self._now_s - began_s < BEGIN_S or self._axis.homing or self._axis.moving:
            if isinstance(self._answer, Halt):
                self._halt()
                self._say("Stopped.")
            yield

    @property
    def _lost(self) -> bool:
        """Nobody knows where it stands."""
        return Missing.HOMING in self._axis.missing

    @property
    def _tells(self) -> bool:
        return not self._lost

    # --- limits

    def _limit(self, which: str, now_deg: float, least_deg: float) -> Generator[None, None, float]:
        self._say("", *self._words.limit(which))
        while True:
            event = yield from self._ask(f"Enter: here; or an angle (in the file: {now_deg:g}):")
            match event:
                case Enter():
                    angle_deg = yield from self._here()
                case Number(value) if self._is_angle(value):
                    angle_deg = value
                case Number(_) | Move():
                    continue
                case _:
                    self._say("Drive there and Enter, or type the angle.")
                    continue
            if angle_deg is None:
                continue
            if angle_deg >= least_deg:
                self._say(f"Taken: {angle_deg:g}°.")
                return angle_deg
            self._say(f"Refused: {angle_deg:g}° is too low, at least {least_deg:g}° it must be.")

    def _here(self) -> Generator[None, None, float | None]:
        try:
            measured = yield from self._measured()
        except Doubt as doubt:
            self._say(f"Refused: {doubt}.")
            return None
        angle_deg = round(measured.raw, 1) + 0.0
        return angle_deg if self._is_angle(angle_deg) else None

    # --- how it stands

    @property
    def _axis(self) -> AxisStatus:
        assert self._status is not None, "a step has a status"
        return self._status.axis(self.known.axis)

    @property
    def _now_s(self) -> float:
        assert self._status is not None, "a step has a status"
        return self._status.at_s

    @property
    def _raw(self) -> float | None:
        return self._axis.raw

    def _shown(self) -> str:
        return "----" if self._raw is None else self.reading(self._raw)
