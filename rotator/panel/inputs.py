"""What a front panel's switches and knobs mean by themselves: bounce, jitter and doubt taken out.

Knows contacts and moments. Knows no order, no mode's meaning and no hardware. A moment is an argument.
"""

from __future__ import annotations

import math

from hw.ports import Axis, Direction
from rotator.orders import Mode
from rotator.panel.ladder import CENTRE, Throw, thrown

CLOSED_S = 0.05
"""A stop button's contact must have been closed for so long; that it opens is believed at once."""
STILL_S = 1.0
"""A mode switch passes through other positions on its way, and a person through other angles with a knob."""
COUNT = 1.0 / 255.0
"""One count of an eight-bit reading: a knob that jitters by so much stands still."""
_ROUNDING = 1e-9

POSITIONS = (Mode.MANUAL, Mode.PARK, Mode.AUTO, Mode.JOG)
"""By 2 × MSB + LSB; a closed contact is a 1."""

Contact = tuple[Axis, Direction]


class StopButton:
    """A normally closed contact: open is pressed, and so is a broken wire."""

    def __init__(self) -> None:
        self.open = False
        self.closed_s = -math.inf
        """When it was last found closed, after it had been open."""
        self._closing_s: float | None = None

    def see(self, now_s: float, *, is_open: bool) -> bool:
        """Whether it has just opened."""
        if is_open:
            opened, self.open, self._closing_s = not self.open, True, None
            return opened
        if self.open:
            self._closing_s = now_s if self._closing_s is None else self._closing_s
            if now_s - self._closing_s >= CLOSED_S - _ROUNDING:
                self.open, self.closed_s = False, now_s
        return False


class ModeSwitch:
    def __init__(self) -> None:
        self.position: Mode | None = None
        """Where it stands now; None: it cannot be read, or there is none."""
        self.since_s = math.inf
        """Since when it has stood there."""
        self.mode: Mode | None = None
        """Where it last stood still for STILL_S."""

    @property
    def still(self) -> bool:
        return self.position is not None and self.position is self.mode

    def see(self, now_s: float, bits: tuple[bool, bool] | None) -> bool:
        """Whether somebody has turned it: it has come to rest at another place than before. `bits` are MSB and LSB."""
        position = None if bits is None else POSITIONS[2 * bits[0] + bits[1]]
        if position is not self.position:
            self.position, self.since_s = position, now_s
        if position is None or position is self.mode or now_s - self.since_s < STILL_S - _ROUNDING:
            return False
        before, self.mode = self.mode, position
        return before is not None


class JogSwitches:
    """Two centre-off switches. A press begins from both at the centre, with one of them, seen so twice running.

    It ends with the first look that says anything else: let go, the other switch too, a reading in no band. To begin
    another, both must have been at the centre; so two at once, or one held for long, are never two presses.
    """

    def __init__(self) -> None:
        self.held: Contact | None = None
        self._armed = False
        self._before: Throw | None = None

    def see(self, share: float | None, *, may_begin: bool) -> bool:
        """Whether a press has just begun. Where none `may_begin`, one that is held ends, and is not taken up again."""
        throw = None if share is None else thrown(share)
        alike, self._before = throw == self._before, throw
        contact = _one(throw)
        if self.held is not None:
            if contact != self.held or not may_begin:
                self.held = None
            return False
        if not alike:  # a contact that moves while it is converted reads as anything
            return False
        begins = contact is not None and self._armed and may_begin
        self._armed = throw == CENTRE
        self.held = contact if begins else None
        return begins


def _one(throw: Throw | None) -> Contact | None:
    match throw:
        case (direction, Direction.OFF) if direction is not Direction.OFF:
            return Axis.AZIMUTH, direction
        case (Direction.OFF, direction) if direction is not Direction.OFF:
            return Axis.ELEVATION, direction
        case _:
            return None


class Knob:
    """A pot that a person turns. One that folds over near its end, reading less the further it is turned, has too large
    a time constant where it is read: a smaller capacitor at its wiper cures that, nothing here can.
    """

    def __init__(self, full_scale: float = 1.0) -> None:
        self.full_scale = full_scale
        """What it reads at its maximum, as a share of its supply."""
        self.share: float | None = None
        """How far it is turned, 0 to 1; None: it cannot be read, or there is none."""
        self._moved_s = -math.inf
        self._rest: float | None = None

    def still(self, now_s: float) -> bool:
        """It has not been turned for STILL_S."""
        return now_s - self._moved_s >= STILL_S - _ROUNDING

    def see(self, now_s: float, reading: float | None) -> bool:
        """Whether it is being turned. `reading` is the share of its supply; one that comes back was not turned."""
        if reading is None:
            self.share = self._rest = None
            return False
        self.share = min(max(reading / self.full_scale, 0.0), 1.0)
        if self._rest is None:
            self._rest = self.share
        if abs(self.share - self._rest) <= COUNT + _ROUNDING:
            return False
        self._rest, self._moved_s = self.share, now_s
        return True
