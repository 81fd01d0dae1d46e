"""How a sensor board is mounted: which of its arrows points along the boom, and which points up.

Knows axes and signs. Knows no chip.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import BoardAxes

_AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, slots=True)
class Mounting:
    """The arrow on the board that points along the boom, and the arrow that points up while the boom is level.

    An arrow is an axis with its sign: `+x`, `-z`, ...

    Raises ValueError for an unknown arrow, or two arrows of one axis.
    """

    forward: str = "+x"
    up: str = "+z"

    def __post_init__(self) -> None:
        for name, arrow in (("forward", self.forward), ("up", self.up)):
            if len(arrow) != 2 or arrow[0] not in "+-" or arrow[1] not in _AXES:
                raise ValueError(f"{name} is {arrow!r}; write +x, -x, +y, -y, +z or -z")
        if self.forward[1] == self.up[1]:
            raise ValueError(
                f"forward {self.forward} and up {self.up} are the same axis; look at the arrows on the board"
            )

    def upright(self, board: BoardAxes) -> tuple[float, float]:
        """What the board measures along the boom and across it, in the plane in which the boom rises."""
        return _along(self.forward, board), _along(self.up, board)

    def level(self, board: BoardAxes) -> tuple[float, float]:
        """What the board measures along the boom and to its left, in the plane in which the mast turns."""
        ahead, up = _AXES[self.forward[1]], _AXES[self.up[1]]
        # The three axes of a chip are a right-handed system: left is up × forward.
        in_order = (up + 1) % 3 == ahead
        left = board[3 - ahead - up]
        return _along(self.forward, board), left if in_order == (self.forward[0] == self.up[0]) else -left


def _along(arrow: str, board: BoardAxes) -> float:
    part = board[_AXES[arrow[1]]]
    return part if arrow[0] == "+" else -part
