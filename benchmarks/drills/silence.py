"""The last line of the table: a fault that lasts, without a word to anybody.

Knows which faults of the simulators can be seen, and when: at once, while the axis is driven, while it turns. The only
judge that listens to the box: a fault of the axis counts, a notice of the axis or of the box that was not shown before,
and a line of the log that names the axis. A part that serves both may be told at either.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.drills.judges import LOOK_S, SILENCE, AxisCase, Violation
from benchmarks.drills.world import AxisTruth
from hw.ports import Axis
from rotator.status import Status

SILENT_S = 5.0
AT_ONCE = ("adc-gone", "pot-open", "pot-shorted", "pot-loose", "silent", "hung")
ORDERED = ("board-unpowered",)
"""Only with an order in force is the part in use."""
DRIVEN = ("motor-stalled", "pot-stuck", "stands", "jammed", "contact-stuck-open", "contact-stuck-closed")
"""Only while the motor has current is there anything to be seen."""
CRACKLES, GAP = ("every", "pot-crackles"), 20
"""Each so many-th reading is bad: from 4 of 100 on that is told."""
SHARED = ("adc-gone", "hung", "board-unpowered")
"""Parts that serve both axes."""
IGNORED = "orders from"
IN_VAIN = "presses did not move it"
"""What stays true, and shown, of an axis that is held for another reason than at first."""
AXES = tuple(axis.value for axis in Axis)
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
        self.named_s = dict.fromkeys(AXES, float("-inf"))
        """When a line named the axis last."""
        self.lines: list[tuple[float, str]] = []

    def emit(self, record: logging.LogRecord) -> None:
        if not record.name.startswith(TRACKING):
            self.said_s = self._clock()
            for axis in AXES:
                if axis in record.getMessage():
                    self.named_s[axis] = self.said_s
        if len(self.lines) < 2000:
            self.lines.append((self.said_s, record.getMessage()))


@dataclass(slots=True)
class _Lasting:
    name: str
    axis: str
    since_s: float
    before: frozenset[str] = frozenset()
    """The notices that were shown already."""
    seen_s: float = 0.0
    """For how long there has been something to see."""


class Silence:
    """Tell it when a fault begins and ends; `look` after every cycle."""

    def __init__(self, words: Words, cases: tuple[AxisCase, AxisCase]) -> None:
        self._words = words
        self._cases = dict(zip(("azimuth", "elevation"), cases, strict=True))
        self._lasting: list[_Lasting] = []
        self._looked_s = 0.0
        self._shown: frozenset[str] = frozenset()
        self.found: list[Violation] = []

    def begin(self, name: str, now_s: float) -> None:
        axis = "elevation" if name.startswith("elevation") else "azimuth"
        plain = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-")
        seen = plain in (*AT_ONCE, *ORDERED) or (plain in DRIVEN and self._cases[axis].feels)
        seen = seen or (plain in CRACKLES and int(name.partition(":")[2] or 0) <= GAP)
        # A count that is lost already cannot be lost once more by a hand.
        if seen or plain.startswith("relay-welded") or (plain == "hand-turns" and not self._cases[axis].counts):
            self._lasting.append(_Lasting(plain, axis, now_s, self._shown))

    def end(self, name: str) -> None:
        plain = name.partition(":")[0].removeprefix("azimuth-").removeprefix("elevation-")
        self._lasting = [each for each in self._lasting if each.name != plain]

    def pause(self, now_s: float) -> None:
        """The program had no turn until now: nothing could be said."""
        self._looked_s = now_s
        for each in self._lasting:
            each.seen_s = 0.0

    def look(
        self, now_s: float, axes: list[AxisTruth], status: Status, *, ordered: bool, there: frozenset[str] = frozenset()
    ) -> None:
        """`ordered`: an order is in force. `there`: axes whose control box stands as it was sent."""
        past_s, self._looked_s = now_s - self._looked_s, now_s
        each_axis = [notice.text for axis in Axis for notice in status.axis(axis).notices]
        self._shown = frozenset((*each_axis, *_of_the_box(status)))
        for each in list(self._lasting):
            if self._told(each, status):
                self._lasting.remove(each)
                continue
            truth = axes[0 if each.axis == "azimuth" else 1]
            # Bad readings are counted: of those that come late there are fewer.
            more_s = min(past_s, PERIOD_S) if each.name in CRACKLES else past_s
            each.seen_s = each.seen_s + more_s if self._to_be_seen(each, truth, ordered=ordered, there=there) else 0.0
            if each.seen_s > self._most_s(each) + LOOK_S:
                self.found.append(Violation(now_s, SILENCE, each.axis, f"{each.name} for {each.seen_s:.2f} s"))
                self._lasting.remove(each)

    def _told(self, fault: _Lasting, status: Status) -> bool:
        places = AXES if fault.name in SHARED else (fault.axis,)
        shown = _of_the_box(status)
        for place in places:
            axis = status.axis(Axis(place))
            if axis.fault is not None or self._words.named_s[place] >= fault.since_s:
                return True
            shown |= {notice.text for notice in axis.notices}
        held = fault.name in DRIVEN and any(text.startswith(IN_VAIN) for text in shown)
        return held or not shown <= fault.before

    def _most_s(self, fault: _Lasting) -> float:
        """A contact that stands still shows nothing before three of its periods."""
        case = self._cases[fault.axis]
        waits = case.counts and (fault.name in DRIVEN or fault.name.startswith("relay-welded"))
        return max(SILENT_S, case.patience_s) if waits else SILENT_S

    def _to_be_seen(self, fault: _Lasting, truth: AxisTruth, *, ordered: bool, there: frozenset[str]) -> bool:
        if fault.name in CRACKLES:
            return not self._cases[fault.axis].repeats
        if fault.name in AT_ONCE:
            return True
        if fault.name in ORDERED:
            return ordered
        if fault.name in DRIVEN:
            return truth.coil != 0 and truth.name not in there
        return truth.coil == 0 and abs(truth.speed_dps) > TURNING_SHARE * truth.full_dps


def _of_the_box(status: Status) -> set[str]:
    """Its notices, but those about senders: they tell no fault."""
    return {text for text in status.notices if not text.startswith(IGNORED)}
