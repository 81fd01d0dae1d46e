"""One axis of a ready-made controller: what it is to do, what was sent to it, and what its angles show.

Knows degrees and moments: when a target is worth sending, whether the axis rests, goes on after a stop, or is turned at
the controller's own knob. Knows no byte and no other axis.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

REST_S = 1.0
"""An axis rests when its angles of this time are within a step of each other; a slow one is watched for longer."""
REST_STEPS = 2.5
"""In the time in which its motor turns so many steps."""
COAST_S = 0.8
"""After a stop an axis may coast for this long, with the time that the controller needs to obey."""
STOP_AGAIN_S = 0.5
"""An axis that goes on is stopped again after this time, and again."""
FAST_SHARE = 0.5
"""A target that moves at this share of the motor's speed is a jog: it must not arrive before the next target."""
BY_HAND_SHOWN_S = 5.0
JUMP_DEG = 5.0
STREAM_S, SETTLES_S = 3.0, 10.0
"""Two targets within the first are a pass. So soon after its last one, a controller that goes on is no hand: a box like
this one takes the orders of a pass for one that goes on. When it rests, it is told its target again."""


@dataclass(frozen=True, slots=True)
class CourseSpec:
    """What is known of one axis. Angles are on the rotor's own scale."""

    step_deg: float
    """The controller tells its angle in steps of this."""
    order_deg: float
    """It can be sent to every multiple of this."""
    tolerance_deg: float
    """A target nearer than this to the last one is not sent."""
    low_deg: float
    high_deg: float
    """No target is sent beyond these."""
    speed_dps: float
    near_deg: float = 2.5
    """It may come to rest this far from its target."""
    from_deg: float | None = None
    """The controller counts one turn, from this angle up; None: it counts as the rotor does."""

    @property
    def rest_s(self) -> float:
        return max(REST_S, REST_STEPS * self.step_deg / self.speed_dps)

    def own(self, told_deg: float) -> float:
        """The angle on the rotor's own scale that the controller means."""
        if self.from_deg is None:
            return told_deg
        middle_deg = (self.low_deg + self.high_deg) / 2
        return middle_deg + math.remainder(told_deg - middle_deg, 360.0)

    def told(self, own_deg: float) -> float:
        """The angle by which the controller knows this one."""
        return own_deg if self.from_deg is None else self.from_deg + (own_deg - self.from_deg) % 360.0

    def nearest(self, angle_deg: float) -> float:
        """The nearest angle that the controller can be sent to."""
        low = math.ceil(self.low_deg / self.order_deg - 1e-6)
        high = math.floor(self.high_deg / self.order_deg + 1e-6)
        return min(max(round(angle_deg / self.order_deg), low), high) * self.order_deg


@dataclass(frozen=True, slots=True)
class Wish:
    """Be at `angle_deg` at the moment `at_s`, moving on at `rate_dps`; it lives until `until_s`."""

    angle_deg: float
    rate_dps: float
    at_s: float
    until_s: float


