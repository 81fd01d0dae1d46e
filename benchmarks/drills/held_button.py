"""The button of the page that a person holds, and the presses of an axis that was never set up.

Knows the sender of the button's orders, and when they end. Knows no other order.
"""

from __future__ import annotations

from benchmarks.drills.goals import AxisOrders
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
