"""The orders in force for one axis of a drill: whose they are, where in its range they lead, and when they end.

Knows when an order has turned the motor for as long as it may. Does not know which orders there are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Ranges:
    """The range of an axis in true degrees, as orders name them; `flips`: over the top."""

    low_deg: float
    high_deg: float
    flips: bool


@dataclass(slots=True)
class Goal:
    """One sender's order for one axis. `angles_deg` empty: anywhere. `way`: it jogs."""

    angles_deg: tuple[float, ...] = ()
    ends_deg: tuple[float, ...] = ()
    """The ends of the range where it may be waited for meanwhile."""
    way: int = 0
    said_s: float = 0.0
    until_s: float = math.inf
    turns_s: float = math.inf
    """For so long more it may turn the motor, whenever it begins."""
    rate_dps: float = 0.0


@dataclass(slots=True)
class AxisOrders:
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
        """The box has fed the motor this way for so long."""
        for goal in self.goals.values():
            if goal.way == way:
                goal.turns_s -= past_s
                if goal.turns_s <= 0.0:
                    goal.until_s = min(goal.until_s, now_s)
        self.expire(now_s)

    def expire(self, now_s: float) -> None:
        for sender in [sender for sender, goal in self.goals.items() if goal.until_s <= now_s]:
            self.ended_s = self.goals.pop(sender).until_s
