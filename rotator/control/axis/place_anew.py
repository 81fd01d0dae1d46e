"""When an axis that is reckoned by time goes to its end stop before it goes to a target.

Always where its place is not known; where the place has only become vague, with the first target after a while without
one: no pass is flown then. Knows what the rotor says of the axis. Knows no motor.
"""

from __future__ import annotations

import math

from rotator.control.axis.goals import HomeGoal
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import Condition
from rotator.control.axis.timed_homing import TimedHomingSettings
from rotator.control.sky.goal import AimGoal

AFTER_S = 60.0


class PlaceAnew:
    def __init__(self, settings: HomingSettings | TimedHomingSettings | None) -> None:
        self._settings = settings if isinstance(settings, TimedHomingSettings) else None
        self._aimed_s = -math.inf
        """When the axis was last given a target."""
        self._due = False

    def aimed(self, now_s: float, condition: Condition) -> None:
        """The axis is given a target."""
        self._due = self._due or (condition.worn and now_s - self._aimed_s >= AFTER_S)
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
