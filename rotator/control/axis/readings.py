"""What a rotor hands to an axis in each cycle: the reading of its sensor, and the condition of the axis.

Knows values. `sensing` judges whether a reading can be believed. Knows no sensor.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from hw.ports import Direction
from rotator.exchange.faults import Fault, Notice

LOOK_S = 0.1
"""From one look at an axis to the next the box takes 0.01 s to 0.075 s. In a longer pause it stood still itself, and
only this much of it counts as time in which it looked."""


@dataclass(frozen=True, slots=True)
class Condition:
    """What a rotor reports of one of its axes beside the angle."""

    fault: Fault | None = None
    """What is wrong with the axis now, as the rotor itself knows."""
    latched: bool = False
    """The rotor itself keeps that fault until it is acknowledged."""
    notice: Notice | None = None
    """What a person should know though it stops nothing."""
    lost: str = ""
    """Why the axis has to be homed before its angle is known; empty: the angle is right."""
    scale: int = 0
    """When this number changes, the same reading means another place from then on."""
    settling: bool = False
    """The axis does not follow yet, for a reason that passes by itself."""
    waits: bool = False
    """Its drive has not passed its latest order on yet: as though it held meanwhile."""
    changes: int = 0
    """How often its contact has changed."""
    missed: int = 0
    """How many orders its controller has left without an answer up to now."""
    closed: bool = False
    """The contact is closed since the last of these changes."""
    ends: frozenset[Direction] = frozenset()
    """The directions that a limit switch forbids."""
    ahead: frozenset[Direction] = frozenset()
    """The directions in which its contact would change again before the stop."""
    supplied: bool = True
    """The motors have their supply, as far as the box knows: no master is open."""
    error_deg: float | None = None
    """How far an angle reckoned by time may be off; infinite: it is lost. None: the angle is seen or counted."""
    worn: bool = False
    """Such an axis has turned so far that it should be set anew at its end stop when there is time for it."""


NORMAL = Condition()
"""The rotor has nothing to say."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a sensor read: its raw value, or why there is none (`problem`); and the condition of the axis."""

    at_s: float
    raw: float | None
    problem: str = ""
    condition: Condition = NORMAL
    since_s: float = math.inf
    """If earlier than `at_s`: the value is of an unknown moment between the two, for a computer may stand still in the
    middle of a reading."""
    late: bool = False
    """There is no value because the reading took too long: the bus hung, or the computer stood still."""


@dataclass(frozen=True, slots=True)
class Window:
    """Readings of a healthy sensor. With end resistors and a pulled wiper, a broken wire reads outside."""

    low_raw: float
    high_raw: float
    pot: bool = True
    """The sensor is a pot. With a broken wire a chip does not answer; a pot answers with a wrong reading."""

    @property
    def blind(self) -> bool:
        """Whether a broken wire of the pot would read like an angle, because there are no end resistors."""
        return self.pot and (self.low_raw <= 0.0 or self.high_raw >= 1.0)


ANYTHING = Window(-math.inf, math.inf, pot=False)
"""A sensor in degrees that reports itself when it cannot be believed."""


LOOKED_AT = 100
"""Number of latest readings that count: five seconds at 20 Hz, two at 50 Hz."""
NOTICED, NOTICED_NO_MORE = 4, 1
TOO_MANY_BAD = 8
HEALED_S = 1.0
"""A fault for too many bad readings can be acknowledged this long after the last bad one."""
NOW_AND_THEN = Notice(
    "bad readings now and then: look for a loose wire, a worn pot, or motor cables beside the sensor's", "BAD READINGS"
)


class BadReadings:
    """How many readings are bad: a few are ridden out, more are noticed, and too many are a fault.

    Give it every reading of one sensor (`note`), in order of time.
    """

    def __init__(self) -> None:
        self._bad: deque[bool] = deque(maxlen=LOOKED_AT)
        self._count = 0
        self._noticed = False
        self._bad_s: float | None = None
        """When the latest bad reading came."""
        self._too_many = False

    @property
    def count(self) -> int:
        """How many of the latest readings are bad."""
        return self._count

    @property
    def notice(self) -> Notice | None:
        return NOW_AND_THEN if self._noticed else None

    def note(self, at_s: float, *, bad: bool) -> None:
        """One more reading."""
        if len(self._bad) == LOOKED_AT:
            self._count -= self._bad[0]
        self._bad.append(bad)
        self._count += bad
        if bad:
            self._bad_s = at_s
        if self._count >= NOTICED:
            self._noticed = True
        elif self._count <= NOTICED_NO_MORE:
            self._noticed = False
        self._too_many = self._too_many or self._count >= TOO_MANY_BAD

    def too_many(self, now_s: float) -> bool:
        """Whether the sensor is too bad to move the axis. It is good again after a while without a bad reading."""
        if self._too_many and self._bad_s is not None and now_s - self._bad_s >= HEALED_S:
            self._too_many = False
            self._bad.clear()
            self._count = 0
        return self._too_many
