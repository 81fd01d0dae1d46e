"""What the rotor does once, on request: acknowledge a fault, take an angle, let go of motors. Says what it refused.

Knows errands, moments and the words for a person. Does not repeat an errand: the axis may stand elsewhere by then.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable

from hw.ports import HardwareError
from rotator.control.commands import Acknowledge, Errand, Place, Turns
from rotator.rotors.port import Rotor

log = logging.getLogger(__name__)

SHOWN_S = 60.0
"""The status says for this time that an errand has failed."""


class Errands:
    def __init__(self, rotor: Rotor) -> None:
        self._rotor = rotor
        self._failed: dict[str, tuple[float, str]] = {}
        """By errand in words: when it last failed, and why."""

    def run(self, errands: Iterable[Errand], now_s: float) -> None:
        """Carry the errands out. A refused one is logged and in `notices`: the answer to its order was sent before."""
        for errand in errands:
            failure = _failure(errand)
            try:
                self._rotor.run(errand)
                self._failed.pop(failure, None)
            except HardwareError as fault:
                log.error("%s: %s", failure, fault)
                self._failed[failure] = (now_s, str(fault))

    def notices(self, now_s: float) -> tuple[str, ...]:
        """What has failed lately, for the status."""
        if not self._failed:
            return ()
        self._failed = {failure: failed for failure, failed in self._failed.items() if now_s - failed[0] < SHOWN_S}
        return tuple(f"{failure}: {why}" for failure, (_, why) in self._failed.items())


def _failure(errand: Errand) -> str:
    """The failure of this errand, in words for a person."""
    match errand:
        case Acknowledge(axis):
            return f"the fault of {axis.value} is not acknowledged"
        case Place(axis):
            return f"{axis.value} has not taken the angle"
        case Turns(axis):
            return f"{axis.value}'s brake may engage while it turns"
        case _:
            return "the motors may still have their torque"
