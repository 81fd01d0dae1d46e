"""The last line of the table: a fault that lasts without a message.

Knows for how long each fault of the simulators could be seen (`told` says which fault, and when). The only judge that
listens to the box. As a message counts: a fault of the axis, a new notice of the axis or of the box, and a line of the
log that names the axis. A message about a part of both axes may come at either axis.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.drills.accusations import LOOK_S, SILENCE, Violation
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.told import Rule, Shows, plain, rule
from benchmarks.drills.world import AxisTruth
from hw.ports import Axis
from rotator.exchange.status import Status

IGNORED = "orders from"
CURRENT = (Shows.DRIVEN, Shows.PRESSED, Shows.TURNED)
IN_VAIN = "presses did not move it"
"""This notice stays true of an axis that stands for another reason by now: it counts as a message without being new."""
AXES = tuple(axis.value for axis in Axis)
PERIOD_S = 0.05
TRACKING = "rotator.tracking"
"""The logger of the tracker: its lines are about targets, and report no fault."""
TURNING_SHARE = 0.5
"""A welded contact or a hand turns an axis at this share of its speed or faster. Wind turns it slower: that is only a
notice."""
BLOWN_SHARE = 0.2


class Words(logging.Handler):
    """The box's log, and when its latest line came."""

    def __init__(self, clock: Callable[[], float]) -> None:
        super().__init__(logging.WARNING)
        self._clock = clock
        self.said_s = float("-inf")
        self.named_s = dict.fromkeys(AXES, float("-inf"))
        """By axis: when the latest line that names it came."""
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
    rule: Rule
    since_s: float
    before: frozenset[str] = frozenset()
    """The notices that were shown before the fault began."""
    seen_s: float = 0.0
    """For how long the fault could be seen."""


class Silence:
    """Call `begin` and `end` when a fault begins and ends, and `look` after every cycle."""

    def __init__(self, words: Words, cases: tuple[AxisCase, AxisCase]) -> None:
        self._words = words
        self._cases = dict(zip(("azimuth", "elevation"), cases, strict=True))
        self._lasting: list[_Lasting] = []
        self._looked_s = 0.0
        self._shown: frozenset[str] = frozenset()
        self.found: list[Violation] = []

    def begin(self, name: str, now_s: float) -> None:
        axis = "elevation" if name.startswith("elevation") else "azimuth"
        case, must = self._cases[axis], rule(name)
        if must is None or (must.felt and not case.feels) or (must.measured and (case.counts or not case.feels)):
            return
        if must.lost and case.keeps_place:
            return
        self._lasting.append(_Lasting(plain(name), axis, must, now_s, self._shown))

    def end(self, name: str) -> None:
        self._lasting = [each for each in self._lasting if each.name != plain(name)]

    def acknowledged(self) -> None:
        """The box was stopped or released, or the program has started again."""
        self._lasting = [each for each in self._lasting if not each.rule.heals]

    def pause(self, now_s: float) -> None:
        """The program did not run until now: it could send no message."""
        self._looked_s = now_s
        for each in self._lasting:
            each.seen_s = 0.0

    def look(
        self,
        now_s: float,
        axes: list[AxisTruth],
        status: Status,
        *,
        ordered: bool,
        there: frozenset[str] = frozenset(),
        elsewhere: frozenset[str] = frozenset(),
        coming: frozenset[str] = frozenset(),
    ) -> None:
        """`ordered`: an order is in force. `there`: axes whose control box has arrived. `elsewhere`: axes that an order
        certainly sends to another angle. `coming`: axes that turn to where an order may send them.
        """
        past_s, self._looked_s = now_s - self._looked_s, now_s
        each_axis = [notice.text for axis in Axis for notice in status.axis(axis).notices]
        self._shown = frozenset((*each_axis, *_of_the_box(status)))
        for each in list(self._lasting):
            if self._told(each, status):
                self._lasting.remove(each)
                continue
            truth = axes[0 if each.axis == "azimuth" else 1]
            # The box counts bad readings. In a late cycle there are fewer readings than the time suggests.
            more_s = min(past_s, PERIOD_S) if each.rule.shows is Shows.AS_READ else past_s
            wanted = ordered, truth.name in elsewhere, truth.name in coming
            if self._to_be_seen(each, truth, wanted, there):
                each.seen_s += more_s
            elif not (each.rule.shows is Shows.WELDED and truth.coil):  # seen in one pause, it is not forgotten
                each.seen_s = 0.0
            if each.seen_s > self._most_s(each) + LOOK_S:
                self.found.append(Violation(now_s, SILENCE, each.axis, f"{each.name} for {each.seen_s:.2f} s"))
                self._lasting.remove(each)

    def _told(self, fault: _Lasting, status: Status) -> bool:
        places = AXES if fault.rule.shared else (fault.axis,)
        shown = _of_the_box(status)
        for place in places:
            axis = status.axis(Axis(place))
            if axis.fault is not None or self._words.named_s[place] >= fault.since_s:
                return True
            shown |= {notice.text for notice in axis.notices}
        held = fault.rule.shows in CURRENT and any(text.startswith(IN_VAIN) for text in shown)
        return held or not shown <= fault.before

    def _most_s(self, fault: _Lasting) -> float:
        """The longest time until the message. A contact that does not change shows nothing for three of its periods."""
        case = self._cases[fault.axis]
        waits = case.counts and fault.rule.shows in (*CURRENT, Shows.WITHOUT_CURRENT, Shows.WELDED)
        return max(fault.rule.within_s, case.patience_s) if waits else fault.rule.within_s

    def _to_be_seen(
        self, fault: _Lasting, truth: AxisTruth, wanted: tuple[bool, bool, bool], there: frozenset[str]
    ) -> bool:
        ordered, elsewhere, coming = wanted
        fed, turns = truth.coil != 0 and truth.name not in there, abs(truth.speed_dps) / truth.full_dps
        match fault.rule.shows:
            case Shows.AT_ONCE:
                return True
            case Shows.AS_READ:
                return not self._cases[fault.axis].repeats
            case Shows.ORDERED:
                return ordered
            case Shows.ELSEWHERE:
                return elsewhere and truth.stands
            case Shows.DRIVEN:
                return fed
            case Shows.PRESSED:
                return fed and truth.stands
            case Shows.TURNED:
                return fed and turns > TURNING_SHARE
            case Shows.WITHOUT_CURRENT:  # whose hand it is that turns an axis to its target, nothing shows
                return truth.coil == 0 and turns > TURNING_SHARE and not coming
            case Shows.WELDED:
                return truth.coil == 0 and truth.power != 0 and turns > TURNING_SHARE
            case Shows.BLOWN:
                return truth.coil == 0 and turns > BLOWN_SHARE


def _of_the_box(status: Status) -> set[str]:
    """The notices of the box, without those about senders, which report no fault."""
    return {text for text in status.notices if not text.startswith(IGNORED)}
