"""Something that goes wrong now and then: each n-th time, or by chance as often, and for how many times in a row.

Knows a count. Does not know what goes wrong: a part asks `strikes` each time it is used.
"""

from __future__ import annotations

import random


class Sporadic:
    """`in_a_row`: how many times it lasts. `chance`: it strikes at random, each n-th time on average."""

    def __init__(self, in_a_row: int = 1, chance: random.Random | None = None) -> None:
        self.every = 0
        """It begins each so many times; 0: never."""
        self._in_a_row = in_a_row
        self._chance = chance
        self._count = 0
        self._left = 0

    def strikes(self) -> bool:
        """Whether it goes wrong this time."""
        if not self.every:
            self._count = self._left = 0
            return False
        if not self._left and self._begins():
            self._left = self._in_a_row
        if not self._left:
            return False
        self._left -= 1
        return True

    def _begins(self) -> bool:
        if self._chance is not None:
            return self._chance.random() * self.every < 1.0
        self._count = (self._count + 1) % self.every
        return self._count == 0
