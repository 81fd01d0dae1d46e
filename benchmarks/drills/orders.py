"""Which orders of a drill are in force, as a person beside the mast would say it, axis by axis.

Knows the script's orders and what ends them. Does not know which of them the box obeyed: an order that the box may have
ignored counts as in force, and so does the older order before it. So a judge accuses only a motion that no order
excuses.
The stops are in `stops`, the page's button in `held_button`, the angles of an order in `aim_angles`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from benchmarks.drills.aim_angles import AimAngles
from benchmarks.drills.front_panel import STILL_AT_MOST_S, FrontPanel
from benchmarks.drills.goals import ZENITH_DEG, AxisOrders, Goal, Ranges
from benchmarks.drills.held_button import AT_END, BUTTON, PANEL_S, HeldButton
from benchmarks.drills.held_off import HeldOff
from benchmarks.drills.script import PAGE, PANEL, PEOPLE, Event
from benchmarks.drills.silenced import Silenced
from benchmarks.drills.stops import Stops
from benchmarks.drills.tracked import Tracked

AXES = ("azimuth", "elevation")
WAYS = {"cw": ("azimuth", 1), "ccw": ("azimuth", -1), "up": ("elevation", 1), "down": ("elevation", -1)}
UNCALIBRATED_S = 2.0
"""A press turns an axis that was never set up for this time at most."""
PUT_OFF_S = 6.0
"""A jog with a time may begin this late: when the box has seen the axis stand."""
UNSEEN_S = 0.2
"""A stop and its release, or a new mode, this soon after a turn of a knob may come before the panel has seen it."""
LEASE_S = 0.5
"""A button on the page counts as held for this time after its last sign."""
ROUND, BEFORE = "round a sector", "before a jog"
REFUSES_S = 0.3
"""The box may see this late that an axis has come to rest."""


class Orders:
    """Give it every event (`note`), and the time (`expire`). `lacking`: the axis that was never set up.

    `over_top`: whether the antenna stands over the top; one coordinate alone then moves both axes. `confirms`: a person
    may confirm the angle of an axis. `counts`: the axes count, and may not be homed yet. `turns`: whether an axis turns
    or its motor is fed; the box may then refuse a confirmed angle. `at_end`: whether an axis stands near that end of
    its range; a person's jog is refused there.
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
        spans = dict(zip(AXES, ranges, strict=True))
        self._park_deg = dict(zip(AXES, park_deg, strict=True))
        self.lacking = lacking
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
        self._modes = False
        """A person on the page has set a mode, which may hold a storm park back."""
        self._modes_known_s = STILL_AT_MOST_S
        """Until this moment the first reading of a panel's mode switch may end a person's hold of the antenna."""
        self.sure = False
        """A direction is in force for certain: nothing held back its order, and nothing has ended it."""
        self._listed = False
        """The box may have a list to run."""
        self._tracked = Tracked(self.axes, spans, follows=follows, lacking=lacking)
        self._aims = AimAngles(self.axes, spans, self._tracked.recognised, lacking=lacking, over_top=over_top)
        self.heard = 0
        """How many orders there have been."""
        self._knob: Event | None = None
        """The latest turn of a knob of the panel."""

    @property
    def attended(self) -> bool:
        """Whether a person sets an axis up, and watches the antenna."""
        return bool(self.lacking)

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
        self._aims.shifts.cleared()
        self._held_off.forget()
        self._modes = False
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
                self._aims.shifts.cleared()
                self._knob_seen_since(turned.since_s)
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
        free = not self._held and not self.stops.storm_under_way and self._panel.mode == "auto" and self._panel.settled
        if event.what == "aim" and event.who != PAGE:
            self.sure = self.sure or (free and not self._held_off.perhaps)
        self._held_off.note(event, free=free and event.at_s >= self._modes_known_s)
        self._may_idle(event.at_s)

    def _note_flights(self, event: Event) -> None:
        refused = (
            self._held or self.stops.storm_under_way
        ) and self._panel.settled  # a switch that turns now may release it
        if event.what == "track" and event.text(0) != "off" and refused:
            return
        free = self._panel.mode == "auto" and self._panel.settled and not self._held and not self.stops.storm_under_way
        free = free and not self._held_off.perhaps
        self._tracked.note(event, takes=free and not self.lacking and not self._counts)

    def _may_idle(self, now_s: float) -> None:
        """After the first order a box with an idle park may park at any time: not in a calibration, nor in a mode of a
        person at the panel."""
        if self._parks_idle and not self.attended and (self._panel.mode == "auto" or not self._panel.settled):
            for axis, orders in self.axes.items():
                orders.goals.setdefault("idle", Goal((self._park_deg[axis],), said_s=now_s))

    def _note_person(self, event: Event) -> None:
        match event.what:
            case "stop" | "let-go":
                self._forget(event.at_s)
                self.stops.by_person(event.at_s)
            case "resume":
                self._release(event.at_s)
            case "storm":
                if self._panel.mode != "park":
                    self.stops.order_anew()
                if not self._held:
                    # An antenna that must be homed first cannot park: its present motion goes on.
                    if not self._counts:
                        self._forget(event.at_s)
                    free = self._panel.mode == "auto" and self._panel.settled and not self._modes
                    self.stops.begin_storm(event.at_s, holds=free and not self._counts)
                    for axis in AXES:
                        self._aims.aim(event, axis, (self._park_deg[axis],))
            case "home":
                self._anywhere(event, event.text(0))
                self.axes[event.text(0)].homes = True
            case "confirm":
                # It has no effect in a storm park, while an axis homes or turns, and where the sensor measures.
                turned = event.at_s - self._turned_s[event.text(0)] <= REFUSES_S
                homes = any(orders.homes for orders in self.axes.values())
                if self._confirms and not self.stops.storm_under_way and not homes and not turned:
                    self._end(event.text(0), event.at_s)
            case _ if self.stops.storm_holds:
                pass
            case _:
                self._note_order(event)

    def _note_page(self, event: Event) -> None:
        if event.what in ("take", "mode", "hold"):
            self._silenced.other(event)  # a person who takes the antenna or sets a mode is not silenced any more
        match event.what:
            case "take" if self.stops.storm_under_way or self._panel.mode != "auto" or not self._panel.settled:
                pass  # a person at the panel who holds a jog switch goes on jogging
            case "take" | "mode":
                self._forget(event.at_s)
                self.stops.take()
                self._modes = self._modes or event.what == "mode"
            case "hold" if event.text(0) == "off":
                self.button.let_go(event.at_s)
            case "hold":
                axis, way = WAYS[event.text(0)]
                self.button.hold(axis, event.at_s)
                held = replace(event, who=BUTTON)
                self._jog(held, axis, Goal(way=way, said_s=event.at_s, until_s=event.at_s + LEASE_S + PANEL_S))
            case "give-back" | "relays-checked":
                pass
            case _:
                self._note_person(event)

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
            case "jog":  # the press may shift the target in force, and later targets
                axis, way = WAYS[event.text(0)]
                self._anywhere(event, axis)
                self._aims.shifts.press(axis, way)
                if axis == "elevation" and self._aims.may_shift_over_top():
                    self._anywhere(event, "azimuth")

    def _note_order(self, event: Event) -> None:
        match event.what:
            case "aim":
                # Orders that a counted axis refused before its homing make no stream that a stop could silence.
                # A turn of the mode switch ends the silence of all senders, perhaps already now.
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
                self._aims.aim_azimuth(event, event.number(1))
                self._aims.aim_elevation(event, event.number(1))
            case "aim-azimuth":
                if self._aims.shows_over_top or self.goes_round:
                    self._anywhere(event, "elevation")
                self._aims.aim_azimuth(event, 0.0)
            case "aim-elevation":
                # Above 90° azimuth stays; without an order it goes to where a servo's first pulse sends it.
                stays = event.number(0) > ZENITH_DEG and bool(self.axes["azimuth"].goals)
                if self.goes_round or (self._aims.shows_over_top and not stays):
                    self._anywhere(event, "azimuth")
                self._aims.aim_elevation(event, event.number(0))
            case "jog":
                axis, way = WAYS[event.text(0)]
                seconds = event.number(1) if len(event.args) > 1 else math.inf
                self.button.press(axis, event.at_s)
                if axis == self.lacking:
                    seconds = min(seconds, UNCALIBRATED_S)
                until_s = event.at_s + seconds + PUT_OFF_S
                self._jog(event, axis, Goal(way=way, said_s=event.at_s, until_s=until_s, turns_s=seconds))
            case "stop":
                self._forget(event.at_s)
                self.stops.by_link(event.at_s)
            case "stop-axis":
                self._end(event.text(0), event.at_s)
            case "park":
                for axis in AXES:
                    self._aims.aim(event, axis, (self._park_deg[axis],))
            case "list":  # until the list runs, its first point is the target
                self._listed = True
                first = replace(event, args=event.args[1:3])
                self._aims.aim_azimuth(first, first.number(1))
                self._aims.aim_elevation(first, first.number(1))
            case "run-list" if self._listed:
                for axis in AXES:
                    self._anywhere(event, axis)
            case "leave":
                self._left(event)

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
            self._note_panel(self._knob)

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
        self._aims.forget()
        self._tracked.stopped(now_s, said_before_s)
        for axis in self.axes:
            self._end(axis, now_s, said_before_s)

    def _end(self, axis: str, now_s: float, said_before_s: float = math.inf) -> None:
        """The orders for this axis end; later an idle antenna may park."""
        self.axes[axis].forget(now_s, said_before_s)
        self._may_idle(now_s)

    def _anywhere(self, event: Event, axis: str) -> None:
        self.axes[axis].goals[event.who] = Goal(said_s=event.at_s)
