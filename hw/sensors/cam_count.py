"""The angle from a contact that shows neither direction nor place: a count of the zones of its cam (`hw.sensors.cam`).

Knows the cam, and the times at which the motor was powered and the contact changed. Knows no GPIO line and no clock:
times are arguments, in seconds. `trouble` says why the count may be wrong. Then the count is unreliable until the axis
is placed again.

The rules follow from the limits of a rotor. It cannot cross a zone in less than half the time that its speed needs. A
sooner change undoes the one before (a bounce longer than the debounce, a trembling contact, a spark). A change much too
early is a doubled pulse. A change much too late means a missed pulse, or a motor that was held.

One error stays unseen: a missed pulse that no other pulse follows. The motor stops beyond it, the power fails, and the
stored count is one too low. A pulse missed at half the motor's speed stays unseen too. Homing finds both.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable

from hw.ports import Direction
from hw.sensors.cam import FASTER, Cam
from hw.sensors.shaft import ReckonedShaft
from hw.sensors.undriven import UndrivenChanges

LEAST_CROSSING = 0.5
"""Share of a zone's time at full speed: no zone is crossed in less."""
SLOW = 0.1
"""Share of full speed: below it a rotor may already have turned back, and the nearer edge is the one it crossed."""
NEAR = 0.4
"""Share of the zone's width: a standing rotor that crosses an edge was this near to it."""
FORGIVEN = 0.2
"""Share of the distance between two edges: a given angle may lie in the wrong zone by at most this."""
TOO_SOON, TOO_LATE = 0.5, 0.75
"""Shares of the zone's width: a change this far before, or after, the angle of its edge belongs to another zone."""
QUIET_PERIODS = 3.0
"""Periods under power without a change: the motor is held, or at its end stop, or the contact is dead."""


