"""The part of a guide that sets up one axis: presses, faults on the way, direction checks, and readings at rest.

Knows what happens with a press, how a direction check judges the result, and how a reading is taken. Does not know the
order of the questions: `table_guide` and `degrees_guide` do.
"""

from __future__ import annotations

import math
from collections.abc import Generator

from hw.ports import Direction
from rotator.calibrating.entries import Entry, Press, StopNow
from rotator.calibrating.facts import AxisFacts
from rotator.calibrating.guide import NOTHING_SAVED, Abandoned, Asked, Guide, Steps
from rotator.calibrating.phrases import Phrases, phrases_for
from rotator.calibrating.question import Question
from rotator.calibrating.reading_watch import AxisMoved, ReadingWatch
from rotator.calibrating.readings import READINGS, Measured, NotTrusted, measure
from rotator.calibrating.results import AxisCalibrated, Saved
from rotator.exchange.faults import FaultKind, Notice
from rotator.exchange.orders import Jog, Stop
from rotator.exchange.status import AxisStatus, Status

ACKNOWLEDGED_S = 0.3
"""A fault that remains this long after it was acknowledged is still present."""
CONNECT_S = 3.0
"""Connecting to a motor controller takes this long; until then its silence is not reported."""


def turned_the_wrong_way(axis: AxisStatus) -> bool:
    """The reading moved against the motor. This fault stops the axis before the press is over."""
    return axis.fault is not None and axis.fault.kind is FaultKind.WRONG_WAY


