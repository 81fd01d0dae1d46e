"""Decides whether sensor readings can be trusted: while the axis stands, and while it turns.

Knows numbers (shares of a range, or degrees) and what good ones look like. Does not know sensors or motors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import fmean, median

READINGS = 40
"""Readings averaged for one point: two seconds at 20 Hz; the mean has a sixth of one reading's noise."""
BLOCK = 5
"""Readings averaged where a movement is examined."""
MIDDLE = 0.674
"""Half of all values of a normal distribution are less than this share of their rms."""
SETBACK = 0.15
"""A movement may go back by this share of its length (gear play, noise). More means that something slips."""


@dataclass(frozen=True, slots=True)
class ReadingUnit:
    """The unit of a sensor's readings, and the sizes that matter in that unit."""

    noisy: float
    """More noise than this (rms): the sensor does not work."""
    least_move: float
    """A smaller change is no movement, however quiet the sensor."""
    least_back: float
    """A smaller step back is play, however quiet the sensor."""
    least_turn: float
    """The change that a direction check needs."""
    digits: int
    symbol: str = ""

    def text(self, reading: float, *, signed: bool = False) -> str:
        return f"{reading:{'+' if signed else ''}.{self.digits}f}{self.symbol}"


SHARES = ReadingUnit(noisy=0.004, least_move=0.0006, least_back=0.002, least_turn=0.01, digits=4)
"""0 to 1: a pot or a magnet. 0.01 is 5° of a 450° rotor."""
DEGREES = ReadingUnit(noisy=2.0, least_move=0.3, least_back=0.5, least_turn=2.0, digits=1, symbol="°")


class NotTrusted(ValueError):  # noqa: N818 - a judgement on a reading; the program has not failed
    """Why a reading is not trusted. The text helps the operator to find the cause."""


@dataclass(frozen=True, slots=True)
class Measured:
    """A reading of an axis at rest: the mean of many, and the noise (rms) of one."""

    raw: float
    noise: float


def measure(readings: Sequence[float], lowest: float, highest: float, unit: ReadingUnit = SHARES) -> Measured:
    """The mean of readings taken while the axis stands. Raises NotTrusted."""
    raw, noise = fmean(readings), _noise(readings)
    for reading in readings:
        if not lowest <= reading <= highest:
            raise NotTrusted(
                f"reads {unit.text(reading)}, outside lowest_reading {lowest:g} to highest_reading {highest:g}: "
                "a broken wire, or a pot without end resistors (rotator help wiring)"
            )
    if noise > unit.noisy:
        raise NotTrusted(
            f"a noisy reading: {unit.text(min(readings))} to {unit.text(max(readings))} while it should stand; look "
            "for a bad contact, or sensor wires beside motor wires"
        )
    half = len(readings) // 2
    moved = fmean(readings[half:]) - fmean(readings[:half])
    if abs(moved) > max(unit.least_move, 5 * noise * math.sqrt(2 / half)):
        by = unit.text(moved, signed=True)
        raise NotTrusted(f"the reading moved by {by} while it should stand; wait until the antenna is at rest")
    return Measured(raw, noise)


@dataclass(frozen=True, slots=True)
class Movement:
    """What the reading did from one rest to the next."""

    before: float
    after: float
    noise: float
    setback: float
    """The largest step back on the way."""
    unit: ReadingUnit = SHARES

    @property
    def change(self) -> float:
        return self.after - self.before

    @property
    def stood(self) -> bool:
        """The change is too small to tell from standing still."""
        return abs(self.change) < max(self.unit.least_move, 4 * self.noise)

    def objection(self) -> str:
        """Why this is not a motor that turns a pot in one direction; empty: it is."""
        if self.stood:
            return (
                f"the reading stands still at {self.unit.text(self.after)}: is the axis at its stop, does the motor "
                "run, is the pot on its shaft?"
            )
        if self.setback > max(SETBACK * abs(self.change), 4 * self.noise, self.unit.least_back):
            back = self.unit.text(self.setback)
            return f"the reading went back by {back} on the way: does the pot slip, is a contact bad?"
        return ""


def stands(readings: Sequence[float], unit: ReadingUnit = SHARES) -> bool:
    """Whether the second half of these readings is no further from the first than their noise explains.

    The noise is that of the middle one of all steps: some readings that came late are one large step. False also where
    the noise would hide a movement.
    """
    steps = [b - a for a, b in pairwise(readings)]
    if min(steps) >= 0 or max(steps) <= 0:
        return not any(steps)
    half = len(readings) // 2
    error = median(map(abs, steps)) / MIDDLE * math.sqrt(1 / half)
    flicker = min(abs(step) for step in steps if step)
    change = abs(fmean(readings[half:]) - fmean(readings[:half]))
    return change <= max(error, flicker) and 3 * error <= unit.least_move


def movement(before: Sequence[float], during: Sequence[float], unit: ReadingUnit = SHARES) -> Movement:
    """From the readings at rest, and those from there until the next rest."""
    blocks = [fmean(during[at : at + BLOCK]) for at in range(0, len(during) - BLOCK + 1, BLOCK)]
    start, end = fmean(before), fmean(during[-BLOCK:])
    sign = 1 if end >= start else -1
    best, setback = start * sign, 0.0
    for block in blocks:
        best = max(best, block * sign)
        setback = max(setback, best - block * sign)
    return Movement(start, end, _noise(before), setback, unit)


def _noise(readings: Sequence[float]) -> float:
    """From one reading to the next, so that a slow movement does not count as noise."""
    steps = [b - a for a, b in pairwise(readings)]
    return math.sqrt(fmean(step * step for step in steps) / 2) if steps else 0.0
