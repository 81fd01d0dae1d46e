"""How far an axis may go before a command can end that: from where it may be now to where it may come to rest.

Knows speeds, and how far a motor runs on. Gives bounds, not guesses: the motor may be 1.5 times as fast as the file
says, coasts as long as the box could bear until it has been seen to coast, and the axis has moved on since the latest
reading. Knows no goal and no sector.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.motion import RESTS_AFTER_S, Motion
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.control.sky.mount import Range
from rotator.control.sky.sectors import UNKNOWN
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Motor

FASTER_THAN_FILE, FASTER_THAN_LEARNT = 1.5, 1.2
"""How many times faster a motor may be than the file says, or than its runs have shown."""
UNSEEN_LAG_S = RESTS_AFTER_S
"""So long a motor may take to lose its speed that was never seen to: one that takes longer still turns when the box has
taken it to rest, and is a fault. How short the file calls its coast proves nothing."""
RELAY_OPENS_S = 0.03
"""A relay opens within this time."""
START_S = 0.15
"""A motor starts only where it may run for this long."""
NEAR_MODEL_DEG = 3.0
"""A reading further from the model is a spark on the wire. The model ignores it too."""
LOST_AFTER_S = 0.3
"""After this time without a good reading the axis may be anywhere."""
TRUSTED = frozenset({FaultKind.LIMIT_SWITCH, FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF, FaultKind.CONTROL_LATE})
"""Faults that leave the angle true. With any other one the axis may be anywhere."""


def lost(fault: Fault | None) -> bool:
    """Whether this fault leaves the angle in doubt."""
    return fault is not None and fault.kind not in TRUSTED


@dataclass(frozen=True, slots=True)
class Bounds:
    """One direction of a motor at its fastest."""

    speed_dps: float
    lag_s: float

    @property
    def coast_deg(self) -> float:
        return self.speed_dps * (self.lag_s + RELAY_OPENS_S)

    @property
    def stopping_room_deg(self) -> float:
        return self.speed_dps * START_S + self.coast_deg


def bounds(described: Motor, learnt: Motor, coasted_s: float) -> Bounds:
    """`coasted_s`: the longest lag that was seen."""
    fastest_dps = max(FASTER_THAN_FILE * described.speed_dps, FASTER_THAN_LEARNT * learnt.speed_dps)
    return Bounds(fastest_dps, max(described.lag_s, learnt.lag_s, coasted_s))


class Reach:
    def __init__(self, settings: SwitchedSettings) -> None:
        self._described = settings.motor
        kept = zip((Direction.PLUS, Direction.MINUS), settings.learnt or (), strict=False)
        self._coasted_s = {
            way: 0.0 for way, motor in kept if not math.isclose(motor.lag_s, settings.motor.lag_s, rel_tol=1e-3)
        }
        """The directions whose coast an earlier run has learnt: what it learnt is all there is."""
        self._learnt: tuple[dict[Direction, Motor], dict[Direction, float]] = {}, {}
        """The motors and coasts when `_known` was computed."""
        self._known: dict[Direction, Bounds] = {}
        homing = settings.homing
        self._step_deg = homing.period_s * settings.motor.speed_dps if homing else 0.0
        """How far the axis may be from its reading: a count knows only the latest pulse."""

    def stopping_room_deg(self, motion: Motion) -> float:
        """How far it may go on before a command can end that, at its first start too."""
        return max(bound.stopping_room_deg for bound in self._bounds(motion).values()) + self._step_deg

    def swept(self, now_s: float, sensing: Sensing, motion: Motion, relays: RelayState, run: Run | None) -> Range:
        """Where the axis may pass until it rests, if this run is the last one; None: if it is to stop now."""
        angle_deg, seen_s = sensing.angle_deg, sensing.believed_s
        if angle_deg is None or now_s - seen_s > LOST_AFTER_S:
            return UNKNOWN
        model_deg = motion.angle_at(now_s)
        near = abs(angle_deg - model_deg) <= NEAR_MODEL_DEG
        span = Range(model_deg, model_deg).spanning(angle_deg if near else model_deg).widened(self._step_deg)
        motors = self._bounds(motion)
        if relays.last is not Direction.OFF:
            span = _further(span, relays.last, _going_on_deg(motors[relays.last], relays, now_s - seen_s, now_s))
        if run is None or run.direction is Direction.OFF:
            return span
        motor = motors[run.direction]
        # A motor that runs that way already has its coast in the span.
        coast_deg = 0.0 if run.direction is relays.direction else motor.coast_deg
        return _further(span, run.direction, motor.speed_dps * max(0.0, run.until_s - now_s) + coast_deg)

    def _bounds(self, motion: Motion) -> dict[Direction, Bounds]:
        if (motion.motors, motion.coasted_s) != self._learnt:
            self._learnt = dict(motion.motors), dict(motion.coasted_s)
            coasted_s = self._coasted_s | motion.coasted_s
            self._known = {
                way: bounds(self._described, motor, coasted_s.get(way, UNSEEN_LAG_S))
                for way, motor in motion.motors.items()
            }
        return self._known


def _going_on_deg(motor: Bounds, relays: RelayState, age_s: float, now_s: float) -> float:
    """How far it has gone since it was seen, and goes on until it rests."""
    if relays.closed:
        return motor.speed_dps * age_s + motor.coast_deg
    return motor.coast_deg * math.exp(-relays.off_for_s(now_s) / (FASTER_THAN_FILE * motor.lag_s))


def _further(span: Range, direction: Direction, by_deg: float) -> Range:
    end_deg = span.max_deg if direction > 0 else span.min_deg
    return span.spanning(end_deg + direction * by_deg)
