"""Whether readings can be believed: while the axis stands, and while it turns.

Knows numbers between 0 and 1 and what good ones look like. Knows no sensor, no motor and no degrees.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import fmean

READINGS = 40
"""Averaged for one point: two seconds at 20 Hz, and a sixth of one reading's noise."""
BLOCK = 5
"""Readings averaged where a turn is looked at."""
NOISY = 0.004
"""Noise beyond this (rms) is no pot that works: 2° of a 450° rotor."""
LEAST_MOVE = 0.0006
"""A change smaller than this is no movement, however quiet the pot."""
LEAST_TURN = 0.01
"""What a direction check wants to see: 5° of a 450° rotor."""
LEAST_PRESS = 0.002
SETBACK = 0.15
"""A turn may go back by this share of its way: play, noise. More, and something slips."""


class Doubt(ValueError):  # noqa: N818 - an answer about a reading, not a failure
    """Why it is not believed, for the person who looks for the cause."""


@dataclass(frozen=True, slots=True)
class Measured:
    """A reading that stands: the mean of many, and the noise (rms) of one."""

    raw: float
    noise: float


def measure(readings: Sequence[float], lowest: float, highest: float) -> Measured:
    """The mean of readings taken while the axis stands. Raises Doubt."""
    raw, noise = fmean(readings), _noise(readings)
    for reading in readings:
        if not lowest <= reading <= highest:
            raise Doubt(
                f"reads {reading:.4f}, outside lowest_reading {lowest:g} to highest_reading {highest:g}: "
                "a broken wire, or a pot without end resistors (docs/wiring.md)"
            )
    if noise > NOISY:
        raise Doubt(
            f"a noisy reading: {min(readings):.4f} to {max(readings):.4f} while it should stand; look for a bad "
            "contact, or pot wires beside motor wires"
        )
    half = len(readings) // 2
    moved = fmean(readings[half:]) - fmean(readings[:half])
    if abs(moved) > max(LEAST_MOVE, 5 * noise * math.sqrt(2 / half)):
        raise Doubt(f"the reading moved by {moved:+.4f} while it should stand; wait until the antenna is at rest")
    return Measured(raw, noise)


@dataclass(frozen=True, slots=True)
class Turned:
    """What the reading did from rest to rest."""

    before: float
    after: float
    noise: float
    setback: float
    """How far it went back on its way, at most."""

    @property
    def change(self) -> float:
        return self.after - self.before

    @property
    def stood(self) -> bool:
        """It cannot be told from standing still."""
        return abs(self.change) < max(LEAST_PRESS, 4 * self.noise)

    def doubt(self) -> str:
        """Why this is not a motor that turns a pot one way; empty: it is."""
        if self.stood:
            return (
                f"the reading stands still at {self.after:.4f}: is the axis at its stop, does the motor run, "
                "is the pot on its shaft?"
            )
        if self.setback > max(SETBACK * abs(self.change), 4 * self.noise, LEAST_PRESS):
            return f"the reading went back by {self.setback:.4f} on the way: does the pot slip, is a contact bad?"
        return ""


def turned(before: Sequence[float], during: Sequence[float]) -> Turned:
    """From readings at rest, and those from there until rest again."""
    blocks = [fmean(during[at : at + BLOCK]) for at in range(0, len(during) - BLOCK + 1, BLOCK)]
    start, end = fmean(before), fmean(during[-BLOCK:])
    sign = 1 if end >= start else -1
    best, setback = start * sign, 0.0
    for block in blocks:
        best = max(best, block * sign)
        setback = max(setback, best - block * sign)
    return Turned(start, end, _noise(before), setback)


def _noise(readings: Sequence[float]) -> float:
    """From one reading to the next, so that a slow movement does not count."""
    steps = [b - a for a, b in pairwise(readings)]
    return math.sqrt(fmean(step * step for step in steps) / 2) if steps else 0.0
