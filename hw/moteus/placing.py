"""The turn in which an axis stands: whether a controller's position is right after power-on, silence or a restart.

Knows home states, the two kinds of encoder, and the range of the axis. Knows no orders: the caller gives the controller
the position that `see` returns.

After power-on a controller knows its angle within one turn at most, of the motor or of the antenna: 270° comes back as
-90°. The turn is the one that lies in the axis's range. If two turns lie in it (45° and 405° of 450°), or none, a
person has to say which.
"""

from __future__ import annotations

import math

from hw.moteus.orders import Answer, Home, Mode, MoteusSpec

BEYOND_DEG = 5.0
"""Degrees that an antenna without power may be pushed beyond its range. This near to an end, both ends of a full
circle are possible."""
CONTRADICTS_DEG = 90.0
"""Degrees: a person's eye is better than this."""
SAME_TURN_REV = 0.5
"""Turns of the antenna: two successive answers that differ by less are in the same turn. No antenna is so fast."""
MOVED = (Mode.POSITION, Mode.TIMEOUT)
"""In these modes a program has moved the controller since power-on, and that program knew its position."""
LOST = "was switched on and does not know which way the antenna points: look at the antenna and confirm its angle"


class Placing:
    """Pass every answer to `see`; `angle_deg` is right while `unknown` is empty."""

    def __init__(self, spec: MoteusSpec) -> None:
        self._spec = spec
        self.unknown = LOST
        """Why the angle is not known, as the end of a sentence; empty: it is known."""
        self.given_rev: float | None = None
        """The position that must still be given to the controller as its present one; None: its position is right."""
        self._shift_rev = 0.0
        """The error of its present position: what must be added."""
        self._last_rev = math.nan
        """The position of the last answer; NaN: no answer, or a person has changed the scale since."""
        self._first = True
        """Whether no answer has come yet in this run of the program."""

    def angle_deg(self, answer: Answer) -> float:
        return self._spec.degrees(answer.position_rev + self._shift_rev)

    def see(self, answer: Answer) -> float | None:
        """Take an answer. Returns the position to give to the controller; None: none is needed."""
        if not math.isfinite(answer.position_rev):
            self._lose("has no position: check its encoder")
        elif self.given_rev is not None and self._took(answer, self.given_rev):
            self.given_rev, self._shift_rev = None, 0.0
        elif not self._goes_on(answer):
            self._find(answer)
        elif self.given_rev is not None:
            self.given_rev = answer.position_rev + self._shift_rev
        self._last_rev, self._first = answer.position_rev, False
        return self.given_rev

    def doubt(self) -> None:
        """A person or a sensor will give its angle. Forget the turn that the controller has not got yet."""
        if self.given_rev is not None:
            self._lose(LOST)

    def confirmed(self) -> None:
        """The controller has taken the angle from a person or a sensor. Its next position is right."""
        self.unknown, self.given_rev, self._shift_rev, self._last_rev = "", None, 0.0, math.nan

    def agreed_deg(self, answer: Answer, angle_deg: float) -> float | None:
        """The exact angle when a person sees the antenna at `angle_deg`; None: the encoder contradicts.

        An encoder that knows the angle within a turn needs only the turn.
        """
        if self._spec.geared or answer.home == Home.RELATIVE or not math.isfinite(answer.position_rev):
            return angle_deg
        off_deg = math.remainder(self._spec.degrees(answer.position_rev) - angle_deg, 360.0)
        return None if abs(off_deg) > CONTRADICTS_DEG else angle_deg + off_deg

    def _goes_on(self, answer: Answer) -> bool:
        """Whether this position and the last one are on the same turn of the same scale."""
        if self.unknown or (answer.home != Home.OUTPUT and self.given_rev is None):
            return False
        if math.isnan(self._last_rev):
            return True
        return abs(answer.position_rev - self._last_rev) < self._spec.span_rev(360.0) * SAME_TURN_REV

    def _took(self, answer: Answer, given_rev: float) -> bool:
        """Whether the controller has taken the position. An answer older than the order has the old state or turn."""
        near = abs(answer.position_rev - given_rev) < self._spec.span_rev(360.0) * SAME_TURN_REV
        return answer.home == Home.OUTPUT and near

    def _find(self, answer: Answer) -> None:
        """Find the turn from the first answer after power-on, or after the program began."""
        shown_deg = self._spec.degrees(answer.position_rev)
        fitting = self._spec.turns_deg(shown_deg, BEYOND_DEG)
        if answer.home == Home.RELATIVE or (answer.home == Home.ROTOR and self._spec.geared):
            self._lose(LOST)
        elif self._first and shown_deg in fitting and self._settled_before(answer):
            self.unknown = ""
        elif self._spec.geared:
            # First answer: an impossible place. Later answer: another place, because the controller lost its supply.
            self._lose(self._outside(shown_deg) if self._first else self.unknown or LOST)
        elif len(fitting) == 1:
            self._lose("")
            if answer.home != Home.OUTPUT or fitting[0] != shown_deg:
                self.given_rev = self._spec.revolutions(fitting[0])
                self._shift_rev = self.given_rev - answer.position_rev
        elif fitting:
            places = " or at ".join(f"{angle_deg:.0f}°" for angle_deg in fitting)
            self._lose(
                f"was switched on and knows its angle, and not the turn: the antenna stands at {places}: look at its "
                "cables and confirm which"
            )
        else:
            self._lose(self._outside(shown_deg))

    def _settled_before(self, answer: Answer) -> bool:
        """Whether, before this run, a person confirmed the angle or a program moved the axis."""
        return answer.home == Home.OUTPUT and (self._spec.geared or answer.mode in MOVED)

    def _outside(self, shown_deg: float) -> str:
        spec = self._spec
        return f"shows {shown_deg:.0f}°, outside of {spec.min_deg:g}° to {spec.max_deg:g}°: look, and confirm its angle"

    def _lose(self, why: str) -> None:
        self.unknown, self.given_rev, self._shift_rev = why, None, 0.0
