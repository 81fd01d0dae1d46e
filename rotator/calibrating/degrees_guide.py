"""Guides the operator through an axis whose readings are degrees: a count, a controller, a model, gravity.

Such an axis needs no table: only the direction check, the end stop of a count, and the limits. Pure, and one path from
top to bottom (`_path`). Does not know drivers: how kinds of rotors differ is in `AxisFacts`.
"""

from __future__ import annotations

from collections.abc import Generator

from hw.ports import Direction
from rotator.calibrating.axis_guide import AxisGuide
from rotator.calibrating.entries import Number, StopNow, Word
from rotator.calibrating.guide import CONFIRM_S, ORDER_TAKEN_S, Abandoned, Steps, position_unknown
from rotator.calibrating.question import HALT, Choice, Question
from rotator.calibrating.reading_watch import AxisMoved
from rotator.calibrating.readings import NotTrusted
from rotator.calibrating.results import AxisCalibrated
from rotator.calibrating.table_draft import LEAST_SPAN_DEG
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Confirm, Home, Stop
from rotator.exchange.status import AxisStatus


def needs_homing(axis: AxisStatus) -> bool:
    """The axis counts pulses and its count is not known."""
    return Missing.HOMING in axis.missing


class DegreesGuide(AxisGuide):
    def _path(self) -> Steps:
        phrases, facts = self._phrases, self.facts
        self._lead(*phrases.introduction)
        if self.facts.first_press:
            self._say("", self.facts.first_press)
        yield from self._find_position()
        homes, limits = ("End stop",) * self.facts.homes, ("Lowest angle", "Highest angle")
        self.stages = ("Directions", *homes, *(() if self.facts.endless else limits), "Save")
        self.stage = "Directions"
        self._head("1. Directions.", *phrases.direction_check)
        if self.facts.homes:
            yield from self._check_by_eye()
            if (yield from self._times()):
                return
            yield from self._find_end_stop()
        else:
            yield from self._check_by_reading()
        number = 3 if self.facts.homes else 2
        if self.facts.endless:
            low_deg, high_deg = facts.min_deg, facts.max_deg
            learnt = phrases.no_ends
            keys = f"[{facts.axis.value}]: no ends, direction checked."
        else:
            low_deg = yield from self._limit(number, "lowest", facts.min_deg, facts.least_deg)
            high_deg = yield from self._limit(number + 1, "highest", facts.max_deg, low_deg + LEAST_SPAN_DEG)
            learnt = phrases.may_be_sent(low_deg, high_deg)
            keys = f"[{facts.axis.value}]: limits {low_deg:g} to {high_deg:g}, direction checked."
        result = AxisCalibrated(facts.axis, None, low_deg, high_deg)
        yield from self._save(result, keys, (phrases.directions_right, learnt))

    # --- the angle after power-on

    def _find_position(self) -> Steps:
        """Ask for the angle: after power-on a controller behind a gear does not know it, and does not move before."""
        yield
        yield from self._await_axis()
        while self._unknown:
            unknown = f"The {self._who} does not know where it stands. Look at the antenna."
            self._lead("", unknown)
            which = "Which angle is that on the rotor's own scale?"
            angle_deg = yield from self._number(which, None, Question(hint=(unknown,), picture="angle"))
            if angle_deg is not None:
                yield from self._confirm(angle_deg)

    @property
    def _unknown(self) -> bool:
        """Only a person can say where the axis stands."""
        return position_unknown(self._axis) or (needs_homing(self._axis) and not self.facts.homes)

    @property
    def _who(self) -> str:
        return "box" if needs_homing(self._axis) else "controller"

    def _confirm(self, angle_deg: float) -> Steps:
        self._orders.append(Confirm(self.facts.axis, angle_deg + self.facts.shift_deg))
        began_s = self._now_s
        while self._unknown and self._now_s - began_s < CONFIRM_S:
            yield
        if self._unknown:
            self._say(f"The {self._who} did not accept this angle.")
        else:
            self._say(f"It stands at {self._angle_text()}.")

    # --- directions

    def _check_by_reading(self) -> Steps:
        """The sensor may be another device than the drive: both must agree with the operator's eye."""
        phrases = self._phrases
        change = yield from self._turn(Direction.PLUS, 0)
        if not (yield from self._agrees(phrases.did_it_turn, "plus")):
            raise Abandoned(phrases.turned_wrong(self.facts.reversal))
        if change < 0:
            raise Abandoned(phrases.reads_backwards)
        yield from self._turn(Direction.MINUS, -1)
        self._say("The degrees grow and shrink as they should: the directions are right.")

    def _check_by_eye(self) -> Steps:
        """A count takes its direction from the relays, so only the eye sees which way the antenna turned."""
        phrases = self._phrases
        for direction, picture, question in (
            (Direction.PLUS, "plus", phrases.did_it_turn),
            (Direction.MINUS, "minus", phrases.did_it_turn_back),
        ):
            while True:
                event = yield from self._ask_to_turn(direction)
                if isinstance(event, AxisMoved) and event.direction is direction:
                    break
                if not isinstance(event, AxisMoved):
                    self._say(self._accepts)
            if not (yield from self._agrees(question, picture)):
                raise Abandoned(phrases.swap)
        self._say("The directions are right.")

    # --- the end stop

    def _times(self) -> Generator[None, None, bool]:
        """Whether the axis has been timed from stop to stop, and nothing more is to be asked."""
        yield from ()
        return False

    def _find_end_stop(self) -> Steps:
        self._head("2. The end stop, where the count begins.", *self._phrases.homing, "Space or s stops it.")
        self.stage = "End stop"
        shown = "home", self._phrases.homing
        if not needs_homing(self._axis):
            # A count made with exchanged relays is not the antenna's angle.
            question = f"It says that it stands at {self._angle_text()}. Look for the stop all the same?"
            if (yield from self._agrees(question, *shown, yes="Look for it", no="No")):
                yield from self._home()
        while needs_homing(self._axis) or self._fault_text:
            now = "Look for it now?"
            title = "It looks for its end stop, where the count begins. Now?"
            if not (yield from self._agrees(title, *shown, yes="Look for it now", no="Leave", prompt=f"{now} y or n:")):
                raise Abandoned("Left: without its end stop it does not know where it stands. Nothing is saved.")
            yield from self._home()
        self._say(f"It stands at {self._angle_text()}.")

    def _home(self) -> Steps:
        """Home the axis, and wait until it stands again, with or without success."""
        if self._fault_text:
            self._orders.append(Stop())
        self._orders.append(Home(self.facts.axis))
        page = Question("It looks for its stop.", self._phrases.homing, "home", (HALT,))
        self._show("It looks for its stop; s stops it.", page)
        began_s = self._now_s
        while self._now_s - began_s < ORDER_TAKEN_S or self._axis.homing or self._axis.moving:
            if isinstance(self._entry, StopNow):
                self._halt()
                self._say("Stopped.")
            yield

    @property
    def _readings_count(self) -> bool:
        return not needs_homing(self._axis)

    # --- limits

    def _limit(self, step: int, which: str, now_deg: float, least_deg: float) -> Generator[None, None, float]:
        limit = self._phrases.limit
        self._head(f"{step}. The {which} angle that it may be sent to: drive it there, or type it.", *limit)
        self.stage = f"{which.capitalize()} angle"
        title, picture = f"The {which} angle that it may be sent to?", "low" if which == "lowest" else "high"
        hint = ("Turn it there, or type the angle.", *limit)
        page = Question(title, hint, picture, (Choice("Where it stands now", "\r"),), number=True, proposed=now_deg)
        while True:
            prompt = f"Enter: here; or an angle (in the file: {now_deg:g}):"
            event = yield from self._ask(prompt, "Drive there, then Enter or y; or type the angle.", page)
            match event:
                case Word.ENTER | Word.YES:
                    angle_deg = yield from self._angle_here()
                case Number(value) if self._is_angle(value):
                    angle_deg = value
                case Number(_) | AxisMoved():
                    continue
                case _:
                    self._say(self._accepts)
                    continue
            if angle_deg is None:
                continue
            if angle_deg >= least_deg:
                self._say(f"Taken: {angle_deg:g}°.")
                return angle_deg
            self._say(f"Refused: {angle_deg:g}° is too low, it must be {least_deg:g}° or more.")

    def _angle_here(self) -> Generator[None, None, float | None]:
        try:
            measured = yield from self._measured()
        except NotTrusted as reason:
            self._say(f"Refused: {reason}.")
            return None
        angle_deg = round(measured.raw, 1) + 0.0
        return angle_deg if self._is_angle(angle_deg) else None

    def _angle_text(self) -> str:
        raw = self._axis.raw
        return "----" if raw is None else self.reading_text(raw)
