"""The fault that stops one axis: which one is kept, when it ends, and who may end it.

Knows what is wrong now, what was wrong first, and how often lately a motor was stopped by a fault, also before the
program began. Does not know how a fault is found, nor how a motor is stopped.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

from rotator.control.axis.readings import LOOK_S
from rotator.exchange.faults import LATE, POT, Fault

TRIES = 3
TRIES_WITHIN_S = 600.0
"""After this many faults within this time a link cannot acknowledge the fault: a person does, or the time passes."""

IN_ORDER_S, MOST_LATE = 1.0, 10
"""A lateness has passed when everything was seen in order for this time: as long as bad readings take to heal. After
others within TRIES_WITHIN_S it takes as many times longer, up to the second: a motor is not started again and again."""
PASSED = "that has passed, and since then everything was seen in order: orders count again"

OFTEN = f"tried {TRIES} times in {TRIES_WITHIN_S / 60:g} minutes: within that time only `resume` acknowledges it"


class FaultLatch:
    """Keeps the first fault until it is acknowledged. A fault that cuts the supply replaces one that does not."""

    def __init__(self, sensor: str = POT, *, before: Fault | None = None, tries: int = 0) -> None:
        """`tries`: how often faults had stopped the motor when the program began; `before`: the latest of them."""
        self._sensor = sensor
        """What reads the angle, in a word: each fault names it."""
        self.kind = before.kind if before and tries else None
        """The kind of the latest fault that stopped the motor; None: no fault has stopped it lately."""
        self._before = tries
        """Faults before the program began. They count as if they came at the first call that gives a moment."""
        tried = replace(before, measured=f"before the program began again; {OFTEN}") if before else None
        self.fault = self._named(tried if tries >= TRIES else None)
        self._cause: Fault | None = None
        """The fault whose cause is still present. It stays after an acknowledgement."""
        self._caused_s = -math.inf
        """When a cause was seen last."""
        self._tries_s: deque[float] = deque(maxlen=TRIES)
        """When faults last stopped the motor."""
        self._late_s: deque[float] = deque(maxlen=MOST_LATE)
        """When the latest of LATE came."""
        self._in_order_s = self._noted_s = 0.0
        """For how long all has been in order, as far as the box looked; and when it looked last."""

    def note(
        self, found: Fault | None, now_s: float, *, cause: Fault | None, tries: int, in_order: bool = False
    ) -> bool:
        """Note what is wrong at this moment. Returns whether a new fault is kept.

        `cause`: the fault whose cause is still present, so that it returns after an acknowledgement. `tries`: how often
        the motor was on in vain before. `in_order`: the latest reading is good, and no suspicion is open.
        """
        self._begin(now_s)
        self._cause = cause
        self._caused_s = now_s if cause else self._caused_s
        looked_s, self._noted_s = min(now_s - self._noted_s, LOOK_S), now_s
        self._in_order_s = self._in_order_s + looked_s if in_order and not (found or cause) else 0.0
        if self.fault and self.fault.kind in LATE and self._has_passed(now_s):
            self.fault = replace(self.fault.told(f"{self.fault.exceeded}; {PASSED}"), passing=True)
            return False
        if self.fault and self.fault.passing:
            self.fault = self._named(found)
        return self.fail(found, now_s, tries=tries)

    def fail(self, fault: Fault | None, now_s: float, *, tries: int) -> bool:
        """Keep this fault if none is kept, or if it cuts the supply and the kept one does not. Returns whether it is
        kept."""
        if fault is None or (self.fault is not None and (self.fault.cut or not fault.cut)):
            return False
        if fault.kind in LATE:
            self._late_s.append(now_s)
            self._in_order_s = 0.0
        elif not fault.passing:
            self._tries_s.extend([now_s] * tries)
            self.kind = fault.kind if tries else self.kind
        if self.needs_person(now_s):
            fault = fault.told(f"{fault.exceeded}; {OFTEN}")
        self.fault = self._named(fault)
        return True

    @property
    def present(self) -> bool:
        """Whether the cause was seen a moment ago: no acknowledgement ends the fault now. After a gap in the readings a
        watch needs its time again."""
        return self.fault is not None and self._noted_s - self._caused_s < 2.0 * IN_ORDER_S

    def tries(self, now_s: float) -> int:
        """How often faults have stopped the motor lately."""
        return self._before + sum(now_s - tried_s < TRIES_WITHIN_S for tried_s in self._tries_s)

    def needs_person(self, now_s: float) -> bool:
        """Whether the motor was tried too often lately for a link to acknowledge its fault."""
        return len(self._tries_s) == TRIES and now_s - self._tries_s[0] < TRIES_WITHIN_S

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        """End the fault. While its cause is present, it returns at once. Returns whether it has been acknowledged."""
        self._begin(now_s)
        if by_person:
            self._tries_s.clear()
        elif self.needs_person(now_s):
            return False
        self.fault = self._named(self._cause)
        return True

    def _has_passed(self, now_s: float) -> bool:
        """Whether the lateness that is kept has passed by itself."""
        assert self.fault is not None
        if self.fault.passing or self.fault.cut or self.needs_person(now_s):
            return False
        lately = sum(now_s - late_s < TRIES_WITHIN_S for late_s in self._late_s)
        return self._in_order_s >= IN_ORDER_S * max(1, lately)

    def _begin(self, now_s: float) -> None:
        self._tries_s.extend([now_s] * self._before)
        self._before = 0

    def _named(self, fault: Fault | None) -> Fault | None:
        """The same fault, naming the sensor of this axis."""
        return fault if fault is None or fault.sensor == self._sensor else replace(fault, sensor=self._sensor)
