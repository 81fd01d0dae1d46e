"""An angle from a contact that tells neither direction nor place, by counting the zones of its cam (`hw.sensors.cam`).

Knows the cam, the motor's speed and what the relays do. Knows no line and no clock: moments are arguments. What it
cannot know for certain it says (`trouble`); until somebody who sees the antenna places it anew, it is a guess.

Three things that no rotor can do are used: it cannot cross a zone in less than half the time its speed allows, so that
a change sooner than that undoes the one before (bounce longer than the debounce, a contact that trembles, a spark); it
cannot come much too soon (a pulse doubled) nor much too late (a pulse missed, or the motor was held).

Nobody can notice a pulse missed that is met by none after it: the motor stops beyond it, the power goes, and the kept
count is one short; or one missed while the motor ran at half its speed. Homing finds both.
"""

from __future__ import annotations

import math
from collections import deque
from itertools import pairwise

from hw.ports import Direction
from hw.sensors.cam import Cam

LEAST_CROSSING = 0.5
"""No zone is crossed in less than this share of the time that its width takes at full speed."""
SLOW = 0.1
"""Below this share of its speed a rotor may already have turned back: the nearer edge is the one it crossed."""
NEAR = 0.4
"""A standing rotor that crosses an edge was within this share of the zone's width."""
FORGIVEN = 0.2
"""A place told is so much of its zone's width wrong at most, where the contact says that it is in the next zone."""
TOO_SOON, TOO_LATE = 0.5, 0.75
"""A change this share of the zone's width before its edge is reckoned to come, or after, is none of this zone's."""
QUIET_PERIODS = 3.0
"""Driven for so many periods without a change of the contact: held, at the end stop, or the contact is dead."""
LEARN = 0.25
"""How much of a newly measured speed is believed."""
TURNING_CHANGES = 4
"""So many changes at rest, as far apart as at full speed, are a motor that is still fed."""
FASTER = 2.0
"""The speed measured may be this much faster or slower than the one configured."""


