"""A wedge brake on a motor's shaft: a solenoid draws the wedge, a spring drives it home.

Knows the solenoid's time, a wedge that sticks in its notch, and what harms it: a motor that is fed against it, and a
wedge that falls while the shaft turns. Knows no GPIO line. `SimMotor` asks it whether the shaft is held.
"""

from __future__ import annotations

from collections import deque

DRAWS_S, FALLS_S = 0.2, 0.1
"""The wedge is out, or home, so long after its coil was switched."""


class SimBrake:
    def __init__(self) -> None:
        self.drawn = False
        """Whether the solenoid has drawn the wedge, unless a fault keeps it."""
        self.stuck = False
        """Fault: the solenoid does not draw the wedge."""
        self.sticks = False
        """Fault: a motor presses the wedge into its notch; only a motor that runs the other way first frees it."""
        self.fed_s = 0.0
        """Total time for which the motor was fed against the brake, which burns it. Must stay 0."""
        self.jolts = 0
        """How often the wedge fell while the shaft turned, which breaks the gear. Must stay 0."""
        self._pressed = 0
        """The direction that has pressed the wedge into its notch since it was drawn; 0: none."""
        self._freed = False
        self._moves: deque[tuple[float, bool]] = deque()

    def coil(self, now_s: float, *, fed: bool) -> None:
        """The coil is switched; the wedge follows. A coil that is switched back sooner has not moved it."""
        while self._moves and self._moves[-1][0] > now_s:
            self._moves.pop()
        drawn = self._moves[-1][1] if self._moves else self.drawn
        if fed is not drawn:
            self._moves.append((now_s + (DRAWS_S if fed else FALLS_S), fed))

    def next_s(self) -> float:
        """When the wedge moves next; infinite: it does not."""
        return self._moves[0][0] if self._moves else float("inf")

    def move(self, *, turning: bool) -> None:
        """The moment `next_s` has come."""
        _, self.drawn = self._moves.popleft()
        self._pressed, self._freed = 0, False
        self.jolts += turning and not self.drawn

    def holds(self, drive: int) -> bool:
        """Whether it holds a shaft whose motor is fed in this direction; 0: it is not fed."""
        if not self.drawn or self.stuck:
            return True
        if not self.sticks or self._freed or drive == 0:
            return False
        self._pressed = self._pressed or drive
        self._freed = drive != self._pressed
        return not self._freed
