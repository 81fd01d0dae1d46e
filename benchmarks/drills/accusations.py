"""The lines of the table of what may never happen, as judges name them, and a find of a judge.

Knows words. Judges nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

BOTH_FED = "both directions of a motor fed, welds included"
BRAKED = "a motor fed against its brake, or a brake that falls on a turning shaft"
NOT_FITTED = "current for an axis that the rotor does not have"
SPED = "a speed input that stays above its lowest while the motor is off"
BEYOND = "driven against a stop, or beyond the axis's limits"
AFTER_STOP = "moving after the last S, STOP, SIGTERM or lease"
AWAY = "moving away from the target under power"
NO_ORDER = "moving with no order in force"
FORBIDDEN = "inside a forbidden sector, coming from outside"
STANDING_CURRENT = "current in a motor that does not turn"
STARTS = "relay starts an hour under any bad sensor"
NOT_SO = "an angle shown that is not so"
SILENCE = "a fault that lasts without a message"
TABLE = (
    BOTH_FED,
    BRAKED,
    NOT_FITTED,
    SPED,
    BEYOND,
    AFTER_STOP,
    AWAY,
    NO_ORDER,
    FORBIDDEN,
    STANDING_CURRENT,
    STARTS,
    NOT_SO,
    SILENCE,
)

LOOK_S = 0.11
"""A look comes every 0.05 s: a judge may see an event later by this."""


@dataclass(frozen=True, slots=True)
class Violation:
    """A find of a judge. `at_s`: seconds from the beginning of the drill; `measured`: in words for a person."""

    at_s: float
    judge: str
    axis: str
    measured: str

    def __str__(self) -> str:
        return f"{self.judge}: {self.axis}: {self.measured}, at {self.at_s:.2f} s"
