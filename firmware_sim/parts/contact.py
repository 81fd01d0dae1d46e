"""A cam on a rotor's shaft that closes a contact every few degrees: all that an Alliance U-100 tells of itself.

Knows where the contact closes and opens, how long it bounces, and its faults. It tells neither the direction nor the
place. Knows nothing of pins: it hands out changes of the contact with their moments.
"""

from __future__ import annotations

import math
import random
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

BISECTIONS = 40
"""A stretch of an hour halved so often is some nanoseconds."""
DOUBLED_AT_S, DOUBLED_FOR_S = 0.04, 0.03
"""A doubled pulse opens again this soon after it closed, for so long: a debounce of 20 ms lets that through."""


@dataclass(frozen=True, slots=True)
class ContactSpec:
    spacing_deg: float = 5.0
    """From one closure to the next."""
    closed_deg: float = 1.0
    """How much of that it is closed."""
    closes_at_deg: float = 0.0
    """Where one of the closures begins, for a shaft that turns clockwise or up."""
    play_deg: float = 0.0
    """Play between the shaft and the cam: turning back, everything happens this much later."""
    bounce_s: float = 0.005


class ContactFault(Enum):
    NONE = "none"
    STUCK_OPEN = "stuck open"
    STUCK_CLOSED = "stuck closed"
    MISSES = "misses every fifth closure"
    DOUBLES = "closes twice every fifth time"


FAULTY_EACH = 5


class SimContact:
    """Hand `turned` to a motor's `on_turn`, and `take` what has happened."""

    def __init__(self, spec: ContactSpec, shaft_deg: float, seed: int = 0) -> None:
        self.spec = spec
        self.fault = ContactFault.NONE
        self._random = random.Random(seed)
        self._cam_deg = shaft_deg
        self.zone = 2 * math.floor((shaft_deg - spec.closes_at_deg) / spec.spacing_deg)
        """Which stretch of the cam it is on: even ones are closed, odd ones the gaps above them."""
        if shaft_deg >= self._low_deg(self.zone + 1):
            self.zone += 1
        self._told = self.zone % 2 == 0
        self._changes: deque[tuple[float, bool]] = deque()
        self._closures = 0

    def take(self, until_s: float) -> list[tuple[float, bool]]:
        """Moments and states (True: closed) in order of time, each handed out once."""
        taken: list[tuple[float, bool]] = []
        while self._changes and self._changes[0][0] <= until_s:
            at_s, closed = self._changes.popleft()
            if closed is not self._told:
                self._told = closed
                taken.append((at_s, closed))
        return taken

    @property
    def closed(self) -> bool:
        """What it was when that was last told."""
        return self._told

    def break_down(self, fault: ContactFault, now_s: float) -> None:
        """Something goes wrong at this moment, or is put right (NONE)."""
        self.fault = fault
        self._change(now_s, self._shown(self.zone % 2 == 0))

    def turned(self, from_s: float, seconds: float, shaft_deg: Callable[[float], float]) -> None:
        """The shaft has turned, in one direction, along `shaft_deg`."""
        end_deg = self._follow(shaft_deg(seconds))
        # Each edge is looked for at once, before the loop goes on to the next: B023 fears that it is not.
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
        """Turning back, the cam hangs behind the shaft by the play."""
        return min(max(self._cam_deg, shaft_deg), shaft_deg + self.spec.play_deg)

    def _low_deg(self, zone: int) -> float:
        """Where a zone begins."""
        turns, gap = divmod(zone, 2)
        return self.spec.closes_at_deg + turns * self.spec.spacing_deg + gap * self.spec.closed_deg

    def _when(self, beyond: Callable[[float], bool], shaft_deg: Callable[[float], float], seconds: float) -> float:
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
        """To that state, after some bouncing; what was still to come of an earlier change is overtaken."""
        while self._changes and self._changes[-1][0] >= at_s:
            self._changes.pop()
        before = self._changes[-1][1] if self._changes else self._told
        if before is closed:
            return
        bounces = self._random.randrange(4) if self.spec.bounce_s > 0 else 0
        moments_s = sorted(at_s + self._random.random() * self.spec.bounce_s for _ in range(2 * bounces))
        states = [closed, *(state for _ in range(bounces) for state in (not closed, closed))]
        self._changes.extend(zip([at_s, *moments_s], states, strict=True))