class AxisGuide(Guide):
    def __init__(self, facts: AxisFacts) -> None:
        self.facts = facts
        self.result: Saved | None = None
        self.points: tuple[tuple[float, float], ...] = ()
        """(reading, degrees) of what has been taken so far."""
        self.runs_s: float | None = None
        """How long the motor runs that is being timed."""
        self._phrases: Phrases = phrases_for(facts.axis)
        super().__init__(self._phrases.keys, facts.least_deg, facts.greatest_deg)
        self._watch = ReadingWatch(facts.axis, facts.unit, facts.settle_s)
        self._began_s = math.inf
        self._fault_text = ""
        self._notices: tuple[Notice, ...] = ()
        self._standstill_reported = False

    def ready(self, entry: Entry) -> bool:
        """A press may follow a press; every other entry waits until the axis rests."""
        if isinstance(entry, StopNow):
            return True
        if isinstance(entry, Press) and not self.facts.settle_s:
            return not self._watch.driven and self._asking
        return self._watch.resting and self._asking

    def direction_text(self, direction: Direction) -> str:
        return self._phrases.plus if direction > 0 else self._phrases.minus

    def reading_text(self, raw: float) -> str:
        """A reading as the operator sees it."""
        return self.facts.unit.text(raw)

    @property
    def _axis(self) -> AxisStatus:
        return self._status.axis(self.facts.axis)

    def _take(self, status: Status, entry: Entry | None) -> None:
        super()._take(status, entry)
        self._began_s = min(self._began_s, status.at_s)
        self._event = self._watch.see(status)
        self._report()

    @property
    def _readings_count(self) -> bool:
        """Whether the readings mean anything yet."""
        return True

    def _save(self, result: AxisCalibrated, keys: str, learnt: tuple[str, ...]) -> Steps:
        """End with this result, if the operator agrees. `keys`: what is saved, for a terminal."""
        self.stage = "Save"
        self._lead("", keys)
        if (yield from self._agrees("Save this?", "save", learnt, yes="Save it", no="Leave, save nothing")):
            self.result = result
        else:
            self._say(NOTHING_SAVED)

    # --- directions

    def _turn(self, direction: Direction, sign: int) -> Generator[None, None, float]:
        """Ask for presses until the reading has changed enough in one direction. Returns the change.

        `sign`: the direction that the reading must change in, 1 or -1; 0: either. Raises Abandoned.
        """
        total, enough = 0.0, self.facts.unit.least_turn
        while abs(total) < enough:
            event = yield from self._ask_to_turn(direction)
            if not isinstance(event, AxisMoved):
                self._say(self._accepts)
                continue
            if event.direction is not direction:
                continue
            if event.movement is None:
                if turned_the_wrong_way(self._axis):
                    total = -enough * direction
                continue
            change, objection = event.movement.change, event.movement.objection()
            if not objection and sign and change * sign < 0:
                raise Abandoned(self._phrases.same_way)
            if not objection and change * total < 0:
                objection = "the reading went the other way than a moment ago, though the motor ran the same way"
            if objection:
                self._say(f"Not accepted: {objection}. Press once more.")
                total = 0.0
                continue
            total += change
            if abs(total) < enough:
                self._say("A little further.")
        if sign and total * sign < 0:
            raise Abandoned(self._phrases.same_way)
        return total

    def _ask_to_turn(self, direction: Direction) -> Asked:
        phrases, there = self._phrases, direction is Direction.PLUS
        prompt = phrases.turn_plus if there else phrases.turn_minus
        title = phrases.page_turn_plus if there else phrases.page_turn_minus
        page = Question(title, phrases.direction_check if there else (), "plus" if there else "minus")
        return (yield from self._ask(prompt, phrases.press_first, page))

    # --- a reading

    def _measured(self) -> Generator[None, None, Measured]:
        """The mean of many readings of the axis at rest. Raises NotTrusted."""
        self._show("Reading; hands off.", Question("It is being read: hands off.", picture="reading"))
        self._orders.append(Stop())
        begun_s, seen_s, readings = None, None, list[float]()
        while len(readings) < READINGS:
            yield
            if isinstance(self._entry, (Press, StopNow)):
                raise NotTrusted("not while it is being read: press when the box asks again")
            if self._now_s == seen_s or not self._watch.resting:
                continue
            seen_s, axis = self._now_s, self._axis
            begun_s = seen_s if begun_s is None else begun_s
            if seen_s - begun_s < ACKNOWLEDGED_S:
                continue
            if axis.raw is not None and axis.fault is None:
                readings.append(axis.raw)
            elif axis.fault is not None:
                raise NotTrusted(str(axis.fault))
        return measure(readings, self.facts.lowest_reading, self.facts.highest_reading, self.facts.unit)

    # --- presses and faults

    def _halt(self) -> None:
        self._watch.halt()
        super()._halt()

    def _press(self, press: Press, *, may_turn: bool) -> None:
        if press.axis is not self.facts.axis:
            self._say(f"This is the {self.facts.axis.value}. {self._phrases.keys}")
        elif not may_turn:
            self._say(f"It turns again after your answer. {self._accepts}")
        elif press.seconds > 0:
            if self._fault_text:
                # The operator has read the fault by now. If its cause remains, the fault comes back at once.
                self._orders.append(Stop())
            self._watch.press(press, self._now_s)
            self._standstill_reported = False
            self._orders.append(Jog(press.axis, press.direction, press.seconds))

    def _report(self) -> None:
        """Tell the operator about faults, movements, and an axis that is driven but stands."""
        axis = self._axis
        self._say(*(f"Note: {notice}" for notice in axis.notices if notice not in self._notices))
        self._notices = axis.notices
        fault = axis.fault
        if fault and fault.passing and self._now_s - self._began_s < CONNECT_S:
            fault = None
        text = str(fault) if fault else ""
        if text != self._fault_text:
            self._fault_text = text
            if text:
                self._say(f"FAULT {text}")
        if not self._readings_count:
            return
        if not self._standstill_reported and self._watch.stands():
            self._standstill_reported = True
            self._say("The reading stands still: it is at its stop, or something is wrong.")
        if isinstance(self._event, AxisMoved) and self._event.movement is not None:
            self.remarks.clear()
            self._say(self._movement_text(self._event))

    def _movement_text(self, event: AxisMoved) -> str:
        moved, unit = event.movement, self.facts.unit
        assert moved is not None
        change = unit.text(moved.change, signed=True)
        direction = self.direction_text(event.direction)
        return f"  {direction}: reading {unit.text(moved.before)} to {unit.text(moved.after)} ({change})"
