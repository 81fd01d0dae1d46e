"""Which stop of a drill is in force: a person's, a storm park, or what is left of one after a restart.

Knows how each of these begins and ends. Does not know the orders for the axes, which most stops end too.
"""

from __future__ import annotations

import math
from enum import Enum, auto

TAKEN_S = 0.2
"""A program that is killed this soon after a stop may not have taken it."""


class Storm(Enum):
    """What a person's order of a storm park has come to."""

    NONE = auto()
    ASKED = auto()
    """The storm park may be under way."""
    HOLDS = auto()
    """The storm park is certainly under way, and holds back every other order of a person."""
    ENDED = auto()
    """The way to the park position has ended. The storm park still holds back every other order of a person."""
    KEPT_OVER_RESTART = auto()
    """The stop in force is a storm park from before a restart: the antenna does not go on by itself, but a person may
    order a storm park again."""


class Stops:
    def __init__(self) -> None:
        self.latched = False
        """A person has stopped the antenna, and has not released it since."""
        self.acknowledged_s = 0.0
        """Time of the last stop of both axes or the last release: both acknowledge faults."""
        self.released_s = 0.0
        """When a person last released the antenna. A restart of the program does not count."""
        self.storm = Storm.NONE
        self._stopped_s = math.inf
        """When a person last stopped the antenna, or ordered a storm park."""

    @property
    def storm_under_way(self) -> bool:
        """Whether a storm park may be under way."""
        return self.storm in (Storm.ASKED, Storm.HOLDS)

    @property
    def storm_holds(self) -> bool:
        """Whether a storm park certainly holds back every other order of a person."""
        return self.storm in (Storm.HOLDS, Storm.ENDED)

    def latch(self, now_s: float) -> None:
        """The stop button of the panel."""
        self.latched, self._stopped_s = True, now_s

    def by_person(self, now_s: float) -> None:
        self.latch(now_s)
        self.acknowledged_s = now_s
        if self.storm is Storm.KEPT_OVER_RESTART:
            self.storm = Storm.NONE

    def by_link(self, now_s: float) -> None:
        """A stop from a link ends the way to the park position only: the stop of the storm park stays latched."""
        self.take()
        self.acknowledged_s = now_s

    def take(self) -> None:
        """The way of a storm park ends, and its stop stays latched."""
        self.latched = self.latched or self.storm_holds

    def end_motion(self) -> None:
        """The motion of a storm park ends with all other orders."""
        if self.storm is Storm.ASKED:
            self.storm = Storm.NONE
        elif self.storm is Storm.HOLDS:
            self.storm = Storm.ENDED

    def order_anew(self) -> None:
        """A storm park from before a restart makes room for a new one."""
        if self.storm is Storm.KEPT_OVER_RESTART:
            self.latched, self.storm = False, Storm.NONE

    def begin_storm(self, now_s: float, *, holds: bool) -> None:
        self.storm, self._stopped_s = Storm.HOLDS if holds else Storm.ASKED, now_s

    def release(self, now_s: float, *, pressed: bool) -> None:
        """A person releases the antenna. `pressed`: the panel's stop button is still pressed in, and holds it."""
        self._free(pressed=pressed)
        self.acknowledged_s = self.released_s = now_s

    def restart(self, now_s: float, *, pressed: bool) -> None:
        """The program ends. A stop that the program had time to store holds in its next run."""
        stopped = (self.latched or self.storm_holds) and now_s - self._stopped_s > TAKEN_S
        parked = stopped and not self.latched
        self._free(pressed=pressed)
        if parked and not self.latched:
            self.storm = Storm.KEPT_OVER_RESTART
        self.latched = self.latched or stopped

    def _free(self, *, pressed: bool) -> None:
        self.latched, self.storm = pressed, Storm.NONE
