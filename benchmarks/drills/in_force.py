"""The orders of a drill that are in force, axis by axis, and what ends them: stops, a lost loop, the program's end.

Knows which state holds the antenna back. Does not know which order of a sender means what: `orders` enters them. The
stops are in `stops`, the page's button in `goals`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from benchmarks.drills.front_panel import STILL_AT_MOST_S, FrontPanel
from benchmarks.drills.goals import (
    AT_END,
    BUTTON,
    STREAM_S,
    TURN_DEG,
    WAITED_FOR_S,
    ZENITH_DEG,
    AxisOrders,
    Goal,
    HeldButton,
    Ranges,
    Target,
)
from benchmarks.drills.held_off import HeldOff, Silenced
from benchmarks.drills.script import LINKS, PAGE, PANEL, PEOPLE, Event
from benchmarks.drills.stops import Stops
from benchmarks.drills.tracked import Tracked

AXES = ("azimuth", "elevation")
UNCALIBRATED_S = 2.0
"""A press turns an axis that was never set up for this time at most."""
PUT_OFF_S = 6.0
"""A jog with a time may begin this late: when the box has seen the axis stand."""
UNSEEN_S = 0.2
"""A stop and its release, or a new mode, this soon after a turn of a knob may come before the panel has seen it."""
ROUND, BEFORE = "round a sector", "before a jog"


class InForce:
    """Give it every event (`note`), and the time (`expire`). `lacking`: the axis that was never set up.

    `confirms`: a person may confirm the angle of an axis. `counts`: the axes count, and may not be homed yet. `turns`:
    whether an axis turns or its motor is fed; the box may then refuse a confirmed angle. `at_end`: whether an axis
    stands near that end of its range; a person's jog is refused there.
    """

    def __init__(
        self,
        ranges: tuple[Ranges, Ranges],
        park_deg: tuple[float, float],
        *,
        lacking: str = "",
        left_alone: bool = False,
        parks_idle: bool = False,
        confirms: bool = True,
        turns: Callable[[str], bool] = lambda _axis: False,
        counts: bool = False,
        follows: bool = False,
        at_end: Callable[[str, int], bool] = lambda _axis, _way: False,
    ) -> None:
        self.axes = {name: AxisOrders() for name in AXES}
        self._spans = dict(zip(AXES, ranges, strict=True))
        self._park_deg = dict(zip(AXES, park_deg, strict=True))
        self.lacking = lacking
        self._left_alone = left_alone
        self._parks_idle = parks_idle
        self._confirms = confirms
        self._turns = turns
        self._turned_s = dict.fromkeys(AXES, -math.inf)
        self._counts = counts
        self._at_end = at_end
        self.stops = Stops()
        self.ended_at_s = 0.0
        """When the program last ended."""
        self.button = HeldButton(self.axes, lacking)
        self._panel = FrontPanel()
        self.goes_round = False
        """Forbidden sectors lie in the way: an order for one axis may turn both."""
        self._silenced = Silenced()
        self._held_off = HeldOff()
        self._modes_known_s = STILL_AT_MOST_S
        """Until this moment the first reading of a panel's mode switch may end a person's hold of the antenna."""
        self.sure = False
        """A direction is in force for certain: nothing held back its order, and nothing has ended it."""
        self._listed = False
        """The box may have a list to run."""
        self._tracked = Tracked(self.axes, self._spans, follows=follows, lacking=lacking)
        self._targets = {name: Target() for name in AXES}
        self._shifted = False
        """The panel has shifted the target in AUTO: by how much is not followed, until the mode changes."""
        self.heard = 0
        """How many orders there have been."""
        self._knob: Event | None = None
        """The latest turn of a knob of the panel."""

    @property
    def attended(self) -> bool:
        """Whether a person sets an axis up, and watches the antenna."""
        return bool(self.lacking) and not self._left_alone

    def by_person(self, axis: str) -> bool:
        """Whether a person's order for this axis is in force."""
        return any(not sender.startswith(LINKS) for sender in self.axes[axis].goals)

    def holds(self, axis: str) -> bool:
        """Whether an order for this axis is in force."""
        return not self._held and bool(self.axes[axis].goals)

    @property
    def _held(self) -> bool:
        return self.stops.latched or self._panel.mode == "park"

    def ended_s(self, axis: str) -> float:
        """When the last order for this axis ended; 0: no order has ended yet."""
        return self.axes[axis].ended_s or 0.0

    def forget_all(self, now_s: float) -> None:
        """The program ends, and all orders with it. A stop that the program had time to store holds in its next run."""
        self._forget(now_s)
        self.stops.restart(now_s, pressed=self._panel.pressed)
        self._heard_again(now_s)
        self.ended_at_s = now_s
        self._shifted = False
        self._held_off.forget()
        self._modes_known_s = now_s + STILL_AT_MOST_S
        self._tracked.begin_anew()

    def links_lost(self, now_s: float) -> None:
        """No stop could arrive from a link or console: motion that these ordered ends. A storm park and motion that the
        panel ordered go on."""
        elsewhere = any(who in orders.goals for who in (PANEL, PAGE, BUTTON) for orders in self.axes.values())
        if not self.stops.storm_under_way and self._panel.mode == "auto" and not elsewhere:
            self._forget(now_s)

    def page_lost(self, now_s: float) -> None:
        """No stop could arrive from the page: motion that was ordered there ends."""
        if not self.stops.latched:
            self.button.let_go(now_s)
            self._tracked.page_lost(now_s)
            for axis in AXES:
                self._drop(axis, now_s, (PAGE, BUTTON, f"{PAGE} {AT_END}", f"{BUTTON} {AT_END}"))

    def _drop(self, axis: str, now_s: float, senders: tuple[str, ...]) -> None:
        """The orders of these senders end."""
        goals = self.axes[axis].goals
        ended = [goals.pop(sender, None) for sender in senders]
        if any(ended):
            self.axes[axis].ended_s = now_s
            self.sure = False
            self._may_idle(now_s)

    def expire(self, now_s: float) -> None:
        for axis, orders in self.axes.items():
            orders.expire(now_s)
            if self._turns(axis):
                self._turned_s[axis] = now_s
        if self._panel.pressed and not self.stops.latched:
            self._forget(now_s)
            self.stops.latch(now_s)
        before = self._panel.mode
        if (turned := self._panel.look(now_s)) is not None:
            if turned.mode != before:
                self._forget(now_s, turned.since_s)
                self._silenced.forget()
                self._held_off.forget()
                self._shifted = False
                self._knob_seen_since(turned.since_s)
            if turned.releases:
                self._release(now_s)
        if not self._held:
            self._tracked.keep(now_s)

    def _may_idle(self, now_s: float) -> None:
        """After the first order a box with an idle park may park at any time: not in a calibration, nor in a mode of a
        person at the panel."""
        if self._parks_idle and not self.attended and (self._panel.mode == "auto" or not self._panel.settled):
            for axis, orders in self.axes.items():
                orders.goals.setdefault("idle", Goal((self._park_deg[axis],), said_s=now_s))

    def _jog(self, event: Event, axis: str, goal: Goal) -> None:
        """At an end of the range a person's jog is refused with the reason, and the present motion may go on."""
        person = event.who in (*PEOPLE, PAGE, BUTTON)
        who = f"{event.who} {AT_END}" if person and self._at_end(axis, goal.way) else event.who
        self.axes[axis].goals[who] = goal
        others = [orders.goals for name, orders in self.axes.items() if name != axis]
        for goals in others:
            # A jog silences the stream of another sender. The stream's latest target stays in force for the other axis.
            streams = [other for other in goals if other != event.who and not other.endswith(BEFORE)]
            goals.update({f"{other} {BEFORE}": replace(goals[other]) for other in streams})
        if self.goes_round and any(other.angles_deg for goals in others for other in goals.values()):
            # The other axis goes on to its target, and this axis may have to make room for it.
            self.axes[axis].goals[f"{event.who} {ROUND}"] = Goal(said_s=event.at_s)

    def _release(self, now_s: float) -> None:
        self.stops.release(now_s, pressed=self._panel.pressed)
        self._heard_again(now_s)

    def _heard_again(self, now_s: float) -> None:
        """The silence of all senders ends: no stop holds them back any more."""
        self._silenced.forget()
        self._knob_seen_since(now_s)

    def _knob_seen_since(self, since_s: float) -> None:
        """Orders count since that moment: a turn of a knob just before it may be seen only then."""
        if self._knob is not None and since_s - self._knob.at_s < UNSEEN_S:
            self._turn_knob(self._knob)

    def _turn_knob(self, event: Event) -> None:
        self._knob = event
        turned = self.axes if self.goes_round else (event.text(0),)
        for axis in turned:
            self._anywhere(event, axis)

    def _left(self, event: Event) -> None:
        for axis, orders in self.axes.items():
            goal = orders.goals.get(event.who)
            if goal is not None and goal.way and event.who not in PEOPLE:
                # A press of an axis that was never set up or homed has an end of its own.
                lasts_s = UNCALIBRATED_S + PUT_OFF_S if self._counts or axis == self.lacking else 0.0
                goal.until_s = min(goal.until_s, max(event.at_s, goal.said_s + lasts_s))
                orders.expire(event.at_s)

    def _forget(self, now_s: float, said_before_s: float = math.inf) -> None:
        self.sure = False
        self.stops.end_motion()
        self._tracked.stopped(now_s, said_before_s)
        for axis in self.axes:
            self._end(axis, now_s, said_before_s)

    def _end(self, axis: str, now_s: float, said_before_s: float = math.inf) -> None:
        """The orders for this axis end; later an idle antenna may park."""
        self.axes[axis].forget(now_s, said_before_s)
        self._may_idle(now_s)

    def _anywhere(self, event: Event, axis: str) -> None:
        self.axes[axis].goals[event.who] = Goal(said_s=event.at_s)

    def _send(self, event: Event, axis: str, angles_deg: tuple[float, ...]) -> None:
        """The order leads to one of these angles; none: to any angle, for it is not judged where."""
        if axis != self.lacking:
            known = not self._shifted and event.who not in self._tracked.recognised
            goals = self.axes[axis].goals
            if self._counts and (before := goals.get(event.who)) and before.way:
                # The order is refused while one of the axes is not homed: its sender's jog goes on.
                goals[f"{event.who} {BEFORE}"] = before
            goals[event.who] = Goal(angles_deg if known else (), said_s=event.at_s)

    def _aim(self, event: Event, azimuth_deg: float | None, elevation_deg: float | None) -> None:
        """An order for a place; None: not for this axis. Where it leads is judged where that is plain: within the range
        and on one side of the mast, and no order has moved the target lately."""
        azimuth, elevation = self._spans["azimuth"], self._spans["elevation"]
        flat = not azimuth.flips and (elevation_deg or 0.0) <= ZENITH_DEG and (azimuth_deg or 0.0) <= TURN_DEG
        both = self.goes_round or azimuth.flips or elevation.high_deg > ZENITH_DEG
        if azimuth_deg is not None:
            stands = self._targets["azimuth"].stands(azimuth_deg, event.at_s, WAITED_FOR_S)
            self._send(event, "azimuth", azimuth.turns_deg(azimuth_deg) if flat and stands else ())
        elif both:
            self._anywhere(event, "azimuth")
        if elevation_deg is not None:
            stands = self._targets["elevation"].stands(elevation_deg, event.at_s, STREAM_S)
            self._send(event, "elevation", (elevation.within(elevation_deg),) if flat and stands else ())
        elif both:
            self._anywhere(event, "elevation")
