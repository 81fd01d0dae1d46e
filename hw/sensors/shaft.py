"""The angle of a shaft between two edges of its cam contact, by dead reckoning from the motor's supply.

Knows the motor's speed in each direction, its lag, and how long it has been powered. Does not know the contact, and
does not count: the caller gives the two angles between which the shaft must be. Has no clock: times are arguments, in
seconds.
"""

from __future__ import annotations

import math

from hw.ports import Direction
from hw.sensors.cam import Cam

STANDS_BELOW = 0.001
"""Below this share of its full speed the shaft counts as standing."""
LEARN = 0.25
"""The weight of a new measurement of the speed against the speed learnt before."""


class ReckonedShaft:
    """Angles are degrees on the rotor's own scale, speeds degrees a second, positive clockwise or up."""

    def __init__(self, cam: Cam) -> None:
        self.at_s = -math.inf
        """The time of the present state."""
        self.angle_deg = 0.0
        self.speed_dps = 0.0
        self.fed = Direction.OFF
        """The direction in which the motor is powered."""
        self.fed_s = 0.0
        """Seconds under power in this direction since the last edge."""
        self.held_deg = 0.0
        """How far the shaft should have turned beyond its two edges. It shows a missed pulse or a held motor."""
        self._cam = cam
        self._off_s = -math.inf
        self._speeds_dps = dict.fromkeys((Direction.PLUS, Direction.MINUS), cam.speed_dps)

    @property
    def top_speed_dps(self) -> float:
        """The faster of the two directions."""
        return max(self._speeds_dps.values())

    @property
    def fed_deg(self) -> float:
        """How far the shaft should have turned since the last edge."""
        return self.fed_s * abs(self._wanted_dps)

    @property
    def _wanted_dps(self) -> float:
        """The speed to which the motor's present supply leads."""
        return 0.0 if self.fed is Direction.OFF else self.fed * self._speeds_dps[self.fed]

    @property
    def at_rest(self) -> bool:
        """Whether the motor has been without power for longer than it coasts."""
        return self.fed is Direction.OFF and self.at_s - self._off_s >= self._cam.coast_s

    def place(self, at_s: float, angle_deg: float) -> None:
        """The shaft stands at this angle at this time."""
        self.at_s, self.angle_deg, self.speed_dps, self.held_deg = at_s, angle_deg, 0.0, 0.0

    def feed(self, direction: Direction) -> None:
        """The motor is powered in this direction from now on."""
        if direction is self.fed:
            return
        if direction is Direction.OFF:
            self._off_s = self.at_s
        elif self.speed_dps * direction <= 0.0:
            self.held_deg = 0.0
        self.fed, self.fed_s = direction, 0.0

    def cross(self, edge_deg: float) -> None:
        """The shaft is at an edge of the contact now."""
        self.angle_deg, self.fed_s, self.held_deg = edge_deg, 0.0, 0.0

    def advance(self, at_s: float, low_deg: float, high_deg: float) -> bool:
        """Turn until `at_s`, but stay between these angles. False: no time passed, or nothing moves."""
        seconds = at_s - self.at_s
        if not 0.0 < seconds < math.inf:
            self.at_s = max(at_s, self.at_s)
            return False
        self.at_s = at_s
        if self.fed is not Direction.OFF:
            self.fed_s += seconds
        elif self.speed_dps == 0.0:
            return False
        wanted_dps = self._wanted_dps
        gap_dps, lag_s = self.speed_dps - wanted_dps, self._cam.lag_s
        fade = math.exp(-seconds / lag_s) if lag_s > 0 else 0.0
        self.speed_dps = wanted_dps + gap_dps * fade
        if abs(self.speed_dps) < STANDS_BELOW * self._cam.speed_dps:
            self.speed_dps = 0.0
        reckoned_deg = self.angle_deg + wanted_dps * seconds + gap_dps * lag_s * (1.0 - fade)
        self.angle_deg = max(min(reckoned_deg, high_deg), low_deg)
        self.held_deg += abs(reckoned_deg - self.angle_deg)
        return True

    def learn(self, direction: Direction, measured_dps: float) -> None:
        """A speed measured in that direction, without its sign."""
        self._speeds_dps[direction] += LEARN * (measured_dps - self._speeds_dps[direction])
