"""The state of each switch and knob of a front panel, without bounce and jitter.

Knows contacts and readings over time; the time is an argument. Does not know orders, the meaning of modes, or hardware.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from statistics import median

from hw.ports import Axis, Direction
from rotator.exchange.orders import Mode
from rotator.panel.ladder import CENTRE, Throw, thrown

CLOSED_S = 0.05
"""Seconds for which a stop button's contact must be closed to count as released. An open contact counts at once."""
STILL_S = 1.0
"""Seconds at rest before a mode switch or a knob counts: on its way it passes through other positions."""
COUNT = 1.0 / 255.0
"""One count of an eight-bit reading. A knob that changes by at most this stands still."""
SPARK_READINGS = 5
"""Readings in the median that gives the knob's place. Two wrong ones among them, for example from a spark, do not
change it."""
LAG_S = 0.1
"""Seconds until a turn shows in the median."""
LEAST_READINGS = 10
"""Least number of readings in STILL_S to know that a knob stands."""
NOISES = 1.8
"""Times the scatter of its readings: by less than this a knob does not turn."""
USUAL = 0.6
"""A bend is the distance of a reading from the line through its neighbours; a steady turn has none. The scatter is the
largest bend of this share, the smallest bends. The others may be sparks."""
SPREADS = 1.5
"""Times the spread of its readings at rest: only beyond this a knob rests at another place."""
DRIFT = 1e-5
"""Allowed drift at rest from one reading to the next, as a wire warms: 1.2 % of the turn in a minute."""
MIDDLE = 0.1
"""Share of the lowest and of the highest readings that the spread leaves out."""
SPREAD_KEPT = 0.99
"""Factor of the kept spread from one reading to the next: half of it is forgotten in three seconds."""
_ROUNDING = 1e-9

POSITIONS = (Mode.MANUAL, Mode.PARK, Mode.AUTO, Mode.JOG)
"""The index is 2 × MSB + LSB; a closed contact is a 1."""

Contact = tuple[Axis, Direction]


class StopButton:
    """A normally closed contact: an open contact or a broken wire means pressed."""

    def __init__(self) -> None:
        self.open = False
        self.closed_s = -math.inf
        """When the button was last released."""
        self._closing_s: float | None = None

    def see(self, now_s: float, *, is_open: bool) -> bool:
        """Returns whether the button was just pressed."""
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
        """The present position; None: not readable, or not fitted."""
        self.since_s = math.inf
        """Since when the switch is in this position."""
        self.mode: Mode | None = None
        """The last position that it held for STILL_S."""

    @property
    def still(self) -> bool:
        return self.position is not None and self.position is self.mode

    def see(self, now_s: float, bits: tuple[bool, bool] | None) -> bool:
        """Returns whether the operator has turned it: it rests in a new position. `bits` are MSB and LSB."""
        position = None if bits is None else POSITIONS[2 * bits[0] + bits[1]]
        if position is not self.position:
            self.position, self.since_s = position, now_s
        if position is None or position is self.mode or now_s - self.since_s < STILL_S - _ROUNDING:
            return False
        before, self.mode = self.mode, position
        return before is not None


class JogSwitches:
    """Two centre-off switches. A press begins when both were at the centre and two readings show one of them thrown.

    The press ends with the first other reading: released, both switches thrown, or a reading in no band. Before the
    next press both must be at the centre. So two switches at once, or one held for long, are never two presses.
    """

    def __init__(self) -> None:
        self.held: Contact | None = None
        self._armed = False
        self._before: Throw | None = None

    def see(self, share: float | None, *, may_begin: bool) -> bool:
        """Returns whether a press has just begun. Without `may_begin` a held press ends and cannot begin again."""
        throw = None if share is None else thrown(share)
        repeated, self._before = throw == self._before, throw
        contact = _one(throw)
        if self.held is not None:
            if contact != self.held or not may_begin:
                self.held = None
            return False
        if not repeated:  # a contact that moves during the conversion gives any reading
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


@dataclass(frozen=True, slots=True)
class KnobWiring:
    """Limits of a knob's readings, as shares of its supply. Defaults: without end resistors no broken wire is seen."""

    lowest: float = -0.1
    """A reading below this means a broken wire, which the wiper's pull-down takes to 0."""
    highest: float = 1.1
    """A reading above this means that its ground wire is broken."""
    zero: float = 0.0
    """The reading at its minimum."""


