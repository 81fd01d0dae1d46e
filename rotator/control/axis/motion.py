"""A model of a switched motor and its axis: where the axis is, how fast it turns, and where it would come to rest.

Knows the readings and what the relays did. Learns the motor's speed and coast in each direction from every run. Knows
no target and decides nothing.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

from hw.ports import Direction
from rotator.exchange.motor import Motor

GAIN_RUNNING = 0.15
GAIN_RESTING = 0.03
JUMP_DEG = 3.0
"""A reading this far from the model is a spark on the wire, unless it stays."""
JUMP_READINGS = 3
LAGS_READINGS, LAGS_DEG = 20, 0.3
"""The model is too slow if it was behind by this much, on average over this many readings at full speed."""
RESTS_AFTER_S = 0.8
"""How long a motor takes to come to rest for certain; the readings after that show where it stopped."""
LANDING_READINGS = 10
LEARN_SHARE = 0.35
"""How far one run moves what has been learnt."""
LEAST_RUN_DEG = 1.0
"""Shorter runs teach nothing: the noise of the readings is as large as they are."""
NEARLY_FULL_SPEED = 0.98
FULL_SPEED = 0.8
"""A run that got this near to full speed shows the whole coast."""


@dataclass(slots=True)
class _Run:
    direction: Direction
    started_s: float
    from_deg: float | None
    """Where the axis rested before; None: it was still coasting."""
    spared_s: float = 0.0
    """At full speed it would have taken so much less."""


@dataclass(slots=True)
class _Landing:
    """A run that has been switched off and coasts: what it was to reach."""

    run: _Run
    off_s: float
    wanted_deg: float
    pace: float
    speed_share: float
    readings: list[float]


class Motion:
    """One axis. Give it every reading (`see`) and every change of the relays (`note_drive`), in order of time."""

    def __init__(self, motors: Mapping[Direction, Motor]) -> None:
        self.motors = dict(motors)
        self.coasted_s: dict[Direction, float] = {}
        """The longest coast at full speed that was seen, as the lag that explains it."""
        self.angle_deg: float | None = None
        self._speed_dps = 0.0
        self._at_s = 0.0
        self._pace, self._paced_s = 1.0, 0.0
        self._run: _Run | None = None
        self._landing: _Landing | None = None
        self._strays: deque[tuple[float, float]] = deque(maxlen=JUMP_READINGS)
        self._behind: deque[tuple[float, float]] = deque(maxlen=LAGS_READINGS)
        """How far the readings of this run were ahead of the model, each with its moment."""

    @property
    def resting(self) -> bool:
        return self._run is None and self._landing is None

    @property
    def direction(self) -> Direction:
        """Of the present run; OFF: there is none."""
        return self._run.direction if self._run else Direction.OFF

    def note_drive(self, now_s: float, direction: Direction, wanted_deg: float) -> None:
        """From now on the relays drive that way. OFF: the run is to come to rest at `wanted_deg`."""
        if self.angle_deg is None or direction is self.direction:
            return
        self._advance(now_s)
        run, self._run = self._run, None
        self._behind.clear()
        if direction is not Direction.OFF:
            self._run = _Run(direction, now_s, self.angle_deg if self._landing is None else None)
            self._landing = None
        elif run is not None:
            self._spare(run, now_s)
            speed_share = self._speed_dps * run.direction / (self.motors[run.direction].speed_dps * self._pace)
            self._landing = _Landing(run, now_s, wanted_deg, self._pace, speed_share, [])

    def note_pace(self, now_s: float, pace: float) -> None:
        """From now on an output lets the motor turn at this share of its full speed."""
        if pace == self._pace:
            return
        if self.angle_deg is not None:
            self._advance(now_s)
        if self._run:
            self._spare(self._run, now_s)
        self._pace, self._paced_s = pace, now_s

    def _spare(self, run: _Run, now_s: float) -> None:
        run.spared_s += (1.0 - self._pace) * (now_s - max(self._paced_s, run.started_s))

    def forget_run(self) -> None:
        """Learn nothing from the present or latest run: something was wrong with it."""
        self._run = self._landing = None

    def see(self, at_s: float, angle_deg: float) -> None:
        """A believable reading."""
        if self.angle_deg is None:
            self.angle_deg, self._at_s = angle_deg, at_s
            return
        self._advance(at_s)
        stray_deg = angle_deg - self.angle_deg
        if abs(stray_deg) > JUMP_DEG:
            self._strays.append((at_s, angle_deg))
            if len(self._strays) == JUMP_READINGS:
                # The readings stay there: so does the axis (a hand on another switch, or a motor faster than known).
                self._correct_speed()
                self.angle_deg = angle_deg
                self._strays.clear()
            return
        self._strays.clear()
        self._note_behind(at_s, stray_deg)
        self.angle_deg += (GAIN_RESTING if self.resting else GAIN_RUNNING) * stray_deg
        self._land(at_s, angle_deg)

    def angle_at(self, now_s: float) -> float:
        """Where the axis is at this moment; 0 before the first reading."""
        return self._angle_at(now_s, self._speed_at(now_s))

    def rest_deg(self, now_s: float) -> float:
        """Where the axis would stand if the motor were switched off now; 0 before the first reading."""
        speed_dps = self._speed_at(now_s)
        return self._angle_at(now_s, speed_dps) + speed_dps * self._lag_s()

    def _angle_at(self, now_s: float, speed_dps: float) -> float:
        """With the speed that it has then."""
        if self.angle_deg is None:
            return 0.0
        return self.angle_deg + (self._speed_dps + speed_dps) / 2 * (now_s - self._at_s)

    def _lag_s(self) -> float:
        run = self._run or (self._landing.run if self._landing else None)
        return self.motors[run.direction if run else Direction.PLUS].lag_s

    def _wanted_dps(self) -> float:
        """The speed that the motor makes for."""
        return self.motors[self._run.direction].speed_dps * self._run.direction * self._pace if self._run else 0.0

    def _speed_at(self, now_s: float) -> float:
        wanted_dps = self._wanted_dps()
        fade = math.exp(-max(0.0, now_s - self._at_s) / self._lag_s())
        return wanted_dps + (self._speed_dps - wanted_dps) * fade

    def _advance(self, now_s: float) -> None:
        """Let the model run to this moment."""
        assert self.angle_deg is not None
        passed_s = now_s - self._at_s
        if passed_s <= 0:
            return
        wanted_dps = self._wanted_dps()
        lag_s = self._lag_s()
        fade = math.exp(-passed_s / lag_s)
        gap_dps = self._speed_dps - wanted_dps
        self.angle_deg += wanted_dps * passed_s + gap_dps * lag_s * (1 - fade)
        self._speed_dps = wanted_dps + gap_dps * fade
        self._at_s = now_s

    def _note_behind(self, at_s: float, stray_deg: float) -> None:
        """A motor faster than its model is ahead of it at every reading, and would be stopped too late."""
        run, behind = self._run, self._behind
        if run is None or abs(self._speed_dps) < NEARLY_FULL_SPEED * self.motors[run.direction].speed_dps:
            return
        behind.append((at_s, stray_deg * run.direction))
        if len(behind) < LAGS_READINGS:
            return
        behind_deg = sum(each_deg for _, each_deg in behind) / LAGS_READINGS
        if behind_deg <= LAGS_DEG:
            return
        motor, period_s = self.motors[run.direction], (at_s - behind[0][0]) / (LAGS_READINGS - 1)
        speed_dps = motor.speed_dps + GAIN_RUNNING * behind_deg / period_s
        self.motors[run.direction] = Motor(speed_dps, speed_dps * motor.lag_s)
        self._speed_dps = speed_dps * run.direction
        assert self.angle_deg is not None
        self.angle_deg += (1.0 - GAIN_RUNNING) * behind_deg * run.direction
        behind.clear()

    def _correct_speed(self) -> None:
        """A motor that leaves its model far behind is faster than was known: take the speed that is seen."""
        (first_s, first_deg), (last_s, last_deg) = self._strays[0], self._strays[-1]
        if self._run is None or last_s <= first_s:
            return
        motor, direction = self.motors[self._run.direction], self._run.direction
        seen_dps = (last_deg - first_deg) / (last_s - first_s) * direction
        if seen_dps > motor.speed_dps:
            self.motors[direction] = Motor(seen_dps, seen_dps * motor.lag_s)
            self._speed_dps = seen_dps * direction

    def _land(self, at_s: float, angle_deg: float) -> None:
        """Once the axis has come to rest, learn from how far the run took it and from how far it missed its goal."""
        landing = self._landing
        if landing is None or at_s - landing.off_s < RESTS_AFTER_S:
            return
        landing.readings.append(angle_deg)
        if len(landing.readings) < LANDING_READINGS:
            return
        self._landing = None
        self.angle_deg = rest_deg = sum(landing.readings) / len(landing.readings)
        self._speed_dps = 0.0
        run = landing.run
        motor = self.motors[run.direction]
        speed_dps, coast_deg = motor.speed_dps, motor.coast_deg
        if run.from_deg is not None:
            # What a motor loses while it starts it gives back while it coasts: from rest to rest it has gone its full
            # speed times the time for which it was on.
            gone_deg = (rest_deg - run.from_deg) * run.direction
            if gone_deg > LEAST_RUN_DEG:
                trust = LEARN_SHARE * min(1.0, gone_deg / (4 * LEAST_RUN_DEG))
                speed_dps += trust * (gone_deg / (landing.off_s - run.started_s - run.spared_s) - speed_dps)
        if landing.speed_share > FULL_SPEED:
            missed_deg = (rest_deg - landing.wanted_deg) * run.direction / landing.pace
            seen_s = (coast_deg + missed_deg) / motor.speed_dps
            self.coasted_s[run.direction] = max(self.coasted_s.get(run.direction, 0.0), seen_s)
            coast_deg = min(max(coast_deg + LEARN_SHARE * missed_deg, 0.0), 3.0 * speed_dps)
        self.motors[run.direction] = Motor(speed_dps, coast_deg)
