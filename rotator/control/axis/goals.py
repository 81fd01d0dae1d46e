"""What an axis may be at, beside following a target: a person's jog, and the way to its end stop.

Knows values. `pointing.AimGoal` is the third of them. Knows no motor.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.homing import Homing
from rotator.control.axis.run_watch import WAYS
from rotator.status import Fault

UNCALIBRATED_JOG_S = 2.0
"""One press on an axis that nobody has commissioned yet."""


@dataclass(frozen=True, slots=True)
class JogGoal:
    direction: Direction
    until_s: float | None


@dataclass(frozen=True, slots=True)
class HomeGoal:
    """Find the end stop."""

    homing: Homing


def limit_reached(axis: Axis, direction: Direction) -> Fault:
    return Fault("limit switch reached", axis, f"its switch is open, and it was to turn {WAYS[axis, direction]}")


def jog(direction: Direction, seconds: float | None, now_s: float, *, set_up: bool) -> JogGoal | None:
    """What an order to jog asks for; None: to stop. An axis that nobody has set up obeys short presses only."""
    if direction is Direction.OFF:
        return None
    if not set_up:
        seconds = UNCALIBRATED_JOG_S if seconds is None else min(seconds, UNCALIBRATED_JOG_S)
    return JogGoal(direction, None if seconds is None else now_s + seconds)
