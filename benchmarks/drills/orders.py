"""Which orders of a drill are in force, as a person beside the mast would say it, axis by axis.

Knows the script's orders and what ends them. Does not know what the box made of them: an order that it may have passed
over counts as in force, and so does the older one that it may have kept. So a judge accuses only what no order excuses.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from benchmarks.drills.front_panel import STILL_AT_MOST_S, FrontPanel
from benchmarks.drills.goals import TURN_DEG, ZENITH_DEG, AxisOrders, Goal, Ranges
from benchmarks.drills.held_off import HeldOff
from benchmarks.drills.script import PAGE, PANEL, PEOPLE, Event
from benchmarks.drills.shifts import Shifts
from benchmarks.drills.silenced import Silenced
from benchmarks.drills.tracked import Tracked
from benchmarks.drills.wavering import Wavering

AXES = ("azimuth", "elevation")
WAYS = {"cw": ("azimuth", 1), "ccw": ("azimuth", -1), "up": ("elevation", 1), "down": ("elevation", -1)}
UNCALIBRATED_S = 2.0
"""A press of an axis that was never set up."""
PUT_OFF_S = 6.0
"""A jog with a time may begin so late: when the axis has been seen to stand."""
PANEL_S = 0.2
"""A jog switch is read twice before it counts, and once when it is let go."""
UNSEEN_S = 0.2
"""A stop and its release so soon after a turn of a knob may come before the panel has seen that turn."""
TAKEN_S = 0.2
"""A program that is killed so soon after a stop may not have taken it."""
LEASE_S = 0.5
"""So long a button on the page counts as held after its last sign."""
AT_END, ROUND, BEFORE = "at the end", "round a sector", "before a jog"
BUTTON = f"{PAGE}, a button"
"""Who jogs for as long as a button of the page is held."""
STREAM_S = 12.0
"""Two aims of one sender no further apart belong to a stream, whose target moves on between them."""


REFUSES_S = 0.3
"""The box sees so late that an axis has come to rest."""


class Orders:
    """Give it every event (`note`), and the time (`expire`). `lacking`: the axis that was never set up.

    `over_top`: whether the antenna stands over the top: one coordinate alone then moves both axes. `confirms`: a person
    may tell the box where an axis stands. `counts`: the axes count, and may not be homed. `turns`: whether an axis
    turns, or its motor is fed: the box may refuse to be told then where it stands. `at_end`: whether an axis stands
    about at that end of its range: a person's jog is refused there.
    """

    def __init__(
        self,
        ranges: tuple[Ranges, Ranges],
        park_deg: tuple[float, float],
        *,
        lacking: str = "",
        parks_idle: bool = False,
        over_top: Callable[[], bool] = lambda: False,
        confirms: bool = True,
        turns: Callable[[str], bool] = lambda _axis: False,
        counts: bool = False,
        follows: bool = False,
        at_end: Callable[[str, int], bool] = lambda _axis, _way: False,
    ) -> None:
        self.axes = {name: AxisOrders() for name in AXES}
        self._ranges = dict(zip(AXES, ranges, strict=True))
        self._park_deg = dict(zip(AXES, park_deg, strict=True))
        self.lacking = lacking
        self._parks_idle = parks_idle
        self._over_top = over_top
        self._confirms = confirms
        self._turns = turns
        self._turned_s = dict.fromkeys(AXES, -math.inf)
        self._counts = counts
        self._at_end = at_end
        self.latched = False
        """A person has stopped it, and has not let it go."""
        self.acknowledged_s = 0.0
        """When anybody last stopped both axes, or a person let it go: faults are acknowledged."""
        self.released_s = 0.0
        """When a person last let it go. A restart of the program is no person."""
        self.ended_at_s = 0.0
        """When the program last ended."""
        self.pressed_s = 0.0
        """When the axis that was never set up was last pressed; a person watches it."""
        self._panel = FrontPanel()
        self.goes_round = False
        """Forbidden sectors lie in the way: an order for one axis may turn both."""
        self._silenced = Silenced()
        self._held_off = HeldOff()
        self._modes = False
        """A person on the page has set a mode, which may hold a storm park back."""
        self._modes_known_s = STILL_AT_MOST_S
        """Until then a panel's mode switch, read for the first time, may end what a person has taken."""
        self.sure = False
        """A direction was ordered that nothing known held back, and nothing has ended it since."""
        self._listed = False
        """There may be a list to run."""
        self._button: str | None = None
        """The axis whose button is held on the page."""
        self._tracked = Tracked(self.axes, self._ranges, follows=follows, lacking=lacking)
        self._wavering: dict[str, Wavering] = {}
        """By the sender, and of all of them: a sender whose orders have no effect hides no target that moves."""
        self.heard = 0
        """How many orders there have been."""
        self._storm = self._storms = False
        """A person has asked for a storm park; it holds for certain."""
        self._parked = False
        """What is latched is a storm park from before a restart: it is not driven on, but may be ordered anew."""
        self._stopped_s = math.inf
        """When a person last stopped it, or parked it before a storm."""
        self._shifts = Shifts()
        self._knob: Event | None = None
        """The knob of the panel that was turned last."""

    @property
    def attended(self) -> bool:
        """A person sets the box up, and watches the antenna."""
        return bool(self.lacking)

    def holds(self, axis: str) -> bool:
        """Whether an order for this axis is in force."""
        return not self._held and bool(self.axes[axis].goals)

    @property
    def _held(self) -> bool:
        return self.latched or self._panel.mode == "park"

    def ended_s(self, axis: str) -> float:
        """When the last order for this axis ended; the beginning where there has been none."""
        return self.axes[axis].ended_s or 0.0

    def forget_all(self, now_s: float) -> None:
        """The program ends, and all orders with it. A stop that it had time to take goes on in the new one."""
        stopped = (self.latched or self._storms) and now_s - self._stopped_s > TAKEN_S
        parked = stopped and not self.latched
        self._forget(now_s)
        self._free(now_s)
        self.ended_at_s = now_s
        self._parked = parked and not self.latched
        self.latched = self.latched or stopped
        self._shifts = Shifts()
        self._held_off.forget()
        self._modes = False
        self._modes_known_s = now_s + STILL_AT_MOST_S
        self._tracked.begin_anew()

    def links_lost(self, now_s: float) -> None:
        """No stop could arrive: what links and consoles ordered ends. A storm park goes on, and so does the panel."""
        elsewhere = any(who in orders.goals for who in (PANEL, PAGE, BUTTON) for orders in self.axes.values())
        if not self._storm and self._panel.mode == "auto" and not elsewhere:
            self._forget(now_s)

    def expire(self, now_s: float) -> None:
        for axis, orders in self.axes.items():
            orders.expire(now_s)
            if self._turns(axis):
                self._turned_s[axis] = now_s
        if self._panel.pressed and not self.latched:
            self._forget(now_s)
            self.latched, self._stopped_s = True, now_s
        before = self._panel.mode
        if (turned := self._panel.look(now_s)) is not None:
            if turned.mode != before:
                self._forget(now_s, turned.since_s)
                self._silenced.forget()
                self._held_off.forget()
                self._shifts.cleared()
            if turned.releases:
                self._release(now_s)
        if not self._held:
            self._tracked.keep(now_s)

    def note(self, event: Event) -> None:
        self.heard += 1
        if event.who == PANEL:
            self._note_panel(event)
        elif event.who == PAGE:
            self._note_page(event)
        elif event.who in PEOPLE:
            self._note_person(event)
        elif self._held_off.holds_off(event):
            pass
        elif self._held_off.may_hold_off(event):
            for axis in AXES:
                self._anywhere(event, axis)
        else:
            self._note_order(event)
        self._note_flights(event)
        free = not self._held and not self._storm and self._panel.mode == "auto" and self._panel.settled
        if event.what == "aim" and event.who != PAGE:
            self.sure = self.sure or (free and not self._held_off.perhaps)
        self._held_off.note(event, free=free and event.at_s >= self._modes_known_s)
        self._may_idle(event.at_s)

    def _note_flights(self, event: Event) -> None:
        refused = (self._held or self._storm) and self._panel.settled  # a switch that turns now may release it
        if event.what == "track" and event.text(0) != "off" and refused:
            return
        free = self._panel.mode == "auto" and self._panel.settled and not self._held and not self._storm
        free = free and not self._held_off.perhaps
        self._tracked.note(event, takes=free and not self.lacking and not self._counts)

    def _may_idle(self, now_s: float) -> None:
        """Once there has been an order, a box that parks when it is idle may do so."""
        if self._parks_idle:
            for axis, orders in self.axes.items():
                orders.goals.setdefault("idle", Goal((self._park_deg[axis],), said_s=now_s))

    def _note_person(self, event: Event) -> None:
        match event.what:
            case "stop" | "let-go":
                self._forget(event.at_s)
                self.latched, self._stopped_s, self._parked = True, event.at_s, False
                self.acknowledged_s = event.at_s
            case "resume":
                self._release(event.at_s)
            case "storm":
                if self._parked and self._panel.mode != "park":
                    self.latched = self._parked = False
                if not self._held:
                    # An antenna that must be homed first cannot park: what goes on then goes on.
                    if not self._counts:
                        self._forget(event.at_s)
                    self._storm, self._stopped_s = True, event.at_s
                    free = self._panel.mode == "auto" and self._panel.settled and not self._modes
                    self._storms = not self._counts and free
                    for axis in AXES:
                        self._aim(event, axis, (self._park_deg[axis],))
            case "home":
                self._anywhere(event, event.text(0))
                self.axes[event.text(0)].homes = True
            case "confirm":
                # It has no effect in a storm park, while an axis homes or turns, and where the sensor measures.
                turned = event.at_s - self._turned_s[event.text(0)] <= REFUSES_S
                homes = any(orders.homes for orders in self.axes.values())
                if self._confirms and not self._storm and not homes and not turned:
                    self._end(event.text(0), event.at_s)
            case _ if self._storms:
                pass  # a storm park holds every other order back
            case _:
                self._note_order(event)

    def _note_page(self, event: Event) -> None:
        if event.what in ("take", "mode", "hold"):
            self._silenced.other(event)  # a mode of its own lets a person move it at once
        match event.what:
            case "take" if self._storm or self._panel.mode != "auto" or not self._panel.settled:
                pass  # a person at the panel whose switch is held jogs on
            case "take" | "mode":
                self._forget(event.at_s)
                self.latched = self.latched or self._storms
                self._modes = self._modes or event.what == "mode"
            case "hold" if event.text(0) == "off":
                self._let_button_go(event.at_s)
            case "hold":
                axis, way = WAYS[event.text(0)]
                if self._button is not None and self._button != axis:
                    self._let_button_go(event.at_s)
                self._button = axis
                if axis == self.lacking:
                    self.pressed_s = event.at_s
                if (before := self.axes[axis].goals.get(PAGE)) and not before.way:
                    del self.axes[axis].goals[PAGE]
                held = replace(event, who=BUTTON)
                self._jog(held, axis, Goal(way=way, said_s=event.at_s, until_s=event.at_s + LEASE_S + PANEL_S))
            case "give-back" | "relays-checked":
                pass
            case _:
                self._note_person(event)

    def _let_button_go(self, now_s: float) -> None:
        if self._button is not None:
            for who in (BUTTON, f"{BUTTON} {AT_END}"):
                if goal := self.axes[self._button].goals.get(who):
                    goal.until_s = min(goal.until_s, now_s + PANEL_S)
        self._button = None

    def _jog(self, event: Event, axis: str, goal: Goal) -> None:
        """At an end of the range a person's jog is refused with the reason: what goes on may go on beside it."""
        person = event.who in (*PEOPLE, PAGE, BUTTON)
        who = f"{event.who} {AT_END}" if person and self._at_end(axis, goal.way) else event.who
        self.axes[axis].goals[who] = goal
        others = [orders.goals for name, orders in self.axes.items() if name != axis]
        for goals in others:
            # It silences the stream of another sender, whose latest target stays in force for the other axis.
            streams = [other for other in goals if other != event.who and not other.endswith(BEFORE)]
            goals.update({f"{other} {BEFORE}": replace(goals[other]) for other in streams})
        if self.goes_round and any(other.angles_deg for goals in others for other in goals.values()):
            # The other axis goes on to its target, and this one may have to make room for it.
            self.axes[axis].goals[f"{event.who} {ROUND}"] = Goal(said_s=event.at_s)

    def _note_panel(self, event: Event) -> None:
        match event.what:
            case "mode":
                self._panel.turn(event.text(0), event.at_s)
            case "stop" if event.text(0) == "press":
                self._panel.press()
            case "stop":
                self._panel.pull(event.at_s)
            case "knob":
                self._knob = event
                turned = self.axes if self.goes_round else (event.text(0),)
                for axis in turned:
                    self._anywhere(event, axis)
            case "jog" if self._panel.mode == "jog" and self._panel.settled:
                axis, way = WAYS[event.text(0)]
                until_s = event.at_s + event.number(1) + PANEL_S
                self.axes[axis].goals[PANEL] = Goal(way=way, said_s=event.at_s, until_s=until_s)
            case "jog":  # it may shift the target in force, and those that come later
                axis, way = WAYS[event.text(0)]
                self._anywhere(event, axis)
                self._shifts.press(axis, way)
                if axis == "elevation" and self._may_shift_over_top():
                    self._anywhere(event, "azimuth")

    def _note_order(self, event: Event) -> None:
        match event.what:
            case "aim":
                # Orders that were refused, before it was homed, make no sender that a stop silences.
                # A turn of the mode switch lets senders go again, perhaps already now.
                silenced = self._silenced.aim(event) and not self._panel.may_turn(event.at_s)
                if silenced and not self._counts:
                    return
            case "stop":
                self._silenced.stop(event)
            case "ask" | "junk" | "speed" | "recognised":
                pass
            case _:
                self._silenced.other(event)
        match event.what:
            case "aim":
                self._aim_azimuth(event, event.number(1))
                self._aim_elevation(event, event.number(1))
            case "aim-azimuth":
                if self._shows_over_top or self.goes_round:
                    self._anywhere(event, "elevation")
                self._aim_azimuth(event, 0.0)
            case "aim-elevation":
                if self.goes_round or (self._shows_over_top and event.number(0) <= ZENITH_DEG):
                    self._anywhere(event, "azimuth")
                self._aim_elevation(event, event.number(0))
            case "jog":
                axis, way = WAYS[event.text(0)]
                seconds = event.number(1) if len(event.args) > 1 else math.inf
                if axis == self.lacking:
                    self.pressed_s = event.at_s
                    seconds = min(seconds, UNCALIBRATED_S)
                until_s = event.at_s + seconds + PUT_OFF_S
                self._jog(event, axis, Goal(way=way, said_s=event.at_s, until_s=until_s, turns_s=seconds))
            case "stop":
                self._forget(event.at_s)
                self.latched = self.latched or self._storms  # it ends the way to the park position, and no more
                self.acknowledged_s = event.at_s
            case "stop-axis":
                self._end(event.text(0), event.at_s)
            case "park":
                for axis in AXES:
                    self._aim(event, axis, (self._park_deg[axis],))
            case "list":  # until it runs, its first point is the target
                self._listed = True
                first = replace(event, args=event.args[1:3])
                self._aim_azimuth(first, first.number(1))
                self._aim_elevation(first, first.number(1))
            case "run-list" if self._listed:
                for axis in AXES:
                    self._anywhere(event, axis)
            case "leave":
                self._left(event)

    def _release(self, now_s: float) -> None:
        self._free(now_s)
        self.acknowledged_s = self.released_s = now_s

    def _free(self, now_s: float) -> None:
        """No stop is in force any more."""
        self.latched, self._storm = self._panel.pressed, False
        self._storms = self._parked = False
        self._silenced.forget()
        if self._knob is not None and now_s - self._knob.at_s < UNSEEN_S:
            self._note_panel(self._knob)  # the panel sees the turn only now

    def _left(self, event: Event) -> None:
        for axis, orders in self.axes.items():
            goal = orders.goals.get(event.who)
            if goal is not None and goal.way and event.who not in PEOPLE:
                # A press of an axis that was not set up, or not homed, ends by itself.
                lasts_s = UNCALIBRATED_S + PUT_OFF_S if self._counts or axis == self.lacking else 0.0
                goal.until_s = min(goal.until_s, max(event.at_s, goal.said_s + lasts_s))
                orders.expire(event.at_s)

    def _forget(self, now_s: float, said_before_s: float = math.inf) -> None:
        self.sure = False
        self._storm = False
        for wavering in self._wavering.values():
            wavering.forget()
        self._tracked.stopped(now_s, said_before_s)
        for axis in self.axes:
            self._end(axis, now_s, said_before_s)

    def _end(self, axis: str, now_s: float, said_before_s: float = math.inf) -> None:
        """The orders for this axis end; later an idle antenna may park."""
        self.axes[axis].forget(now_s, said_before_s)
        self._may_idle(now_s)

    def _anywhere(self, event: Event, axis: str) -> None:
        self.axes[axis].goals[event.who] = Goal(said_s=event.at_s)

    def _aim(self, event: Event, axis: str, angles_deg: tuple[float, ...], ends_deg: tuple[float, ...] = ()) -> None:
        if axis == self.lacking:
            return
        if event.who in self._tracked.recognised:
            self._anywhere(event, axis)
            return
        goals, rate_dps = self.axes[axis].goals, 0.0
        before = goals.get(event.who)
        if before and before.angles_deg and angles_deg and 0 < event.at_s - before.said_s < STREAM_S:
            nearest_deg = min(abs(angle - other) for angle in angles_deg for other in before.angles_deg)
            rate_dps = nearest_deg / (event.at_s - before.said_s)
        goals[event.who] = Goal(angles_deg, ends_deg, said_s=event.at_s, rate_dps=rate_dps)

    @property
    def _shows_over_top(self) -> bool:
        """Whether the antenna stands over the top, or may go there."""
        goals = self.axes["elevation"].goals.values()
        over = any(angle_deg > ZENITH_DEG for goal in goals for angle_deg in goal.angles_deg)
        return over or self._ranges["azimuth"].flips or self._over_top()

    def _may_shift_over_top(self) -> bool:
        goals = self.axes["elevation"].goals.values()
        angles_deg = [angle_deg for goal in goals for angle_deg in goal.angles_deg]
        return any(max(self._shifts.shifted("elevation", angle_deg)) > ZENITH_DEG for angle_deg in angles_deg)

    def _aim_elevation(self, event: Event, elevation_deg: float) -> None:
        span = self._ranges["elevation"]
        shifted_deg = self._shifts.shifted("elevation", elevation_deg)
        angles_deg = tuple(angle for each in shifted_deg for angle in span.elevations_deg(each))
        before = self.axes["elevation"].goals.get(event.who)
        if before and event.what == "aim" and event.number(0) > TURN_DEG:
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self._aim(event, "elevation", angles_deg)

    def _aim_azimuth(self, event: Event, elevation_deg: float) -> None:
        """Beyond north an order may be refused, as by a unit of 360°: the older one then stays, for both axes."""
        turns_deg = [
            angle_deg
            for shifted_deg in self._shifts.shifted("azimuth", event.number(0))
            for angle_deg in self._ranges["azimuth"].turns_deg(shifted_deg, elevation_deg)
        ]
        span = self._ranges["azimuth"]
        watched = [self._wavering.setdefault(who, Wavering(span.low_deg, span.high_deg)) for who in ("", event.who)]
        found_deg = {end_deg for each in watched for end_deg in each.ends(event.at_s, turns_deg, elevation_deg)}
        ends_deg = tuple(found_deg)
        angles_deg = tuple(angle for angle in turns_deg if span.low_deg - 1.0 <= angle <= span.high_deg + 1.0)
        before = self.axes["azimuth"].goals.get(event.who)
        if before and (event.number(0) > TURN_DEG or not angles_deg):
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self._aim(event, "azimuth", angles_deg, ends_deg)
