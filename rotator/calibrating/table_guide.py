"""Guides the operator through an axis with a pot, or a magnet: directions, both ends, points between, limits.

Knows what to ask, in which order, and what to refuse. Pure: no clock, no terminal, no file. The questions are one path
from top to bottom (`_path`).
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace

from hw.ports import Direction
from rotator.calibrating.axis_guide import AxisGuide
from rotator.calibrating.entries import Word
from rotator.calibrating.facts import AxisFacts
from rotator.calibrating.guide import BACK, Abandoned, Steps
from rotator.calibrating.question import Choice, Question
from rotator.calibrating.reading_watch import AxisMoved
from rotator.calibrating.readings import READINGS, NotTrusted
from rotator.calibrating.results import AxisCalibrated
from rotator.calibrating.table_draft import TableDraft, TablePoint

READ, AGAIN = Choice("It stands there: read it", "\r"), Choice("Not yet: read it again", "b")
UNDO, NO_MORE = Choice("Take the last point back", "b"), Choice("No more points", "f")
SURPRISING_DEG = 30.0
"""An angle this far from where it should be is asked about. The pots of common rotors bend by 10° at most."""


class TableGuide(AxisGuide):
    """`supply_v`: the supply of a pot, to show readings in volts too; None: the sensor is no pot."""

    def __init__(self, facts: AxisFacts, supply_v: float | None) -> None:
        super().__init__(facts)
        self._supply_v = supply_v
        self.stages = ("Directions", "Low end", "High end", "Points between", "Limits", "Save")

    def reading_text(self, raw: float) -> str:
        volts = "" if self._supply_v is None else f" ({raw * self._supply_v:.3f} V)"
        return super().reading_text(raw) + volts

    def _path(self) -> Steps:
        phrases, facts = self._phrases, self.facts
        self._lead(*phrases.introduction)
        self.stage = "Directions"
        rising = yield from self._check_plus()
        yield from self._check_minus(rising=rising)
        table = yield from self._points(rising=rising)
        self._lead("", *table.lines(self._supply_v, facts.lowest_reading, facts.highest_reading))
        self.stage = "Limits"
        limits = yield from self._limits(table)
        keys = f"[{facts.axis.value}]: the table above, limits {limits[0]:g} to {limits[1]:g}, direction checked."
        learnt = *table.learnt(facts.lowest_reading, facts.highest_reading), phrases.may_be_sent(*limits)
        points = tuple((point.raw, point.angle_deg) for point in table.points)
        yield from self._save(AxisCalibrated(facts.axis, points, *limits), keys, learnt)

    def _check_plus(self) -> Generator[None, None, bool]:
        """Returns whether the reading rises with the degrees."""
        phrases = self._phrases
        self._head("1. Directions.", *phrases.direction_check)
        change = yield from self._turn(Direction.PLUS, 0)
        if not (yield from self._agrees(phrases.did_it_turn, "plus")):
            raise Abandoned(phrases.swap)
        self._say(f"The reading {'rises' if change > 0 else 'falls'} with it: good, either will do.")
        return change > 0

    def _check_minus(self, *, rising: bool) -> Steps:
        change = yield from self._turn(Direction.MINUS, -1 if rising else 1)
        self._say(f"The reading {'rises' if change > 0 else 'falls'} on the way back: the directions are right.")

    def _points(self, *, rising: bool) -> Generator[None, None, TableDraft]:
        """Both ends, then points between, until the operator has no more. The last one can be taken back."""
        phrases, facts = self._phrases, self.facts
        ends = (
            (phrases.low_end, phrases.to_low_end, facts.min_deg, Question(phrases.page_low_end, picture="low")),
            (phrases.high_end, phrases.to_high_end, facts.max_deg, Question(phrases.page_high_end, picture="high")),
        )
        drafts = [TableDraft(rising=rising)]
        while True:
            taken = len(drafts) - 1
            self.points = tuple((point.raw, point.angle_deg) for point in drafts[-1].points)
            self.stage = self.stages[1 + min(taken, len(ends))]
            if taken < len(ends):
                draft = yield from self._end(drafts[-1], *ends[taken])
            else:
                draft = yield from self._between(drafts[-1], first=taken == len(ends))
            if draft is drafts[-1]:
                return draft
            if draft is not None:
                drafts.append(draft)
            elif taken:
                (point,) = set(drafts.pop().points) - set(drafts[-1].points)
                self._say(f"Taken back: {point.angle_deg:g}°.")
            else:
                self._say("There is no point to take back.")

    def _end(
        self, table: TableDraft, where: str, drive_to: str, proposed_deg: float, page: Question
    ) -> Generator[None, None, TableDraft | None]:
        """The table with this end; None: the last point is to be taken back."""
        self._head(drive_to, *self._phrases.end)
        page = replace(page, hint=self._phrases.end, choices=(READ, UNDO) if table.points else (READ,))
        while True:
            prompt, accepts = f"At the {where}? Enter or y reads it.", self._phrases.drive_then_read
            event = yield from self._ask(prompt, accepts, page, may_go_back=True)
            match event:
                case Word.ENTER | Word.YES:
                    point = yield from self._read(proposed_deg)
                    try:
                        if point is not None:
                            longer = table.with_end(point)
                            off_deg = point.angle_deg - proposed_deg
                            why = f"the file has {proposed_deg:g}° for this end"
                            if (yield from self._is_meant(point, off_deg, why)):
                                return longer
                    except NotTrusted as reason:
                        self._say(f"Refused: {reason}.")
                case Word.BACK:
                    return None
                case _ if not isinstance(event, AxisMoved):
                    self._say(self._accepts)

    def _between(self, table: TableDraft, *, first: bool) -> Generator[None, None, TableDraft | None]:
        """The table with one more point, or as it is where there are no more; None: take the last point back."""
        if first:
            self._head("4. Points between.", *self._phrases.between)
        page = Question("Another point between?", self._phrases.between, "between", (NO_MORE, READ, UNDO))
        while True:
            prompt = "Another point? Enter reads; f when there are no more; b takes the last back."
            accepts = f"{self._phrases.drive_then_read} f or n: there are no more points."
            event = yield from self._ask(prompt, accepts, page, may_go_back=True)
            match event:
                case Word.FINISH | Word.NO:
                    return table
                case Word.BACK:
                    return None
                case Word.ENTER:
                    point = yield from self._read(None)
                    try:
                        if point is not None:
                            longer, off_deg = table.with_point(point), table.off_others_deg(point)
                            if (yield from self._is_meant(point, off_deg, "the other points lie on another line")):
                                self._say(f"Taken: {longer.off_line_deg(point):+.1f}° off the straight line.")
                                return longer
                    except NotTrusted as reason:
                        self._say(f"Refused: {reason}.")
                case _ if not isinstance(event, AxisMoved):
                    self._say(self._accepts)

    def _is_meant(self, point: TablePoint, off_deg: float, why: str) -> Generator[None, None, bool]:
        """Ask about an angle that is far from what was to be expected: a digit may be missing."""
        if abs(off_deg) < SURPRISING_DEG:
            return True
        off = f"{point.angle_deg:g}° is {abs(off_deg):.0f}° off: {why}."
        self._lead(off)
        return (yield from self._agrees(f"Is {point.angle_deg:g}° right?", "angle", (off,)))

    def _read(self, proposed_deg: float | None) -> Generator[None, None, TablePoint | None]:
        """Read the axis at rest, and ask for its angle. None: not trusted, or the operator wants to read again."""
        try:
            measured = yield from self._measured()
        except NotTrusted as reason:
            self._say(f"Refused: {reason}.")
            return None
        self._say(f"It reads {measured.raw:.4f}, with a noise of {measured.noise:.4f} in each of {READINGS} readings.")
        page = Question(picture="angle", choices=(AGAIN,))
        angle_deg = yield from self._number("Which angle is that on the rotor's own scale?", proposed_deg, page)
        return None if angle_deg is None else TablePoint(measured, angle_deg)

    def _limits(self, table: TableDraft) -> Generator[None, None, tuple[float, float]]:
        low_deg, high_deg = table.points[0].angle_deg, table.points[-1].angle_deg
        within = f"Between which angles may it be sent? They lie within {low_deg:g} to {high_deg:g}."
        self._lead("", within)
        lowest = Question("The lowest angle that it may be sent to?", (within, *self._phrases.limit), "limits")
        highest = replace(lowest, title="The highest angle that it may be sent to?", choices=BACK)
        while True:
            least = yield from self._number("Lowest angle:", min(max(self.facts.min_deg, low_deg), high_deg), lowest)
            if least is None:
                continue
            if low_deg <= least < high_deg:
                proposed_deg = max(min(self.facts.max_deg, high_deg), low_deg)
                most = yield from self._number("Highest angle:", proposed_deg, highest)
                if most is None:
                    continue
                if least < most <= high_deg:
                    return least, most
            self._say(f"Refused: the limits must lie within {low_deg:g} to {high_deg:g}, the lower one first.")
