"""What a rotor hands to an axis in each cycle: the reading of its sensor, and the condition of the axis.

Knows values. `sensing` judges whether a reading can be believed. Knows no sensor.
"""

from __future__ import annotations

import math
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