class Knob:
    """A pot that the operator turns. A reading outside its window is not used: a wire is broken.

    If a pot reads less near its end although it is turned further, the time constant at its input is too large: fit a
    smaller capacitor at its wiper. Software cannot correct that.
    """

    def __init__(self, wiring: KnobWiring, full_scale: float | None = None) -> None:
        self._wiring = wiring
        self.full_scale = 1.0 - wiring.zero if full_scale is None else full_scale
        """The reading at its maximum, as a share of its supply."""
        self.trouble = ""
        """Why the reading is not used; empty: it is in its window, or there is no reading."""
        self.share: float | None = None
        """How far the knob is turned, 0 to 1; None: not readable, or not fitted."""
        self.rest: float | None = None
        """The last place of rest, as a share of the turn; None: not seen at rest yet."""
        self._latest: deque[tuple[float, float]] = deque()
        """The readings of the last STILL_S, each with its time."""
        self._turned_to = 0.0
        """The place at the last seen turn, at `_turned_s`."""
        self._turned_s = math.inf
        self._turned = False
        """Whether the knob was seen to turn since the last rest."""
        self._spread = 0.0
        """The recent spread of its readings at rest."""

    def still(self, now_s: float) -> bool:
        """Whether the knob was read, and not turned, for STILL_S."""
        return now_s - self._turned_s >= STILL_S - LAG_S - _ROUNDING and len(self._latest) >= LEAST_READINGS

    def see(self, now_s: float, reading: float | None) -> bool:
        """Returns whether it is being turned. `reading` is a share of its supply. A knob that can be read again after a
        gap has not been turned."""
        self.trouble = self._wrong(reading)
        if reading is None or self.trouble:
            self.share = self.rest = None
            self._latest.clear()
            self._spread = 0.0
            return False
        zero = self._wiring.zero
        self.share = min(max((reading - zero) / (self.full_scale - zero), 0.0), 1.0)
        if not self._latest:
            self._turned_to, self._turned_s = self.share, now_s
        self._latest.append((now_s, self.share))
        while now_s - self._latest[0][0] > STILL_S:
            self._latest.popleft()
        shares = [share for _, share in self._latest]
        least = max(COUNT, NOISES * _scatter(shares)) + _ROUNDING
        place = median(shares[-SPARK_READINGS:])
        turns = abs(place - self._turned_to) > least
        if not turns and self.still(now_s):
            turns = self._turned_unseen(shares, least)
        if turns:
            self._turned_to, self._turned_s, self._turned = place, now_s, True
        return turns and self.rest is not None

    def _turned_unseen(self, shares: list[float], least: float) -> bool:
        """Whether the knob rests at another place though no turn was seen: it turned very slowly, or with many sparks.
        Readings that only scattered or sparked do not change the last place of rest."""
        self._spread = max(self._spread * SPREAD_KEPT, _spread(shares[:-SPARK_READINGS]))
        place = median(shares)
        off = 0.0 if self.rest is None else place - self.rest
        elsewhere = abs(off) > max(least, SPREADS * self._spread)
        if elsewhere and not self._turned:
            return True
        if self.rest is None or elsewhere:
            self.rest = place
        elif not self._turned:
            self.rest += min(max(off, -DRIFT), DRIFT)
        self._turned = False
        return False

    def _wrong(self, reading: float | None) -> str:
        low, high = self._wiring.lowest, self._wiring.highest
        return "" if reading is None or low <= reading <= high else f"reads {reading:.3f}, limit {low:g} to {high:g}"


def _scatter(shares: list[float]) -> float:
    """The usual distance of a reading from the line through its neighbours, without sparks."""
    bends = sorted(
        abs(before - 2.0 * at + after) for before, at, after in zip(shares, shares[1:], shares[2:], strict=False)
    )
    return bends[math.ceil(USUAL * len(bends)) - 1] if bends else 0.0


def _spread(shares: list[float]) -> float:
    """The range of the readings, without the lowest and the highest."""
    without = math.ceil(MIDDLE * len(shares))
    middle = sorted(shares)[without : len(shares) - without]
    return middle[-1] - middle[0]
