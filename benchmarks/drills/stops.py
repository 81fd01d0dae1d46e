"""Which stop of a drill is in force: a person's, or what is left of one after a restart; whether a storm park is on.

Knows how each of these begins and ends. Does not know the orders for the axes, which most stops end too. That a storm
park holds back every other order is excused here, and tested elsewhere.
"""

from __future__ import annotations

import math

TAKEN_S = 0.2
"""A program that is killed this soon after a stop may not have taken it."""


class Stops:
    def __init__(self) -> None:
        self.latched = False
        """A person has stopped the antenna, and has not released it since."""
        self.acknowledged_s = 0.0
        """Time of the last stop of both axes or the last release: both acknowledge faults."""
        self.released_s = 0.0
        """When a person last released the antenna. A restart of the program does not count."""
        self.storm_under_way = False
        """A storm park may be under way."""
        self.stormed = False
        """There was one since the last release: it may hold back orders still."""
        self._stopped_s = math.inf
        """When a person last stopped the antenna."""

    def latch(self, now_s: float) -> None:
        """The stop button of the panel."""
        self.latched, self._stopped_s = True, now_s

    def by_person(self, now_s: float) -> None:
        self.latch(now_s)
        self.acknowledged_s = now_s

    def by_link(self, now_s: float) -> None:
        self.acknowledged_s = now_s

    def begin_storm(self) -> None:
        self.storm_under_way = self.stormed = True

    def end_motion(self) -> None:
        """The motion of a storm park ends with all other orders."""
        self.storm_under_way = False

    def release(self, now_s: float, *, pressed: bool) -> None:
        """A person releases the antenna. `pressed`: the panel's stop button is still pressed in, and holds it."""
        self.latched, self.storm_under_way, self.stormed = pressed, False, False
        self.acknowledged_s = self.released_s = now_s

    def restart(self, now_s: float, *, pressed: bool) -> None:
        """The program ends. A stop that the program had time to store holds in its next run."""
        self.latched = pressed or (self.latched and now_s - self._stopped_s > TAKEN_S)
        self.storm_under_way = False
