"""How the angle of an axis is known.

Knows what follows from the source of an angle for its readings. Knows no sensor and no kind of rotor.
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
    by: str = ""
    """How the degrees come, for a person; empty: by a calibration."""
