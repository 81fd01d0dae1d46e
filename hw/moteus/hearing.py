"""Whether one controller answers: its latest answer, and how long it was silent before that and since.

Knows moments, in seconds. Does not know what an answer means, nor which order it answers.
"""

from __future__ import annotations

import math

from hw.moteus.orders import Answer


class Hearing:
    def __init__(self) -> None:
        self.answer: Answer | None = None
        """The latest answer; None: none has come yet."""
        self.missed = True
        """Whether the latest order was not answered."""
        self.misses = 0
        """The number of orders without an answer since the start."""
        self.gap_s = 0.0
        """Seconds of silence before the latest answer."""
        self.came_back = False
        """Whether the order before the latest answer was not answered."""
        self.asked_s = -math.inf
        """When the order went out that the latest answer answers: its position is of no earlier moment."""
        self._heard_s = self._ordered_s = -math.inf

    def silent_s(self, now_s: float) -> float:
        """Seconds since its last answer; infinite: it never answered."""
        return now_s - self._heard_s

    def ordered(self, now_s: float) -> None:
        """An order goes out."""
        self._ordered_s = now_s

    def note(self, answer: Answer, now_s: float) -> None:
        self.asked_s = self._ordered_s
        self.came_back = self.missed and self.answer is not None
        self.gap_s = self.silent_s(now_s)
        self.answer, self._heard_s, self.missed = answer, now_s, False

    def note_miss(self) -> None:
        """The latest order was not answered."""
        self.missed = True
        self.misses += 1
