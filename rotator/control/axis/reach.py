"""How far an axis may go before a command can end that: from where it may be now to where it may come to rest.

Knows speeds, and how far a motor runs on. Bounds, not guesses: the motor may be half as fast again as the file says,
and the latest reading is as old as it is. Knows no goal and no sector.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.motion import Motor
from rotator.control.sky.mount import Range
from rotator.faults import Fault, FaultKind

FASTER, FASTER_LEARNT = 1.5, 1.2
"""A motor may be so much faster than the file says, or than its runs have shown."""
RELAY_S = 0.03
"""A relay opens within this time."""
START_S = 0.15
"""A motor starts only where it may run for so long."""
NEAR_MODEL_DEG = 3.0
"""A reading further from the model is a spark on the wire, which the model leaves out too."""
UNSEEN_S = 0.3
"""Without a good reading for so long the axis may be anywhere."""
TRUSTED = frozenset({FaultKind.LIMIT_SWITCH, FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF, FaultKind.CONTROL_LATE})
"""Faults that leave the angle true. With any other one the axis may be anywhere."""


def lost(fault: Fault | None) -> bool:
    """Whether this fault leaves the angle in doubt."""
    return fault is not None and fault.kind not in TRUSTED


@dataclass(frozen=True, slots=True)
class Seen:
    """Where a switched axis was seen, and what its relays do."""

    angle_deg: float
    """The latest good reading."""
    age_s: float
    model_deg: float
    """Where the model of the motor has it now."""
    direction: Direction
    last: Direction
    """The direction of the latest run."""
    off_s: float
    """For how long the relays have been open."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """One direction of a motor at its fastest."""

    speed_dps: float
    lag_s: float

    @property
    def coast_deg(self) -> float:
        return self.speed_dps * (self.lag_s + RELAY_S)

    @property
    def room_deg(self) -> float:
        return self.speed_dps * START_S + self.coast_deg


def bounds(described: Motor, learnt: Motor) -> Bounds:
    fastest_dps = max(FASTER * described.speed_dps, FASTER_LEARNT * learnt.speed_dps)
    return Bounds(fastest_dps, max(described.lag_s, learnt.lag_s))


def swept(seen: Seen, motors: dict[Direction, Bounds], drive: Direction, drive_s: float) -> Range:
    """Where the axis may pass until it rests, if it is driven that way for so long from now on (OFF: not at all)."""
    near = abs(seen.angle_deg - seen.model_deg) <= NEAR_MODEL_DEG
    span = Range(seen.model_deg, seen.model_deg).spanning(seen.angle_deg if near else seen.model_deg)
    if seen.last is not Direction.OFF:
        motor = motors[seen.last]
        if seen.direction is seen.last:
            span = _further(span, seen.last, motor.speed_dps * seen.age_s + motor.coast_deg)
        else:
            span = _further(span, seen.last, motor.coast_deg * math.exp(-seen.off_s / (FASTER * motor.lag_s)))
    if drive is Direction.OFF:
        return span
    motor = motors[drive]
    coast_deg = 0.0 if drive is seen.direction else motor.coast_deg
    return _further(span, drive, motor.speed_dps * drive_s + coast_deg)


def _further(span: Range, direction: Direction, by_deg: float) -> Range:
    end_deg = span.max_deg if direction > 0 else span.min_deg
    return span.spanning(end_deg + direction * by_deg)
