"""The orders in force for one axis of a drill: the sender, the angles of the axis that fulfil the order, and its end.

Knows when an order has turned the motor for as long as it may, and the button of the page that a person holds. Does not
know the words of an order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from benchmarks.drills.script import PAGE

PANEL_S = 0.2
"""An order by the panel or a button may end this much later: a jog switch is read twice when it is pressed, and once
when it is let go."""
AT_END = "at the end"
BUTTON = f"{PAGE}, a button"
"""The sender of a jog for as long as a button of the page is held."""


class HeldButton:
    """`axes`: the orders in force. `lacking`: the axis that was never set up."""

    def __init__(self, axes: dict[str, AxisOrders], lacking: str) -> None:
        self._axes = axes
        self._lacking = lacking
        self._axis: str | None = None
        """The axis whose button is held."""
        self.pressed_s = 0.0
        """When the axis that was never set up was last pressed; a person watches it."""

    def hold(self, axis: str, now_s: float) -> None:
        if self._axis is not None and self._axis != axis:
            self.let_go(now_s)
        self._axis = axis
        self.press(axis, now_s)
        if (before := self._axes[axis].goals.get(PAGE)) and not before.way:
            del self._axes[axis].goals[PAGE]

    def press(self, axis: str, now_s: float) -> None:
        if axis == self._lacking:
            self.pressed_s = now_s

    def let_go(self, now_s: float) -> None:
        if self._axis is not None:
            for who in (BUTTON, f"{BUTTON} {AT_END}"):
                if goal := self._axes[self._axis].goals.get(who):
                    goal.until_s = min(goal.until_s, now_s + PANEL_S)
        self._axis = None


TURN_DEG, ZENITH_DEG = 360.0, 90.0
WAITED_FOR_S = 120.0 + 96.0
"""Within this time after a target has moved the antenna may wait for it at an end of the range, or unwind there ahead
of it (docs/pointing.md)."""
STREAM_S = 12.0
"""Two targets within this time belong to a stream: the antenna may be ahead of it."""


@dataclass(frozen=True, slots=True)
class Ranges:
    """The range of an axis in true degrees, as orders name them; `flips`: over the top."""

    low_deg: float
    high_deg: float
    flips: bool

    def turns_deg(self, azimuth_deg: float) -> tuple[float, ...]:
        """Every azimuth angle that points there, on each turn."""
        turns_deg = (azimuth_deg % TURN_DEG + TURN_DEG * turn for turn in range(-2, 3))
        return tuple(angle for angle in turns_deg if self.low_deg - 1.0 <= angle <= self.high_deg + 1.0)

    def within(self, angle_deg: float) -> float:
        return min(max(angle_deg, self.low_deg), self.high_deg)


@dataclass(slots=True)
class Target:
    """Where one axis was last sent, and when an order last moved that."""

    angle_deg: float = math.nan
    moved_s: float = -math.inf

    def stands(self, angle_deg: float, now_s: float, least_s: float) -> bool:
        """Whether this target has not moved for so long, or is the first one."""
        if angle_deg != self.angle_deg:
            self.moved_s = -math.inf if math.isnan(self.angle_deg) else now_s
            self.angle_deg = angle_deg
        return now_s - self.moved_s >= least_s


@dataclass(slots=True)
class Goal:
    """One sender's order for one axis. `angles_deg` empty: any angle. `way`: the direction of a jog; 0: no jog."""

    angles_deg: tuple[float, ...] = ()
    way: int = 0
    said_s: float = 0.0
    until_s: float = math.inf
    turns_s: float = math.inf
    """The time that is left for this order to turn the motor. It counts only while the motor runs."""


@dataclass(slots=True)
class AxisOrders:
    """The orders in force for one axis, by sender."""

    goals: dict[str, Goal] = field(default_factory=dict)
    homes: bool = False
    ended_s: float | None = None
    """When the last order ended; None: there has been none."""

    def forget(self, now_s: float, said_before_s: float = math.inf) -> None:
        kept = {sender: goal for sender, goal in self.goals.items() if goal.said_s >= said_before_s}
        if len(kept) < len(self.goals):
            self.ended_s = now_s
        self.goals, self.homes = kept, self.homes and bool(kept)

    def turned(self, now_s: float, way: int, past_s: float) -> None:
        """The box has fed the motor in this direction for `past_s`."""
        for goal in self.goals.values():
            if goal.way == way:
                goal.turns_s -= past_s
                if goal.turns_s <= 0.0:
                    goal.until_s = min(goal.until_s, now_s)
        self.expire(now_s)

    def expire(self, now_s: float) -> None:
        for sender in [sender for sender, goal in self.goals.items() if goal.until_s <= now_s]:
            self.ended_s = self.goals.pop(sender).until_s
