"""The way of an axis to its lower end, where a switch, an index or a stall shows it: twice, to be sure.

A branch in the way, a spark on the switch's wire, or a motor that is taken for stalled, show an end too: it goes back a
little and comes again, and it is home where both places agree. Knows places. Does not know what shows the end, and
cannot tell an end from a branch that holds the antenna each time at the same place: the person who watches can.
"""

from __future__ import annotations

from typing import Protocol

BACK_DEG = 5.0
"""So far back from the first place."""
ALIKE_DEG = 0.5
"""The second place agrees with the first within this angle."""
FURTHEST = 1.15
"""Of the whole range: after it without an end, there is none."""


class HomingAxis(Protocol):
    """What it has its axis do. `left_s`: the motor may go on for so long without another step."""

    def begin_down(self) -> None:
        """The next end that it meets counts, and what was met before does not."""

    def run_down(self, left_s: float) -> None: ...

    def run_back(self, goal_deg: float, left_s: float) -> None: ...

    def found_home(self) -> None: ...

    def not_home(self, why: str) -> None: ...


class EndHoming:
    """Call `step` until the axis says that it is home, or not.

    `span_deg`: of the whole range. `near_deg`: so near it comes to a place.
    """

    def __init__(self, axis: HomingAxis, span_deg: float, near_deg: float) -> None:
        self._axis = axis
        self._furthest_deg = FURTHEST * span_deg + BACK_DEG
        self._near_deg = near_deg
        self._from_deg: float | None = None
        """Where this way down began; None: it begins."""
        self._first_deg: float | None = None
        """The first place of the end."""
        self._goal_deg: float | None = None
        """Where it goes back to; None: it goes down."""

    def step(self, place_deg: float, end_deg: float | None, left_s: float, *, stands: bool, at_end: bool) -> None:
        """`end_deg`: where on this way down it met the end, once it stands there; None: not yet. `at_end`: what shows
        the end shows it now. `left_s`: until when the command holds. Raises HardwareError.
        """
        if self._goal_deg is not None:
            if not stands or abs(place_deg - self._goal_deg) > self._near_deg:
                self._axis.run_back(self._goal_deg, left_s)
                return
            if at_end:
                self._axis.not_home(f"its end still shows {BACK_DEG:g}° above it: look at its switch and its wires")
                return
            self._goal_deg = self._from_deg = None
        if self._from_deg is None and at_end:
            # Where it is within its end is not known: it comes from above.
            self._back(place_deg, left_s)
            return
        if self._from_deg is None:
            self._from_deg = place_deg
            self._axis.begin_down()
        elif end_deg is not None:
            self._met(end_deg, left_s)
            return
        if self._from_deg - place_deg > self._furthest_deg:
            self._axis.not_home(f"no end came in {self._furthest_deg:.0f}°: look at its switch, or at its stall")
        else:
            self._axis.run_down(left_s)

    def _met(self, end_deg: float, left_s: float) -> None:
        if self._first_deg is None:
            self._first_deg = end_deg
            self._back(end_deg, left_s)
        elif (apart_deg := abs(end_deg - self._first_deg)) > ALIKE_DEG:
            self._axis.not_home(f"it was stopped at two places, {apart_deg:.1f}° apart: look what is in its way")
        else:
            self._axis.found_home()

    def _back(self, end_deg: float, left_s: float) -> None:
        self._goal_deg = end_deg + BACK_DEG
        self._axis.run_back(self._goal_deg, left_s)
