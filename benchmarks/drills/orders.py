"""Which orders of a drill are in force, as a person beside the mast would say it, axis by axis.

Knows the script's orders. Does not know which of them the box obeyed: an order that the box may have ignored counts as
in force, and so does the older order before it. So a judge accuses only a motion that no order excuses. What ends an
order is in `in_force`.
"""

from __future__ import annotations

import math
from dataclasses import replace

from benchmarks.drills.goals import BUTTON, PANEL_S, Goal
from benchmarks.drills.in_force import AXES, PUT_OFF_S, UNCALIBRATED_S, InForce
from benchmarks.drills.script import PAGE, PANEL, PEOPLE, Event

WAYS = {"cw": ("azimuth", 1), "ccw": ("azimuth", -1), "up": ("elevation", 1), "down": ("elevation", -1)}
LEASE_S = 0.5
"""A button on the page counts as held for this time after its last sign."""
REFUSES_S = 0.3
"""The box may see this late that an axis has come to rest."""


class Orders(InForce):
    """Give it every event (`note`), and the time (`expire`)."""

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
        free = not self._held and not self.stops.stormed and self._panel.mode == "auto" and self._panel.settled
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
        free = self._panel.mode == "auto" and self._panel.settled and not self._held and not self.stops.stormed
        free = free and not self._held_off.perhaps
        self._tracked.note(event, takes=free and not self.lacking and not self._counts)

    def _note_person(self, event: Event) -> None:
        match event.what:
            case "stop" | "let-go":
                self._forget(event.at_s)
                self.stops.by_person(event.at_s)
            case "resume":
                self._release(event.at_s)
            case "storm":
                if not self._held or self._panel.may_turn(event.at_s):  # the switch may have released it already
                    # An antenna that must be homed first cannot park: its present motion goes on.
                    if not self._counts:
                        self._forget(event.at_s)
                    self.stops.begin_storm()
                    for axis in AXES:
                        self._send(event, axis, (self._park_deg[axis],))
            case "home":
                self._anywhere(event, event.text(0))
                self.axes[event.text(0)].homes = True
            case "confirm":
                # It has no effect in a storm park, while an axis homes or turns, and where the sensor measures.
                turned = event.at_s - self._turned_s[event.text(0)] <= REFUSES_S
                homes = any(orders.homes for orders in self.axes.values())
                if self._confirms and not self.stops.storm_under_way and not homes and not turned:
                    self._end(event.text(0), event.at_s)
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

    def _note_panel(self, event: Event) -> None:
        match event.what:
            case "mode":
                self._panel.turn(event.text(0), event.at_s)
            case "stop" if event.text(0) == "press":
                self._panel.press()
            case "stop":
                self._panel.pull(event.at_s)
            case "knob":
                self._turn_knob(event)
            case "jog" if self._panel.mode == "jog" and self._panel.settled:
                axis, way = WAYS[event.text(0)]
                until_s = event.at_s + event.number(1) + PANEL_S
                self.axes[axis].goals[PANEL] = Goal(way=way, said_s=event.at_s, until_s=until_s)
            case "jog":  # the press may shift the target in force, and later targets
                self._shifted = True
                for axis in AXES:
                    self._anywhere(event, axis)

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
            case "ask" | "junk" | "speed" | "recognised" | "waits":
                pass
            case _:
                self._silenced.other(event)
        match event.what:
            case "aim":
                self._aim(event, event.number(0), event.number(1))
            case "aim-azimuth":
                self._aim(event, event.number(0), None)
            case "aim-elevation":
                self._aim(event, None, event.number(0))
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
                    self._send(event, axis, (self._park_deg[axis],))
            case "list":  # until the list runs, its first point is the target
                self._listed = True
                self._aim(event, event.number(1), event.number(2))
            case "run-list" if self._listed:
                for axis in AXES:
                    self._anywhere(event, axis)
            case "leave":
                self._left(event)
