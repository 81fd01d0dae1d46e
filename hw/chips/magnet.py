"""What the chips that read the angle of a magnet share: a share of a turn, and what is said of a bad magnet or answer.

Knows no register. Does not know gears: when the magnet turns more than once over the axis's range, the reading repeats.
"""

from __future__ import annotations

from enum import Enum

from hw.ports import AngleSource, HardwareError

SILENT = "does not answer; look at its supply, and at the wires of select, clock and data"
GARBLED = "the answer arrives with errors; shorten the cable, and keep it away from the motors' wires"


class Magnet(Enum):
    """What a chip says of its magnet. The values are for the user."""

    GOOD = ""
    MISSING = "there is no magnet; put one over the middle of the chip, 0.5 to 3 mm away"
    WEAK = "the magnet is too weak or too far; bring it nearer, or take one magnetized across"
    STRONG = "the magnet is too strong or too near; move it away a little"
    FAINT = "there is no magnet, or it is too far or too weak; put one, magnetized across, over the middle of the chip"
    UNFIT = (
        "the magnet is missing, too far, too near, or beside the middle of the chip; put one, magnetized across, over "
        "the middle, 0.5 to 3 mm away"
    )


class MagneticEncoder:
    """One chip as a `hw.ports.AngleSensor`. `zero_turn`, 0 to 1, is where the reading jumps from 1 to 0: set it outside
    the axis's range. A calibration is valid for one `zero_turn` only.
    """

    source = AngleSource.MEASURED

    def __init__(self, name: str, steps: int, zero_turn: float) -> None:
        self._name = name
        self._steps = steps
        self._zero_turn = zero_turn

    def read(self) -> float:
        """The share of a turn, 0 up to 1, in the chip's steps.

        Raises HardwareError when the chip does not answer, its answer makes no sense, or its magnet is not good.
        """
        angle, magnet = self._look()
        if magnet is not Magnet.GOOD:
            raise self._error(magnet.value)
        return (angle / self._steps - self._zero_turn) % 1.0

    def _look(self) -> tuple[int, Magnet]:
        """The angle in steps, and the chip's opinion of its magnet at that moment. Raises HardwareError."""
        raise NotImplementedError

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"{self._name}: {text}")


def even(word: int) -> bool:
    """Whether the number of ones is even: the parity of these chips."""
    return word.bit_count() % 2 == 0
