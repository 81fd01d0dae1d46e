"""The last line of the table: a fault that lasts, without a word to anybody.

Knows which faults of the simulators can be seen, and when: at once, while the axis is driven, while it turns. The only
judge that listens to the box: any word counts, in the log, as a notice or as a fault.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.drills.judges import LOOK_S, SILENCE, AxisCase, Violation
from benchmarks.drills.world import AxisTruth
from rotator.status import Status

SILENT_S = 5.0
AT_ONCE = ("adc-gone", "pot-open", "pot-shorted", "pot-loose", "silent", "hung")
ORDERED = ("board-unpowered",)
"""Only with an order in force is the part in use."""
DRIVEN = ("motor-stalled", "pot-stuck", "stands", "jammed", "contact-stuck-open", "contact-stuck-closed")
"""Only while the motor has current is there anything to be seen."""
CRACKLES, GAP = ("every", "pot-crackles"), 20
"""Each so many-th reading is bad: from 4 of 100 on that is told."""
PERIOD_S = 0.05
TRACKING = "rotator.tracking"
"""That a target is tracked no longer tells no fault."""
TURNING_SHARE = 0.5
"""A welded contact or a hand turns it as fast as this share of its speed: slower is a wind, and only a notice."""


class Words(logging.Handler):
    """The log, and when it last had anything to say."""

    def __init__(self, clock: Callable[[], float]) -> None:
        super().__init__(logging.WARNING)
        self._clock = clock
        self.said_s = float("-inf")
        self.lines: list[tuple[float, str]] = []

    def emit(self, record: logging.LogRecord) -> None:
        if not record.name.startswith(TRACKING):
            self.said_s = self._clock()
        if len(self.lines) < 2000:
            self.lines.append((self.said_s, record.getMessage()))


@dataclass(slots=True)
class _Lasting:
    name: str
    axis: str
    since_s: float
    seen_s: float = 0.0
    """For how long there has been something to see."""


class Silence:
    """Tell it when a fault begins and ends; `look` after every cycle."""

    def __init__(self, words: Words, cases: tuple[AxisCase, AxisCase]) -> None:
        self._words = words
        self._cases = dict(zip(("azimuth", "elevation"), cases, strict=True))
        self._lasting: list[_Lasting] = []
        self._looked_s = 0.0
        self.found: list[Violation] = []

    def begin(self, name: str, now_s: float) -> None:
        axis = "elevation" if name.startswith("elevation") else "azimuth"
        plain = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-")
        seen = plain in (*AT_ONCE, *ORDERED) or (plain in DRIVEN and self._cases[axis].feels)
        seen = seen or (plain in CRACKLES and int(name.partition(":")[2] or 0) <= GAP)
        # A count that is lost already cannot be lost once more by a hand.
        if seen or plain.startswith("relay-welded") or (plain == "hand-turns" and not self._cases[axis].counts):
            self._lasting.append(_Lasting(plain, axis, now_s))

    def end(self, name: str) -> None:
        plain = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-")
        self._lasting = [each for each in self._lasting if each.name != plain]

    def pause(self, now_s: float) -> None:
        """The program had no turn until now: nothing could be said."""
        self._looked_s = now_s
        for each in self._lasting:
            each.seen_s = 0.0

    def look(self, now_s: float, axes: list[AxisTruth], status: Status, *, ordered: bool) -> None:
        """`ordered`: an order is in force."""
        past_s, self._looked_s = now_s - self._looked_s, now_s
        if not self._lasting:
            return
        shown = bool(status.faults or status.azimuth.notices or status.elevation.notices or status.notices)
        for each in list(self._lasting):
            if shown or self._words.said_s >= each.since_s:
                self._lasting.remove(each)
                continue
            truth = axes[0 if each.axis == "azimuth" else 1]
            # Bad readings are counted: of those that come late there are fewer.
            more_s = min(past_s, PERIOD_S) if each.name in CRACKLES else past_s
            each.seen_s = each.seen_s + more_s if self._to_be_seen(each, truth, ordered=ordered) else 0.0
            if each.seen_s > self._most_s(each) + LOOK_S:
                self.found.append(Violation(now_s, SILENCE, each.axis, f"{each.name} for {each.seen_s:.2f} s"))
                self._lasting.remove(each)

    def _most_s(self, fault: _Lasting) -> float:
        """A contact that stands still shows nothing before three of its periods."""
        case = self._cases[fault.axis]
        return max(SILENT_S, case.patience_s) if case.counts and fault.name in DRIVEN else SILENT_S

    @staticmethod
    def _to_be_seen(fault: _Lasting, truth: AxisTruth, *, ordered: bool) -> bool:
        if fault.name in (*AT_ONCE, *CRACKLES):
            return True
        if fault.name in ORDERED:
            return ordered
        if fault.name in DRIVEN:
            return truth.coil != 0
        return truth.coil == 0 and abs(truth.speed_dps) > TURNING_SHARE * truth.full_dps
