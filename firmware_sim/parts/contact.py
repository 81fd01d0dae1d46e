"""A cam on a rotor's shaft that closes a contact every few degrees: the only signal of an Alliance U-100.

Knows where the contact closes and opens, how long it bounces, and its faults. The contact shows neither the direction
nor the place. Knows no GPIO line: it returns changes of the contact with their moments.
"""

from __future__ import annotations

import math
import random
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

BISECTIONS = 40
"""An hour halved so many times is some nanoseconds: the precision of an edge's moment."""
DOUBLED_AT_S, DOUBLED_FOR_S = 0.04, 0.03
"""When a doubled pulse opens again after it closed, and for how long: a debounce of 20 ms does not remove that."""


@dataclass(frozen=True, slots=True)
class ContactSpec:
    spacing_deg: float = 5.0
    """From one closure to the next."""
    closed_deg: float = 1.0
    """For how much of that it is closed."""
    closes_at_deg: float = 0.0
    """The angle at which one of the closures begins, for a shaft that turns clockwise or up."""
    play_deg: float = 0.0
    """Play between the shaft and the cam: after a reversal each edge comes this much later."""
    bounce_s: float = 0.005
    """How long the contact bounces after each change."""


class ContactFault(Enum):
    """How a contact fails."""

    NONE = "none"
    STUCK_OPEN = "stuck open"
    STUCK_CLOSED = "stuck closed"
    MISSES = "misses every fifth closure"
    DOUBLES = "closes twice every fifth time"


FAULTY_EACH = 5
"""Every fifth closure is missed, or doubled."""


class SimContact:
    """Give `turned` to a motor's `on_turn`; call `take` for the changes."""

    def __init__(self, spec: ContactSpec, shaft_deg: float, seed: int = 0) -> None:
        self.spec = spec
        self.fault = ContactFault.NONE
        self._random = random.Random(seed)
        self._cam_deg = shaft_deg
        self.zone = 2 * math.floor((shaft_deg - spec.closes_at_deg) / spec.spacing_deg)
        """The zone of the cam: even zones are closed, odd ones are the gaps above them."""
        if shaft_deg >= self._low_deg(self.zone + 1):
            self.zone += 1
        self._told = self.zone % 2 == 0
        self._changes: deque[tuple[float, bool]] = deque()
        self._closures = 0

    def take(self, until_s: float) -> list[tuple[float, bool]]:
        """The changes up to that moment since the last call: moment and state (True: closed), in order of time."""
        taken: list[tuple[float, bool]] = []
        while self._changes and self._changes[0][0] <= until_s:
            at_s, closed = self._changes.popleft()
            if closed is not self._told:
                self._told = closed
                taken.append((at_s, closed))
        return taken

    @property
    def closed(self) -> bool:
        """The state after the last change that `take` returned."""
        return self._told

    def break_down(self, fault: ContactFault, now_s: float) -> None:
        """That fault begins at this moment; NONE ends it."""
        self.fault = fault
        self._change(now_s, self._shown(self.zone % 2 == 0))

    def turned(self, from_s: float, seconds: float, shaft_deg: Callable[[float], float]) -> None:
        """The shaft has turned in one direction; see `firmware_sim.parts.motor.Stretch`."""
        end_deg = self._follow(shaft_deg(seconds))
        # The lambdas are used at once, before the loop changes `edge_deg`: the warning B023 does not apply.
        while end_deg >= self._low_deg(self.zone + 1):
            self.zone += 1
            edge_deg = self._low_deg(self.zone)
            self._crossed(from_s + self._when(lambda cam_deg: cam_deg >= edge_deg, shaft_deg, seconds))  # noqa: B023
        while end_deg < self._low_deg(self.zone):
            edge_deg = self._low_deg(self.zone)
            self.zone -= 1
            self._crossed(from_s + self._when(lambda cam_deg: cam_deg < edge_deg, shaft_deg, seconds))  # noqa: B023
        self._cam_deg = end_deg

    def _follow(self, shaft_deg: float) -> float:
        """Where the cam is: after a reversal it follows the shaft once the play is taken up."""
        return min(max(self._cam_deg, shaft_deg), shaft_deg + self.spec.play_deg)

    def _low_deg(self, zone: int) -> float:
        """The lower edge of a zone."""
        turns, gap = divmod(zone, 2)
        return self.spec.closes_at_deg + turns * self.spec.spacing_deg + gap * self.spec.closed_deg

    def _when(self, beyond: Callable[[float], bool], shaft_deg: Callable[[float], float], seconds: float) -> float:
        """After how many seconds the cam is first `beyond` an edge, by bisection."""
        early_s, late_s = 0.0, seconds
        for _ in range(BISECTIONS):
            middle_s = (early_s + late_s) / 2
            if beyond(self._follow(shaft_deg(middle_s))):
                late_s = middle_s
            else:
                early_s = middle_s
        return late_s

    def _crossed(self, at_s: float) -> None:
        closed = self.zone % 2 == 0
        if closed:
            self._closures += 1
        odd = self._closures % FAULTY_EACH == 0
        if self.fault is ContactFault.MISSES and odd:
            return
        self._change(at_s, self._shown(closed))
        if self.fault is ContactFault.DOUBLES and odd and closed:
            self._changes.append((at_s + DOUBLED_AT_S, False))
            self._changes.append((at_s + DOUBLED_AT_S + DOUBLED_FOR_S, True))

    def _shown(self, closed: bool) -> bool:
        return {ContactFault.STUCK_OPEN: False, ContactFault.STUCK_CLOSED: True}.get(self.fault, closed)

    def _change(self, at_s: float, closed: bool) -> None:
        """Change to that state, with some bounces; bounces of an earlier change that are still to come are dropped."""
        while self._changes and self._changes[-1][0] >= at_s:
            self._changes.pop()
        before = self._changes[-1][1] if self._changes else self._told
        if before is closed:
            return
        bounces = self._random.randrange(4) if self.spec.bounce_s > 0 else 0
        moments_s = sorted(at_s + self._random.random() * self.spec.bounce_s for _ in range(2 * bounces))
        states = [closed, *(state for _ in range(bounces) for state in (not closed, closed))]
        self._changes.extend(zip([at_s, *moments_s], states, strict=True))
