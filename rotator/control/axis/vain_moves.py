"""Whether a positioned axis follows: moves that did not bring it nearer, and a moving target that it did not follow.

Knows where the axis was sent, for how long, and how far it came nearer meanwhile. A move that ends too early for a
fault counts with the fault that comes later. Finds no fault, and stops nothing.
"""

from __future__ import annotations

import math

LEAST_TRY_S = 0.4
"""In a shorter move a motor may not have started yet."""


class VainMoves:
    """Tell it of each look at an axis that is sent somewhere (`see`), and when its drive holds (`hold`)."""

    def __init__(self) -> None:
        self.count = 0
        """Moves in vain since the axis last came nearer, or since a fault counted them; without the present one."""
        self._since_s: float | None = None
        """When the present move began; None: the axis is there, it came nearer, or the move is counted."""
        self._lasts_s = 0.0
        self._least_deg = 0.0

    @property
    def any(self) -> bool:
        """Whether the present move, or one before it, has not been seen to bring it nearer."""
        return self.count > 0 or self._since_s is not None

    def see(self, sent_s: float, nearer_deg: float, coming_deg: float, *, begins: bool) -> None:
        """`sent_s`: for how long, in all, the axis was sent somewhere. `nearer_deg`: how far, in all, it came nearer.

        `begins`: the drive held before, and the axis is sent elsewhere.
        """
        if begins:
            self._since_s, self._least_deg = sent_s, nearer_deg
        if self._since_s is None:
            return
        self._lasts_s = sent_s - self._since_s
        self._least_deg = min(self._least_deg, nearer_deg)
        if nearer_deg - self._least_deg >= coming_deg:
            self.count, self._since_s = 0, None

    def hold(self) -> None:
        if self._since_s is not None and self._lasts_s >= LEAST_TRY_S:
            self.count += 1
        self._since_s = None

    def struck(self) -> None:
        """A fault has stopped the axis, and has counted these moves and the present one."""
        self.count, self._since_s = 0, None


class LeftBehind:
    """Where the target was while the axis stood. It must follow a moving target from anywhere in its dead band."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """The axis is sent to another place."""
        self._stands_deg = math.inf
        self._low_deg, self._high_deg = math.inf, -math.inf
        self._since_s: float | None = None

    def seconds(
        self, sent_s: float, target_deg: float, place_deg: float, *, moved_deg: float, apart_deg: float
    ) -> float:
        """For how long the target has been `apart_deg` from where it was before, and the axis has not moved."""
        if abs(place_deg - self._stands_deg) >= moved_deg:
            self.begin()
            self._stands_deg = place_deg
        self._low_deg, self._high_deg = min(self._low_deg, target_deg), max(self._high_deg, target_deg)
        if self._high_deg - self._low_deg < apart_deg:
            return 0.0
        self._since_s = sent_s if self._since_s is None else self._since_s
        return sent_s - self._since_s
