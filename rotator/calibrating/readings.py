"""Whether readings can be believed: while the axis stands, and while it turns.

Knows numbers, shares of a range or degrees, and what good ones look like. Knows no sensor and no motor.
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
SETBACK = 0.15
"""A turn may go back by this share of its way: play, noise. More, and something slips."""


@dataclass(frozen=True, slots=True)
class Grain:
    """How fine readings are, in their own unit, and how they are written."""

    noisy: float
    """Noise beyond this (rms) is no sensor that works."""
    least_move: float
    """A change smaller than this is no movement, however quiet the sensor."""
    least_press: float
    """Less than this in one press, and it stood."""
    least_turn: float
    """What a direction check wants to see."""
    digits: int
    unit: str = ""

    def text(self, reading: float, *, signed: bool = False) -> str:
        return f"{reading:{'+' if signed else ''}.{self.digits}f}{self.unit}"


SHARES = Grain(noisy=0.004, least_move=0.0006, least_press=0.002, least_turn=0.01, digits=4)
"""0 to 1: a pot, a magnet. 0.01 is 5° of a 450° rotor."""
DEGREES = Grain(noisy=2.0, least_move=0.3, least_press=0.5, least_turn=2.0, digits=1, unit="°")


class Doubt(ValueError):  # noqa: N818 - an answer about a reading, not a failure
    """Why it is not believed, for the person who looks for the cause."""


@dataclass(frozen=True, slots=True)
class Measured:
    """A reading that stands: the mean of many, and the noise (rms) of one."""

    raw: float
    noise: float


def measure(readings: Sequence[float], lowest: float, highest: float, grain: Grain = SHARES) -> Measured:
    """The mean of readings taken while the axis stands. Raises Doubt."""
    raw, noise = fmean(readings), _noise(readings)
    for reading in readings:
        if not lowest <= reading <= highest:
            raise Doubt(
                f"reads {grain.text(reading)}, outside lowest_reading {lowest:g} to highest_reading {highest:g}: "
                "a broken wire, or a pot without end resistors (docs/wiring.md)"
            )
    if noise > grain.noisy:
        raise Doubt(
            f"a noisy reading: {grain.text(min(readings))} to {grain.text(max(readings))} while it should stand; look "
            "for a bad contact, or sensor wires beside motor wires"
        )
    half = len(readings) // 2
    moved = fmean(readings[half:]) - fmean(readings[:half])
    if abs(moved) > max(grain.least_move, 5 * noise * math.sqrt(2 / half)):
        by = grain.text(moved, signed=True)
        raise Doubt(f"the reading moved by {by} while it should stand; wait until the antenna is at rest")
    return Measured(raw, noise)


@dataclass(frozen=True, slots=True)
class Turned:
    """What the reading did from rest to rest."""

    before: float
    after: float
    noise: float
    setback: float
    """How far it went back on its way, at most."""
    grain: Grain = SHARES

    @property
    def change(self) -> float:
        return self.after - self.before

    @property
    def stood(self) -> bool:
        """It cannot be told from standing still."""
        return abs(self.change) < max(self.grain.least_press, 4 * self.noise)

    def doubt(self) -> str:
        """Why this is not a motor that turns a pot one way; empty: it is."""
        if self.stood:
            return (
                f"the reading stands still at {self.grain.text(self.after)}: is the axis at its stop, does the motor "
                "run, is the pot on its shaft?"
            )
        if self.setback > max(SETBACK * abs(self.change), 4 * self.noise, self.grain.least_press):
            back = self.grain.text(self.setback)
            return f"the reading went back by {back} on the way: does the pot slip, is a contact bad?"
        return ""


def turned(before: Sequence[float], during: Sequence[float], grain: Grain = SHARES) -> Turned:
    """From readings at rest, and those from there until rest again."""
    blocks = [fmean(during[at : at + BLOCK]) for at in range(0, len(during) - BLOCK + 1, BLOCK)]
    start, end = fmean(before), fmean(during[-BLOCK:])
    sign = 1 if end >= start else -1
    best, setback = start * sign, 0.0
    for block in blocks:
        best = max(best, block * sign)
        setback = max(setback, best - block * sign)
    return Turned(start, end, _noise(before), setback, grain)


def _noise(readings: Sequence[float]) -> float:
    """From one reading to the next, so that a slow movement does not count."""
    steps = [b - a for a, b in pairwise(readings)]
    return math.sqrt(fmean(step * step for step in steps) / 2) if steps else 0.0
