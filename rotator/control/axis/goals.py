"""The goals of an axis beside a target: a jog, and the way to its end stop.

Knows values. `sky.goal.AimGoal` is the third kind of goal. Knows no motor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from hw.ports import Direction
from rotator.control.axis.homing import Homing
from rotator.control.axis.timed_homing import TimedHoming
from rotator.control.sky.goal import AimGoal

UNCALIBRATED_JOG_S = 2.0
"""The longest press on an axis that is not commissioned."""
LONGEST_WAIT_S = 6.0
"""A press that has waited this long for its relay is not carried out any more."""


@dataclass(frozen=True, slots=True)
class JogGoal:
    direction: Direction
    until_s: float | None
    """None: until it is halted, or at its limit."""
    waits_s: float = LONGEST_WAIT_S
    """How much longer a waiting relay may postpone the end of the jog."""
    held: bool = False
    """The sender holds a button, and renews the goal."""
    end_deg: float | None = None
    """Where the axis comes to rest before a forbidden sector; None: no sector is near."""

    def put_off(self, by_s: float) -> JogGoal:
        """The axis's relay waited for `by_s`."""
        if self.until_s is None or self.waits_s < by_s:
            return self
        return replace(self, until_s=self.until_s + by_s, waits_s=self.waits_s - by_s)


@dataclass(frozen=True, slots=True)
class HomeGoal:
    """Find the end stop."""

    homing: Homing | TimedHoming
    then: AimGoal | None = None
    """The target for which the axis finds its stop first; None: a person has asked for it."""


@dataclass(frozen=True, slots=True)
class SeekGoal:
    """The drive finds its end stop by itself, and then its readings have another scale."""

    scale: int


def jog(
    direction: Direction, seconds: float | None, now_s: float, *, commissioned: bool, held: bool = False
) -> JogGoal | None:
    """The goal of an order to jog; None: to stop. An axis that is not commissioned obeys short presses only."""
    if direction is Direction.OFF:
        return None
    if not commissioned:
        seconds = UNCALIBRATED_JOG_S if seconds is None else min(seconds, UNCALIBRATED_JOG_S)
    until_s = None if seconds is None else now_s + seconds
    return JogGoal(direction, until_s, 0.0 if held else LONGEST_WAIT_S, held=held)
