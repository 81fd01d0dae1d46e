"""A cam on a rotor's shaft that closes a contact every few degrees: the only signal of an Alliance U-100.

Knows the angles at which the contact closes and opens, its bounces, and its faults. A change of the contact shows
neither the direction nor the angle. Knows no GPIO line: it returns changes of the contact with their moments.
"""

from __future__ import annotations

import math
import random
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

BISECTIONS = 40
"""An hour halved 40 times is some nanoseconds: the precision of the moment of an edge."""
DOUBLED_AT_S, DOUBLED_FOR_S = 0.04, 0.03
"""A doubled pulse opens this long after it closed, for this time. A debounce of 20 ms does not remove the gap."""


@dataclass(frozen=True, slots=True)
class ContactSpec:
    """Geometry of the cam, and the bouncing of the contact."""

    spacing_deg: float = 5.0
    """Angle from one closure to the next."""
    closed_deg: float = 1.0
    """The part of `spacing_deg` in which the contact is closed."""
    closes_at_deg: float = 0.0
    """Angle of the beginning of any one closure, for a shaft that turns clockwise or up."""
    play_deg: float = 0.0
    """Backlash between shaft and cam: after a reversal each edge comes later by this angle."""
    bounce_s: float = 0.005
    """Duration of the bouncing after each change."""


class ContactFault(Enum):
    """How a contact fails."""

    NONE = "none"
    STUCK_OPEN = "stuck open"
    STUCK_CLOSED = "stuck closed"
    MISSES = "misses a closure now and then"
    DOUBLES = "closes twice now and then"


FAULTY_EACH = 5
"""Every fifth closure is missed, or doubled, unless another number is asked for."""


class SimContact:
    """Add `turned` to a motor's `on_turn`. `take` returns the changes."""

    def __init__(self, spec: ContactSpec, shaft_deg: float, seed: int = 0) -> None:
        self.spec = spec
        self.fault = ContactFault.NONE
        self.faulty_each = FAULTY_EACH
        """Each so manyth closure is missed, or doubled."""
        self._random = random.Random(seed)
        self._cam_deg = shaft_deg
        self.zone = 2 * math.floor((shaft_deg - spec.closes_at_deg) / spec.spacing_deg)
        """The zone of the cam: even zones are closed, odd ones are the gaps above them."""
        if shaft_deg >= self._low_deg(self.zone + 1):
            self.zone += 1
        self._taken = self.zone % 2 == 0
        self._changes: deque[tuple[float, bool]] = deque()
        self._closures = 0

    def take(self, until_s: float) -> list[tuple[float, bool]]:
        """The changes since the last call, up to `until_s`: moment and state (True: closed), oldest first."""
        taken: list[tuple[float, bool]] = []
        while self._changes and self._changes[0][0] <= until_s:
            at_s, closed = self._changes.popleft()
            if closed is not self._taken:
                self._taken = closed
                taken.append((at_s, closed))
        return taken

    @property
    def closed(self) -> bool:
        """The state after the last change that `take` returned."""
        return self._taken

    def break_down(self, fault: ContactFault, now_s: float) -> None:
        """Begin that fault at the moment `now_s`; NONE ends it."""
        self.fault = fault
        self._change(now_s, self._shown(self.zone % 2 == 0))

    def turned(self, from_s: float, seconds: float, shaft_deg: Callable[[float], float]) -> None:
        """Follow a turn of the shaft in one direction; see `firmware_sim.parts.motor.Stretch`."""
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
        """Angle of the cam. After a reversal it follows the shaft only at the end of the backlash."""
        return min(max(self._cam_deg, shaft_deg), shaft_deg + self.spec.play_deg)

    def _low_deg(self, zone: int) -> float:
        """Angle of the lower edge of a zone."""
        turns, gap = divmod(zone, 2)
        return self.spec.closes_at_deg + turns * self.spec.spacing_deg + gap * self.spec.closed_deg

    def _when(self, beyond: Callable[[float], bool], shaft_deg: Callable[[float], float], seconds: float) -> float:
        """Seconds until the cam is first `beyond` an edge, by bisection."""
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
        odd = self._closures % self.faulty_each == 0
        if self.fault is ContactFault.MISSES and odd:
            return
        self._change(at_s, self._shown(closed))
        if self.fault is ContactFault.DOUBLES and odd and closed:
            self._changes.append((at_s + DOUBLED_AT_S, False))
            self._changes.append((at_s + DOUBLED_AT_S + DOUBLED_FOR_S, True))

    def _shown(self, closed: bool) -> bool:
        return {ContactFault.STUCK_OPEN: False, ContactFault.STUCK_CLOSED: True}.get(self.fault, closed)

    def _change(self, at_s: float, closed: bool) -> None:
        """Change to that state, with some bounces. Bounces of an earlier change end at `at_s`."""
        while self._changes and self._changes[-1][0] >= at_s:
            self._changes.pop()
        before = self._changes[-1][1] if self._changes else self._taken
        if before is closed:
            return
        bounces = self._random.randrange(4) if self.spec.bounce_s > 0 else 0
        moments_s = sorted(at_s + self._random.random() * self.spec.bounce_s for _ in range(2 * bounces))
        states = [closed, *(state for _ in range(bounces) for state in (not closed, closed))]
        self._changes.extend(zip([at_s, *moments_s], states, strict=True))
