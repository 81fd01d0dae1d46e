"""Setting up an axis from which nothing comes back: the box turns it from stop to stop, a person says when it is there.

Knows how a way is timed, and what two times cannot both be true. Does not know the motor's speed: it is what is asked
for. What the axis says of its angle counts for nothing here.
"""

from __future__ import annotations

from collections.abc import Generator

from hw.ports import Direction
from rotator.calibrating.degrees_guide import DegreesGuide
from rotator.calibrating.entries import Entry, StopNow, Word
from rotator.calibrating.guide import LEFT, NOTHING_SAVED, Abandoned
from rotator.calibrating.question import HALT, Choice, Question
from rotator.calibrating.results import AxisCalibrated
from rotator.exchange.orders import Confirm, Jog

RENEWED_S = 0.5
"""The motor is ordered to go on so often, for PRESS_S each time: without this guide it stops."""
PRESS_S = 2.0
WAYS = Direction.MINUS, Direction.PLUS, Direction.MINUS
STARTS_S = 5.0
"""A relay closes within this time: a reversal has a pause, and its brake may need one."""
ARRIVED = Choice("It stands at its stop", "\r")
LEAST_S, UNLIKE = 5.0, 1.5
"""A way takes longer than that; and one way at most so many times as long as the other."""


class StopwatchGuide(DegreesGuide):
    _measures = False
    """The angle is of no account any more."""
    _timing = False

    def ready(self, entry: Entry) -> bool:
        return self._timing or super().ready(entry)

    @property
    def _readings_count(self) -> bool:
        return not self._measures and super()._readings_count

    def _times(self) -> Generator[None, None, bool]:
        facts, words = self.facts, self._phrases
        hint = words.stopwatch
        self._head("2. The times.", *hint, "Enter is that answer; space or s stops the motor at any time.")
        self.stage = "End stop"
        if not (yield from self._agrees("Measure the times now?", "times", hint, yes="Measure them", no="Not now")):
            return False
        self.stages, self.stage = ("Directions", "Times", "Save"), "Times"
        self._measures = True
        while (times_s := (yield from self._three_ways())) is None:
            self._say("", "Once more, from the low stop.")
        # It ends at the low stop.
        self._orders.append(Confirm(facts.axis, facts.least_deg + facts.shift_deg))
        limits = f"limits {facts.min_deg:g} to {facts.max_deg:g} as in the file"
        keys = f"[timed.{facts.axis.value}]: {times_s[0]:g} s and {times_s[1]:g} s; {limits}, direction checked."
        learnt = *words.timed(times_s), words.may_be_sent(facts.min_deg, facts.max_deg)
        yield from self._save(AxisCalibrated(facts.axis, None, facts.min_deg, facts.max_deg, times_s), keys, learnt)
        return True

    def _three_ways(self) -> Generator[None, None, tuple[float, float] | None]:
        """The times up and down; None: stopped, or not likely. Raises Abandoned."""
        took_s: list[float] = []
        words = self._phrases
        for direction, text in zip(WAYS, (words.to_low_stop, words.time_to_high, words.time_to_low), strict=True):
            self._lead("", text)
            picture, prompt = ("minus", "plus")[direction is Direction.PLUS], "y: the motor starts; n: leave."
            if not (yield from self._agrees(text, picture, yes="Start the motor", no="Leave", prompt=prompt)):
                raise Abandoned(LEFT)
            way_s = yield from self._timed(direction)
            fault = self._fault_text  # a stop acknowledges it
            self._halt()
            while not self._watch.resting:
                yield
            if fault:
                raise Abandoned(f"Left: {words.too_slow} {NOTHING_SAVED}")
            if way_s is None:
                return None
            took_s.append(round(way_s, 1))
            self._say(f"  {took_s[-1]:g} s.")
        short_s, long_s = sorted(took_s[1:])
        if short_s >= LEAST_S and long_s <= UNLIKE * short_s:
            return took_s[1], took_s[2]
        self._say("Not accepted: no rotor turns so quickly, or so differently the two ways.")
        return None

    def _timed(self, direction: Direction) -> Generator[None, None, float | None]:
        """How long the motor has run when the person presses Enter; None: it was stopped, or has stopped."""
        picture = "low" if direction is Direction.MINUS else "high"
        page = Question("Press when it stands at its stop.", picture=picture, choices=(ARRIVED, HALT))
        self._show("Enter: it stands at its stop. s: stop the motor.", page)
        ordered_s, asked_s, began_s = -RENEWED_S, self._now_s, None
        self._timing = self._asking = True
        try:
            while True:
                if self._now_s - ordered_s >= RENEWED_S:
                    ordered_s = self._now_s
                    self._orders.append(Jog(self.facts.axis, direction, PRESS_S))
                yield
                runs = self._axis.drive is direction
                self.runs_s = None if began_s is None else self._now_s - began_s
                if self._entry is Word.ENTER and began_s is not None:
                    return self._now_s - began_s
                if isinstance(self._entry, StopNow) or self._fault_text:
                    return None
                if self._entry is not None:
                    self._say("Enter when it stands at its stop; s stops the motor.")
                if runs and began_s is None:
                    began_s = self._now_s
                elif not runs and (began_s is not None or self._now_s - asked_s > STARTS_S):
                    self._say("The motor does not run any more.")
                    return None
        finally:
            self._timing = self._asking = False
            self.runs_s = None