class CamCount:
    """Tell it, in order of time, what drives the motor (`drive`) and what the contact did (`change`)."""

    def __init__(self, cam: Cam) -> None:
        self.cam = cam
        self.zone = 0
        self.trouble = ""
        """Why the count may be wrong; empty: it is right."""
        self.changes = 0
        """How often the contact has changed since the start, for whoever waits for it."""
        self._at_s = -math.inf
        self._shaft_deg = 0.0
        self._speed_dps = 0.0
        self._drive = Direction.OFF
        self._off_s = -math.inf
        self._quiet_s = 0.0
        """How long it has been driven since the contact last changed."""
        self._held_deg = 0.0
        """How far it should have come beyond the end of its zone."""
        self._crept = False
        self._changed_s = -math.inf
        self._before: tuple[int, float] | None = None
        """Zone and angle before the last change, which the next may undo."""
        self._last_step = 0
        self._undone = False
        """The last change undid another; one that comes as soon undoes that."""
        self._run: tuple[tuple[int, float], ...] = ()
        """Zones entered in this run, the last three, and when."""
        self._undriven: deque[tuple[float, bool]] = deque(maxlen=TURNING_CHANGES)
        """When the contact changed at rest, and to what."""
        self._speeds_dps = dict.fromkeys((Direction.PLUS, Direction.MINUS), cam.speed_dps)

    # --- what is known

    def angle_deg(self) -> float:
        """As of the last thing it was told: counted to the zone, reckoned by time within it, never beyond it."""
        return self._shaft_deg

    @property
    def quiet(self) -> bool:
        """Driven for three periods without a pulse."""
        if self._drive is Direction.OFF:
            return False
        return self._quiet_s * self._speeds_dps[self._drive] > QUIET_PERIODS * self.cam.spacing_deg

    @property
    def turning(self) -> bool:
        """It runs at its speed though no relay is on: welded, or somebody else feeds it."""
        if not self.at_rest or len(self._undriven) < TURNING_CHANGES:
            return False
        # Wind that rocks an antenna about an edge of the contact changes it as often, but never at a motor's pace.
        spans = [
            (later_s - earlier_s, self._crossing_s(closed=closed))
            for (earlier_s, closed), (later_s, _) in pairwise([*self._undriven, (self._at_s, False)])
        ]
        paced = all(expected_s / FASTER <= span_s <= expected_s * FASTER for span_s, expected_s in spans[:-1])
        return paced and spans[-1][0] <= spans[-1][1] * FASTER

    @property
    def at_rest(self) -> bool:
        return self._drive is Direction.OFF and self._at_s - self._off_s >= self.cam.coast_s

    # --- what it is told

    def place(self, at_s: float, angle_deg: float, *, closed: bool) -> bool:
        """It stands at that angle, says somebody who knows. False: the contact says it does not, and there is trouble.

        A contact that is in the other state is forgiven where one edge of the zone is much nearer than the other.
        """
        zone = self.cam.zone_at(angle_deg)
        believed = True
        if closed is not (zone % 2 == 0):
            above_deg = angle_deg - self.cam.begins_deg(zone)
            below_deg = self.cam.begins_deg(zone + 1) - angle_deg
            believed = min(above_deg, below_deg) <= FORGIVEN * (above_deg + below_deg)
            zone += -1 if above_deg < below_deg else 1
        self._at_s, self.zone, self._shaft_deg, self._speed_dps = at_s, zone, angle_deg, 0.0
        self._before, self._held_deg, self._crept = None, 0.0, False
        self._run = ()
        state = "closed" if closed else "open"
        self.trouble = "" if believed else f"the contact is {state}, which it is not at {angle_deg:.1f}°"
        return believed

    def advance(self, at_s: float) -> None:
        """Nothing has happened up to then."""
        seconds = at_s - self._at_s
        if not 0.0 < seconds < math.inf:
            self._at_s = max(at_s, self._at_s)
            return
        self._at_s = at_s
        if self._drive is not Direction.OFF:
            self._quiet_s += seconds
        elif self._speed_dps == 0.0:
            return
        wanted_dps = self._drive * self._speeds_dps.get(self._drive, 0.0)
        gap_dps, lag_s = self._speed_dps - wanted_dps, self.cam.lag_s
        fade = math.exp(-seconds / lag_s) if lag_s > 0 else 0.0
        self._speed_dps = wanted_dps + gap_dps * fade
        if abs(self._speed_dps) < SLOW**3 * self.cam.speed_dps:
            self._speed_dps = 0.0
        reckoned_deg = self._shaft_deg + wanted_dps * seconds + gap_dps * lag_s * (1.0 - fade)
        low_deg = max(self.cam.begins_deg(self.zone) - self.cam.play_deg, self.cam.low_deg)
        high_deg = min(self.cam.begins_deg(self.zone + 1), self.cam.high_deg)
        self._shaft_deg = max(min(reckoned_deg, high_deg), low_deg)
        self._held_deg += abs(reckoned_deg - self._shaft_deg)
        if self.quiet and not self._near_end():
            self._doubt("driven for three periods, and the contact did not change")

    def drive(self, at_s: float, direction: Direction) -> None:
        """The motor is fed that way from then on."""
        self.advance(at_s)
        if direction is self._drive:
            return
        if direction is Direction.OFF:
            self._off_s = at_s
        else:
            self._crept = False
            if self._speed_dps * direction <= 0.0:
                self._held_deg = 0.0
        self._undriven.clear()
        self._drive = direction
        self._quiet_s = 0.0
        self._run = ()

    def change(self, at_s: float, *, closed: bool, lost: int = 0) -> None:
        """The contact changed; `lost` changes before that went unseen."""
        self.advance(at_s)
        self.changes += 1
        if self.at_rest:
            self._undriven.append((at_s, closed))
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
            self._crept = False  # turned back, or trembling
        else:
            self._check(direction)
        self._before, self._last_step, self._undone = (self.zone, self._shaft_deg), direction, False
        self._changed_s = at_s
        self._enter(self.zone + direction, direction)
        self._learn(at_s, direction)

    # --- how it concludes

    def _direction(self) -> int:
        """Which way it crosses the edge."""
        if abs(self._speed_dps) >= SLOW * self.cam.speed_dps:
            return 1 if self._speed_dps > 0 else -1
        return 1 if self._to_edge_deg(1) < self._to_edge_deg(-1) else -1

    def _to_edge_deg(self, direction: int) -> float:
        if direction > 0:
            return self.cam.begins_deg(self.zone + 1) - self._shaft_deg
        return self._shaft_deg - self.cam.begins_deg(self.zone) + self.cam.play_deg

    def _crossing_s(self, *, closed: bool) -> float:
        """How long the contact stays so at full speed."""
        width_deg = self.cam.closed_deg if closed else self.cam.spacing_deg - self.cam.closed_deg
        return width_deg / self.cam.speed_dps

    def _width_deg(self) -> float:
        return self.cam.begins_deg(self.zone + 1) - self.cam.begins_deg(self.zone)

    def _zone_s(self) -> float:
        return self._width_deg() / max(self._speeds_dps.values())

    def _enter(self, zone: int, direction: int) -> None:
        play_deg = self.cam.play_deg if direction < 0 else 0.0
        self._shaft_deg = self.cam.begins_deg(max(zone, self.zone)) - play_deg
        self.zone = zone
        self._quiet_s = self._held_deg = 0.0

    def _undo(self, at_s: float) -> None:
        assert self._before is not None
        travelled_deg = self._speed_dps * (at_s - self._changed_s)
        (zone, shaft_deg), self._before = self._before, (self.zone, self._shaft_deg)
        self.zone, self._shaft_deg = zone, shaft_deg + travelled_deg
        self._changed_s, self._undone = at_s, True
        self._run = ()
        self.advance(at_s)

    def _check(self, direction: int) -> None:
        """What no rotor does makes the count doubtful."""
        slack_deg = self.cam.speed_dps * self.cam.lag_s
        to_edge_deg = self._to_edge_deg(direction)
        if self.at_rest:
            if self._crept or to_edge_deg > NEAR * self._width_deg():
                self._doubt("it turns with no relay on")
            self._crept = True
        elif to_edge_deg > TOO_SOON * self._width_deg() + slack_deg:
            self._doubt("the contact changed too soon: it closes twice, or a pulse was missed before")
        elif self._held_deg > min(TOO_LATE * self._width_deg(), 0.5 * self.cam.spacing_deg) + slack_deg:
            self._doubt("the contact changed too late: a pulse was missed, or the motor was held")

    def _learn(self, at_s: float, direction: int) -> None:
        """The speed, from one closing to the next (or one opening) within a run: how wide it is does not matter."""
        self._run = (*self._run[-2:], (self.zone, at_s))
        if self._drive != direction or self._run[0][0] != self.zone - 2 * direction:
            return
        measured_dps = self.cam.spacing_deg / (at_s - self._run[0][1])
        believable = self.cam.speed_dps / FASTER <= measured_dps <= self.cam.speed_dps * FASTER
        if believable and not self.trouble:
            way = Direction(direction)
            self._speeds_dps[way] += LEARN * (measured_dps - self._speeds_dps[way])

    def _near_end(self) -> bool:
        end_deg = self.cam.high_deg if self._drive > 0 else self.cam.low_deg
        return (end_deg - self._shaft_deg) * self._drive <= self.cam.spacing_deg

    def _doubt(self, why: str) -> None:
        self.trouble = self.trouble or why