class Course:
    def __init__(self, spec: CourseSpec) -> None:
        self.spec = spec
        self.wish: Wish | None = None
        self.angle_deg: float | None = None
        """The latest answer; None: there is none yet."""
        self.sent_deg: float | None = None
        """The target that the controller has; None: it was stopped, or never sent anywhere."""
        self.stop_due = False
        self.runs_on = False
        """It goes on though it was stopped."""
        self._arrived = False
        self._seen: deque[tuple[float, float]] = deque()
        self._rest_deg: float | None = None
        """Where it came to rest; None: it turns."""
        self._stopped_s: float | None = None
        """The first stop of an axis that has not been seen to rest since."""
        self._again_s = 0.0
        self._runs_from_deg: float | None = None
        self._left_to_hand_deg: float | None = None
        """The target from which a person turned it away: it is not sent there again by itself."""
        self._by_hand_s = -math.inf
        self._told_s: float | None = None
        """The first answer since it was sent somewhere; None: there is none yet."""
        self._streams = False
        """Its latest targets came one after another, as those of a pass."""

    # --- what it is to do

    def aim(self, wish: Wish) -> None:
        self.wish = wish

    def hold(self) -> None:
        """The controller's own stop, if it has a target of this box."""
        self.stop_due = self.stop_due or self.sent_deg is not None
        self.wish = self._left_to_hand_deg = None

    def halt(self) -> None:
        """The controller's own stop in any case: a person asks for it."""
        self.hold()
        self.stop_due = True

    def expire(self, now_s: float) -> None:
        if self.wish is not None and self.wish.until_s <= now_s:
            self.hold()

    def target(self, now_s: float) -> float | None:
        """Where to send it now; None: it has its target, or none."""
        wish, spec = self.wish, self.spec
        if wish is None or self.angle_deg is None or self.stop_due:
            return None
        place_deg = wish.angle_deg + wish.rate_dps * (now_s - wish.at_s)
        if self._left_to_hand_deg is not None:
            if abs(place_deg - self._left_to_hand_deg) < max(spec.tolerance_deg, spec.step_deg):
                return None
            self._left_to_hand_deg = None
        if wish.rate_dps:
            return self._ahead(place_deg, wish.rate_dps)
        target_deg = spec.nearest(place_deg)
        if self.sent_deg is None and self._rest_deg is not None:
            if abs(target_deg - self.angle_deg) < max(spec.tolerance_deg, spec.step_deg / 2):
                self.sent_deg, self._arrived = target_deg, True  # it is there
                return None
        elif self.sent_deg is not None and abs(target_deg - self.sent_deg) < max(
            spec.tolerance_deg, 0.9 * spec.order_deg
        ):
            # It rests elsewhere: it has lost the order, or it took the orders of a pass for one that goes on.
            return target_deg if self._rest_deg is not None and not self._arrived else None
        return target_deg

    def _ahead(self, place_deg: float, rate_dps: float) -> float | None:
        """A place on the way of a moving target: it stands there while the target goes by, half before and half after.
        A fast one is a jog: it gets its next target before it has come to this one."""
        way, spec = math.copysign(1.0, rate_dps), self.spec
        jogs = abs(rate_dps) >= FAST_SHARE * spec.speed_dps
        ahead_deg = 2.0 * abs(rate_dps) if jogs else max(spec.tolerance_deg, abs(rate_dps)) / 2
        behind_deg = -ahead_deg / 2 if jogs else spec.tolerance_deg / 2
        target_deg = spec.nearest(place_deg + way * ahead_deg)
        if self.sent_deg is None:
            return target_deg
        lag_deg = (place_deg - self.sent_deg) * way
        off = lag_deg >= behind_deg or -lag_deg > ahead_deg + max(spec.tolerance_deg, spec.step_deg)
        return target_deg if off and target_deg != self.sent_deg else None

    def overshoots(self, target_deg: float) -> bool:
        """Whether the controller, on its way to its last target, goes away from this one or beyond it."""
        if self.sent_deg is None or self.angle_deg is None or self.wish is None or self.wish.rate_dps or self._arrived:
            return False
        way = math.copysign(1.0, self.sent_deg - self.angle_deg)
        return (self.sent_deg - target_deg) * way > max(self.spec.tolerance_deg, self.spec.step_deg)

    def was_sent(self, target_deg: float) -> None:
        latest_s = self._seen[-1][0] if self._seen else math.inf
        self._streams = self._told_s is not None and latest_s - self._told_s < STREAM_S
        self.sent_deg, self._arrived, self._told_s = target_deg, False, None
        self._stopped_s, self.runs_on = None, False
        self.forget()

    def was_stopped(self, now_s: float, *, asked: bool) -> None:
        """The controller was told to stop. `asked`: this axis was to stop, and not only its neighbour."""
        if asked and self._stopped_s is None:
            self._stopped_s, self._runs_from_deg = now_s, None
        self._again_s = now_s + STOP_AGAIN_S
        self.stop_due, self.sent_deg = False, None

    # --- what it is seen to do

    def heard(self, told_deg: float, asked_s: float, now_s: float) -> None:
        """An answer: where it was at a moment between `asked_s` and `now_s`."""
        angle_deg = self.spec.own(told_deg)
        if self._jumps(angle_deg, now_s):
            self.forget()
        self.angle_deg = angle_deg
        if self._told_s is None and self.sent_deg is not None:
            self._told_s = now_s
        self._seen.append((now_s, angle_deg))
        while self._seen[0][0] < now_s - self.spec.rest_s - 0.5 and len(self._seen) > 1:
            self._seen.popleft()
        if self._rests(now_s):
            self._rest_deg = angle_deg if self._rest_deg is None else self._rest_deg
            self._stopped_s, self.runs_on = None, False
            self._arrived = self._arrived or (
                self.sent_deg is not None and abs(angle_deg - self.sent_deg) <= self.spec.near_deg
            )
        self._watch_stop(angle_deg, asked_s, now_s)
        self._watch_hand(angle_deg, now_s)

    def back(self) -> None:
        """The controller answers again. A stop that it may not have heard is sent again."""
        if self._stopped_s is not None:
            self._stopped_s, self.stop_due = None, True

    def forget(self) -> None:
        """It begins anew to be watched: it was sent elsewhere, its connection was lost, or its angles jumped."""
        self._seen.clear()
        self._rest_deg = None

    def by_hand(self, now_s: float) -> bool:
        """Whether it is turned, or was a moment ago, though this box has not ordered it."""
        return now_s - self._by_hand_s < BY_HAND_SHOWN_S

    @property
    def waits(self) -> bool:
        """Whether it has nothing to turn to: its controller does not bear its next target yet. Its motor is off."""
        return self.wish is not None and not self.left_to_hand and (self.sent_deg is None or self._arrived)

    @property
    def left_to_hand(self) -> bool:
        """Whether it is not where it was sent because a person has turned it since."""
        return self._left_to_hand_deg is not None

    def _jumps(self, angle_deg: float, now_s: float) -> bool:
        """Whether it is further from the answer before than any motor turns."""
        if not self._seen:
            return False
        at_s, before_deg = self._seen[-1]
        return abs(angle_deg - before_deg) > JUMP_DEG + 2.0 * self.spec.speed_dps * (now_s - at_s)

    def _rests(self, now_s: float) -> bool:
        if not self._seen or self._seen[0][0] > now_s - self.spec.rest_s:
            return False
        latest = [angle_deg for at_s, angle_deg in self._seen if at_s >= now_s - self.spec.rest_s]
        return max(latest) - min(latest) <= self.spec.step_deg + 0.3

    def _watch_stop(self, angle_deg: float, asked_s: float, now_s: float) -> None:
        if self._stopped_s is None or asked_s < self._stopped_s + COAST_S:
            return
        self._runs_from_deg = angle_deg if self._runs_from_deg is None else self._runs_from_deg
        if abs(angle_deg - self._runs_from_deg) >= 1.5 * self.spec.step_deg + 0.3:
            self.runs_on = True
        if self.runs_on and now_s >= self._again_s:
            self.stop_due = True

    def _watch_hand(self, angle_deg: float, now_s: float) -> None:
        """An axis that rested where it was to rest, and turns."""
        if self.wish is not None and self.wish.rate_dps:
            return  # it goes along with a target: it does not rest
        if self._rest_deg is None or abs(angle_deg - self._rest_deg) < 1.0 + 2.0 * self.spec.step_deg:
            return
        self._rest_deg = None
        if self._streams and self.sent_deg is not None and now_s - (self._told_s or now_s) < SETTLES_S:
            self._arrived = False  # when it rests, it is told its target again
        if self.sent_deg is not None and not self._arrived:
            return
        self._by_hand_s = now_s
        self._left_to_hand_deg = self._left_to_hand_deg if self.sent_deg is None else self.sent_deg
        self._rest_deg = angle_deg  # from here it is looked at anew
