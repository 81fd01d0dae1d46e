"""How the angle of an axis is known: measured, counted or modelled, and in which unit its readings come.

A value and no more. Knows no sensor and no kind of rotor.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import AngleSource


@dataclass(frozen=True, slots=True)
class Angle:
    """How the angle of an axis is known."""

    source: AngleSource
    in_degrees: bool = True
    """The readings are degrees on the rotor's own scale, and need no calibration."""
    pot: bool = False
    """A pot on the converter is read."""
    sensor: str = "pot"
    """What reads it, in a word for the messages of faults."""
    behind_s: float = 0.0
    """A reading shows a place where the axis was at most so long ago: the sensor filters, or averages."""
    by: str = ""
    """The source of the degrees, in words for the user; empty for a calibration."""