class CamCount:
    """Call `drive` for each change of the motor's relays, `change` for each change of the contact, in order of time."""

    def __init__(self, cam: Cam) -> None:
        self.cam = cam
        self.zone = 0
        self.trouble = ""
        """Why the count may be wrong; empty while the count is right."""
        self.changes = 0
        """The number of changes of the contact since the start."""
        self._shaft = ReckonedShaft(cam)
        self._crept = False
        """Whether the shaft has crossed an edge at rest, without a relay on."""
        self._changed_s = -math.inf
        self._before: tuple[int, float] | None = None
        """Zone and angle before the last change, which the next change may undo."""
        self._last_step = 0
        self._undone = False
        """Whether the last change undid the one before it. An equally soon next change restores that one."""
        self._run: tuple[tuple[int, float], ...] = ()
        """The last three zones of this run, each with the time of entry."""
        self._undriven = UndrivenChanges(cam)

    # --- state

    def angle_deg(self) -> float:
        """The angle at the last call: the zone is counted; within the zone it is reckoned by time, never beyond it."""
        return self._shaft.angle_deg

    def ahead_deg(self, driven: Iterable[tuple[float, Direction]], at_s: float) -> float:
        """The angle at `at_s` if the contact does not change. `driven`: times from which, and directions in which, the
        motor is powered.

        Does not change the count.
        """
        shaft, zone_deg = copy.copy(self._shaft), self._zone_deg()
        for fed_s, direction in driven:
            shaft.advance(fed_s, *zone_deg)
            shaft.feed(direction)
        shaft.advance(at_s, *zone_deg)
        return shaft.angle_deg

    @property
    def quiet(self) -> bool:
        """Whether the shaft was driven for three periods without a pulse."""
        return self._shaft.fed_deg > QUIET_PERIODS * self.cam.spacing_deg

    @property
    def turning(self) -> bool:
        """Whether the motor runs at its speed with no relay on: a relay has welded, or it has another supply."""
        return self.at_rest and self._undriven.show_motor(self._shaft.at_s)

    @property
    def at_rest(self) -> bool:
        """Whether no relay is on and the motor has stopped coasting."""
        return self._shaft.at_rest

    # --- events

    def place(self, at_s: float, angle_deg: float, *, closed: bool, within_deg: float = 0.0) -> bool:
        """The shaft stands at `angle_deg`. False: the contact's state contradicts the angle, and `trouble` says so.

        A contact in the other state is accepted if the play, or a very near edge of the zone, explains it.
        `within_deg`: possible error of the angle. Then exactly one zone within it must have the contact's state.
        """
        if within_deg > 0.0:
            return self._place_near(at_s, angle_deg, within_deg, closed=closed)
        zone, *turned_back = self.cam.zones(angle_deg, angle_deg)
        believed = True
        if closed is not (zone % 2 == 0) and turned_back:
            zone = turned_back[0]
        elif closed is not (zone % 2 == 0):
            above_deg = angle_deg - self.cam.begins_deg(zone)
            below_deg = self.cam.begins_deg(zone + 1) - angle_deg
            believed = min(above_deg, below_deg) <= FORGIVEN * (above_deg + below_deg)
            zone += -1 if above_deg < below_deg else 1
        state = "closed" if closed else "open"
        trouble = "" if believed else f"the contact is {state}, which it is not at {angle_deg:.1f}°"
        return self._put(at_s, zone, angle_deg, trouble)

    def advance(self, at_s: float) -> None:
        """No event happened up to this moment."""
        if self._shaft.advance(at_s, *self._zone_deg()) and self.quiet and not self._near_end():
            self._doubt("driven for three periods, and the contact did not change")

    def drive(self, at_s: float, direction: Direction) -> None:
        """The motor is powered in this direction from this time on."""
        self.advance(at_s)
        if direction is self._shaft.fed:
            return
        self._shaft.feed(direction)
        if direction is not Direction.OFF:
            self._crept = False
        self._undriven.forget()
        self._run = ()

    def change(self, at_s: float, *, closed: bool, lost: int = 0) -> None:
        """The contact changed; `lost` changes before this one were not recorded."""
        self.advance(at_s)
        self.changes += 1
        if self.at_rest:
            self._undriven.note(at_s, closed=closed)
        if lost or closed is (self.zone % 2 == 0):
            self._doubt(f"{lost or 1} changes of the contact went unseen")
            self.zone += (lost or 1) * self._direction()
            self._before = None
        direction = self._direction()
        soon = self._before is not None and at_s - self._changed_s < LEAST_CROSSING * self._zone_s()
        if soon and (direction == self._last_step or self._undone):
            self._undo(at_s)
            return
        if soon:
            self._crept = False  # the shaft turned back, or the contact trembles
        else:
            self._check(direction)
        self._before, self._last_step, self._undone = (self.zone, self._shaft.angle_deg), direction, False
        self._changed_s = at_s
        self._enter(self.zone + direction, direction)
        self._learn(at_s, direction)

    # --- conclusions

    def _place_near(self, at_s: float, angle_deg: float, within_deg: float, *, closed: bool) -> bool:
        near = self.cam.zones(angle_deg - within_deg, angle_deg + within_deg)
        alike = [zone for zone in near if closed is (zone % 2 == 0)]
        state, place = "closed" if closed else "open", f"within {within_deg:g}° of {angle_deg:.1f}°"
        if len(alike) != 1:
            where = "more than one place" if alike else "no place"
            trouble = f"the contact is {state}, as it is at {where} {place}: correct home_deg, or move the limit switch"
            return self._put(at_s, self.cam.zone_at(angle_deg), angle_deg, trouble)
        begins_deg = self.cam.begins_deg(alike[0]) - self.cam.play_deg
        return self._put(at_s, alike[0], min(max(angle_deg, begins_deg), self.cam.begins_deg(alike[0] + 1)), "")

    def _put(self, at_s: float, zone: int, angle_deg: float, trouble: str) -> bool:
        self.zone = zone
        self._shaft.place(at_s, angle_deg)
        self._before, self._crept = None, False
        self._run = ()
        self.trouble = trouble
        return not trouble

    def _zone_deg(self) -> tuple[float, float]:
        """The lowest and the highest angle of a shaft in this zone."""
        low_deg = max(self.cam.begins_deg(self.zone) - self.cam.play_deg, self.cam.low_deg)
        return low_deg, min(self.cam.begins_deg(self.zone + 1), self.cam.high_deg)

    def _direction(self) -> int:
        """The direction in which the shaft crosses the edge: 1 is plus, -1 minus."""
        if abs(self._shaft.speed_dps) >= SLOW * self.cam.speed_dps:
            return 1 if self._shaft.speed_dps > 0 else -1
        return 1 if self._to_edge_deg(1) < self._to_edge_deg(-1) else -1

    def _to_edge_deg(self, direction: int) -> float:
        if direction > 0:
            return self.cam.begins_deg(self.zone + 1) - self._shaft.angle_deg
        return self._shaft.angle_deg - self.cam.begins_deg(self.zone) + self.cam.play_deg

    def _width_deg(self) -> float:
        return self.cam.begins_deg(self.zone + 1) - self.cam.begins_deg(self.zone)

    def _zone_s(self) -> float:
        return self._width_deg() / self._shaft.top_speed_dps

    def _enter(self, zone: int, direction: int) -> None:
        play_deg = self.cam.play_deg if direction < 0 else 0.0
        self._shaft.cross(self.cam.begins_deg(max(zone, self.zone)) - play_deg)
        self.zone = zone

    def _undo(self, at_s: float) -> None:
        assert self._before is not None
        travelled_deg = self._shaft.speed_dps * (at_s - self._changed_s)
        (zone, angle_deg), self._before = self._before, (self.zone, self._shaft.angle_deg)
        self.zone, self._shaft.angle_deg = zone, angle_deg + travelled_deg
        self._changed_s, self._undone = at_s, True
        self._run = ()
        self.advance(at_s)

    def _check(self, direction: int) -> None:
        """A change that no rotor can cause makes the count doubtful."""
        slack_deg = self.cam.speed_dps * self.cam.lag_s
        to_edge_deg = self._to_edge_deg(direction)
        if self.at_rest:
            if self._crept or to_edge_deg > NEAR * self._width_deg():
                self._doubt("it turns with no relay on")
            self._crept = True
        elif to_edge_deg > TOO_SOON * self._width_deg() + slack_deg:
            self._doubt("the contact changed too soon: it closes twice, or a pulse was missed before")
        elif self._shaft.held_deg > min(TOO_LATE * self._width_deg(), 0.5 * self.cam.spacing_deg) + slack_deg:
            self._doubt("the contact changed too late: a pulse was missed, or the motor was held")

    def _learn(self, at_s: float, direction: int) -> None:
        """Measure the speed over one period of a run, from closing to closing: the closed width does not affect it."""
        self._run = (*self._run[-2:], (self.zone, at_s))
        if self._shaft.fed != direction or self._run[0][0] != self.zone - 2 * direction:
            return
        measured_dps = self.cam.spacing_deg / (at_s - self._run[0][1])
        believable = self.cam.speed_dps / FASTER <= measured_dps <= self.cam.speed_dps * FASTER
        if believable and not self.trouble:
            self._shaft.learn(Direction(direction), measured_dps)

    def _near_end(self) -> bool:
        end_deg = self.cam.high_deg if self._shaft.fed > 0 else self.cam.low_deg
        return (end_deg - self._shaft.angle_deg) * self._shaft.fed <= self.cam.spacing_deg

    def _doubt(self, why: str) -> None:
        """Note why the count may be wrong. The first reason stays."""
        self.trouble = self.trouble or why
