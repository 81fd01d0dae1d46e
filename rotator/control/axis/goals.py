"""The goals of an axis beside a target: a jog, and the way to its end stop; and when that comes before a target.

Knows values. `sky.goal.AimGoal` is the third kind of goal. Knows no motor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hw.ports import Direction
from rotator.control.axis.homing import Homing, HomingSettings
from rotator.control.axis.readings import Condition
from rotator.control.axis.timed_homing import TimedHoming, TimedHomingSettings
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


ANEW_AFTER_S = 60.0


class PlaceAnew:
    """When an axis that is reckoned by time goes to its end stop before it goes to a target.

    Always where its place is not known; where the place has only become vague, with the first target after a while
    without one: no pass is flown then.
    """

    def __init__(self, settings: HomingSettings | TimedHomingSettings | None) -> None:
        self._settings = settings if isinstance(settings, TimedHomingSettings) else None
        self._aimed_s = -math.inf
        """When the axis was last given a target."""
        self._due = False

    def aimed(self, now_s: float, condition: Condition) -> None:
        """The axis is given a target."""
        self._due = self._due or (condition.worn and now_s - self._aimed_s >= ANEW_AFTER_S)
        self._aimed_s = now_s

    def first(self, target: AimGoal, condition: Condition, angle_deg: float | None) -> HomeGoal | None:
        """The way to the end stop before the way to this target; None: the place of the axis is good enough."""
        if self._settings is None or condition.error_deg is None:
            return None
        due, self._due = self._due, False
        if condition.lost:
            return HomeGoal(self._settings.begin(None), target)
        if due and angle_deg is not None:
            return HomeGoal(self._settings.begin(angle_deg + condition.error_deg), target)
        return None
