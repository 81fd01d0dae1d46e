"""A receiver behind an antenna: how strong it hears a source beside which the boom points.

Knows a beam with side lobes, the floor of noise, fading (QSB) and a meter of whole decibels. Knows no socket.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

HALF_POWER = 1.3916
"""Where (sin u / u)² is a half."""
FLOOR_DB = -48.0
"""What the meter tells of noise alone: S1."""


@dataclass(frozen=True, slots=True)
class ReceiverSpec:
    beam_deg: float = 20.0
    """From edge to edge at half power."""
    signal_db: float = 18.0
    """In the middle of the beam, above the noise."""
    noise_db: float = 0.7
    """Of each reading, rms."""
    fading_db: float = 1.5
    """How deep the signal fades, rms."""
    fading_s: float = 6.0
    """How long a fade lasts."""
    step_db: float = 1.0


class SimReceiver:
    """`off_deg` tells how far the boom points from the source."""

    def __init__(
        self, spec: ReceiverSpec, clock: Callable[[], float], off_deg: Callable[[], float], seed: int = 0
    ) -> None:
        self._spec, self._clock, self._off_deg = spec, clock, off_deg
        self._chance = random.Random(seed)
        self._fade, self._heard_s = self._chance.gauss(0.0, 1.0), clock()

    def strength_db(self) -> float:
        """As its meter tells it: 0 is S9."""
        spec = self._spec
        signal = 10 ** ((spec.signal_db + self._faded_db()) / 10) * beam(self._off_deg(), spec.beam_deg)
        heard_db = FLOOR_DB + 10 * math.log10(1.0 + signal) + self._chance.gauss(0.0, spec.noise_db)
        return round(heard_db / spec.step_db) * spec.step_db

    def _faded_db(self) -> float:
        now_s, spec = self._clock(), self._spec
        stays = math.exp(-(now_s - self._heard_s) / spec.fading_s)
        self._fade = stays * self._fade + math.sqrt(1 - stays**2) * self._chance.gauss(0.0, 1.0)
        self._heard_s = now_s
        return spec.fading_db * self._fade


def beam(off_deg: float, beam_deg: float) -> float:
    """The part of the power that comes in so far beside the middle, with the side lobes of an even aperture."""
    u = 2 * HALF_POWER * off_deg / beam_deg
    return (math.sin(u) / u) ** 2 if abs(u) > 1e-6 else 1.0
