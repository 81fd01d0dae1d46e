"""The angle of an axis from which nothing comes back: reckoned from the time for which its relays were closed.

Knows what the relays' lines did, each change with its moment, and a model of the motor: the speed of each direction,
how long it takes to start, how far it coasts. Knows how far such an angle may be off. Sees no motor: one that stalls,
turns the wrong way or does not stop is reckoned like one that does as it should.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from hw.ports import AngleSource, Axis, Direction
from hw.sensors.pulses import TappedLines

PLACED_ERROR_DEG = 1.0
"""How far the axis may be from the angle at which it was placed: the end switch, and a person's eye."""
STANDS_LAGS, STANDS_S = 7.0, 0.2
"""A motor stands after so many of its time constants, and the relay's own time."""


@dataclass(frozen=True, slots=True)
class TimedMotor:
    """A motor on relays. Angles are on the rotor's own scale."""

    plus_dps: float
    minus_dps: float
    """The full speed of each direction, without its sign."""
    start_s: float
    """From the closing of its relay until the motor turns."""
    lag_s: float
    """The time constant with which it gathers and loses its speed: it coasts by speed × lag."""
    low_deg: float
    high_deg: float
    """The end stops."""
    error_share: float
    """How wrong the speeds may be."""
    start_error_deg: float
    """What each start adds to the error."""
    worn_deg: float = 0.0
    """After so much travel it should be placed anew; 0: never."""

    def speed_dps(self, direction: Direction) -> float:
        """With its sign."""
        return self.plus_dps if direction > 0 else -self.minus_dps if direction < 0 else 0.0


class TimedAngle:
    """One axis as a `hw.ports.AngleSensor`; `read` gives degrees, before the first `place` from the low stop on.

    `clock` gives seconds, the same as that of `lines`.
    """

    source = AngleSource.MODELLED
    trouble = ""
    """A model never doubts itself."""
    changes, in_closure, ahead, closed = 0, False, frozenset[Direction](), False
    """There is no contact."""
    turning = quiet = False
    """And so none that could show how the motor runs."""

    def __init__(self, axis: Axis, lines: TappedLines, motor: TimedMotor, clock: Callable[[], float]) -> None:
        self._axis = axis
        self._lines = lines
        self._motor = motor
        self._clock = clock
        self._at_s = clock()
        self._angle_deg = motor.low_deg
        self._speed_dps = 0.0
        self._fed = Direction.OFF
        self._fed_s = -math.inf
        """When the relays last changed."""
        self.travelled_deg = 0.0
        """How far it has turned since it was placed. Each start counts as the way that makes as large an error."""

    def read(self) -> float:
        """Degrees on the rotor's own scale."""
        for event in self._lines.heard(self._axis):
            self._advance(event.at_s)
            if event.direction is not Direction.OFF and self._motor.error_share > 0:
                self.travelled_deg += self._motor.start_error_deg / self._motor.error_share
            self._fed, self._fed_s = event.direction, event.at_s
        self._advance(self._clock())
        return self._angle_deg

    def place(self, angle_deg: float, _within_deg: float = 0.0) -> bool:
        """The axis stands at that angle: an end stop, a kept angle, or what a person has seen."""
        self.read()
        self._angle_deg, self._speed_dps, self.travelled_deg = angle_deg, 0.0, 0.0
        return True

    def reaches(self, angle_deg: float) -> bool:
        """Whether the axis may stand at that angle."""
        return self._motor.low_deg <= angle_deg <= self._motor.high_deg

    @property
    def at_rest(self) -> bool:
        """Whether no relay was on at the last reading, and the motor has stopped coasting."""
        stands_s = STANDS_LAGS * self._motor.lag_s + STANDS_S
        return self._fed is Direction.OFF and self._at_s - self._fed_s >= stands_s

    @property
    def worn(self) -> bool:
        """Whether it has turned so far since it was placed that it should be placed anew."""
        return 0.0 < self._motor.worn_deg <= self.travelled_deg

    @property
    def error_deg(self) -> float | None:
        """How far the axis may be from its reckoned angle."""
        return PLACED_ERROR_DEG + self._motor.error_share * self.travelled_deg

    def _advance(self, until_s: float) -> None:
        """Turn until then: first without current where the motor still takes its time to start."""
        turns_s = min(max(self._fed_s + self._motor.start_s, self._at_s), until_s)
        self._glide(turns_s - self._at_s, 0.0)
        self._glide(until_s - turns_s, self._motor.speed_dps(self._fed))
        self._at_s = max(self._at_s, until_s)

    def _glide(self, seconds: float, wanted_dps: float) -> None:
        """Turn for so long while the speed approaches `wanted_dps`; no further than the end stops."""
        if seconds <= 0.0 or (wanted_dps == 0.0 and self._speed_dps == 0.0):
            return
        gap_dps, lag_s = self._speed_dps - wanted_dps, self._motor.lag_s
        fade = math.exp(-seconds / lag_s) if lag_s > 0 else 0.0
        free_deg = self._angle_deg + wanted_dps * seconds + gap_dps * lag_s * (1.0 - fade)
        angle_deg = min(max(free_deg, self._motor.low_deg), self._motor.high_deg)
        self.travelled_deg += abs(angle_deg - self._angle_deg)
        self._angle_deg = angle_deg
        self._speed_dps = 0.0 if angle_deg != free_deg else wanted_dps + gap_dps * fade
        if wanted_dps == 0.0 and abs(self._speed_dps) < 0.001:
            self._speed_dps = 0.0
