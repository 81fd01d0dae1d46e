"""What an axis is sent to: one target angle, with the path of the next minute if the target moves.

Knows values in the axis's own angles. Does not know the direction that was ordered, nor how an axis gets there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from rotator.control.sky.plan import OFFSETS_S, Path

EVEN = (1.0,) * len(OFFSETS_S)
"""The weights of a path all of whose angles count alike."""


@dataclass(frozen=True, slots=True)
class AimGoal:
    """A target, with its path where it moves. The tolerance is the axis's own, or on the sky along a path."""

    target_deg: float
    tolerance_deg: float
    path: Path | None = None

    def mapped(self, to_deg: Callable[[float], float]) -> AimGoal:
        """The same goal, with each of its angles converted by `to_deg`."""
        path = None if self.path is None else replace(self.path, angles_deg=[*map(to_deg, self.path.angles_deg)])
        return replace(self, target_deg=to_deg(self.target_deg), path=path)

    def standing(self) -> AimGoal:
        """The same target without its path."""
        return self if self.path is None else replace(self, path=None)


Goals = tuple[AimGoal, AimGoal | None]
"""For azimuth and elevation; None: elevation keeps what it has."""
