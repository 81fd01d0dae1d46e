"""A simulated AS5045: a magnet over a chip of twelve bits a turn, with its synchronous serial interface.

Knows the 18 bits of an answer and when they come (austriamicrosystems AS5045, figures 5 and 6, tables 3 and 5). Not
simulated: the outputs PWM and MagINCn, a magnet that is pushed or pulled, programming, a daisy chain, and the
time that a chip needs to start.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from firmware_sim.chips.magnet import OverMagnet
from firmware_sim.chips.shifted import Shifted

GREEN_MT, YELLOW_MT = (45.0, 75.0), (25.0, 135.0)
OCF, COF, LIN, MAG_INC, MAG_DEC = 0b100000, 0b010000, 0b001000, 0b000100, 0b000010


class As5045(OverMagnet, Shifted):
    latches_at_fall = True

    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.03, noise: random.Random | None = None
    ) -> None:
        OverMagnet.__init__(self, turn, noise_deg_rms=noise_deg_rms, noise=noise)
        Shifted.__init__(self)
        self.started = True
        """False: the offsets are not compensated yet."""

    def answer(self) -> tuple[int, int]:
        status = OCF if self.started else 0
        if not GREEN_MT[0] <= self.field_mt <= GREEN_MT[1]:
            status |= MAG_INC | MAG_DEC
        if not YELLOW_MT[0] <= self.field_mt <= YELLOW_MT[1]:
            status |= LIN
        word = self.steps(1 << 12) << 6 | status
        return word | word.bit_count() % 2, 18
