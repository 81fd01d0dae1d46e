"""By how much the front panel's jog switches may have shifted the orders of programs.

Knows the rule of docs/panel.md: in AUTO each press shifts by one step more, until the mode changes; a stop ends no
shift. The box may have ignored a press, so every possible sum of steps is kept. Does not know orders.
"""

from __future__ import annotations

STEP_DEG = 5.0
LEAST, MOST = -7, 8


class Shifts:
    def __init__(self) -> None:
        self._steps: dict[str, set[int]] = {}

    def press(self, axis: str, way: int) -> None:
        before = self._steps.get(axis, {0})
        self._steps[axis] = before | {min(max(steps + way, LEAST), MOST) for steps in before}

    def cleared(self) -> None:
        """The mode has changed."""
        self._steps.clear()

    def shifted(self, axis: str, angle_deg: float) -> list[float]:
        """The angles to which an order for this angle may lead."""
        return [angle_deg + steps * STEP_DEG for steps in sorted(self._steps.get(axis, {0}))]
