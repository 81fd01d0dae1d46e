"""Presses that do not turn an axis without a calibration, by its raw readings: it may stand at its stop.

Knows the readings, in degrees of the sensor's span, and how long the relays were on. Such an axis has no angle and no
limits; only whether a press has moved it can be seen. Stops nothing: the person who presses decides.
"""

from __future__ import annotations

from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.smoothing import SETTLES_S, Smoothed
from rotator.exchange.faults import Notice

ENOUGH_PRESSES, ENOUGH_S = 3, 1.0
"""An axis is pressed in vain after this many presses in a row, and this time in all, that did not move it."""
LONG_S = 4.5
"""Or after this time in all: presses that follow each other without a pause look like one."""
MOVED_DEG, MOVED_NOISES = 0.3, 4.0
"""An axis has moved when it is further from where it stood than this angle, and than this many times the noise."""
IN_VAIN = Notice(
    "presses did not move it: a program turns it again after a person has turned it, or after `resume`", "NOT TURNING"
)


class VainPresses:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time."""

    def __init__(self, *, before: bool = False) -> None:
        """`before`: presses did not turn the axis in an earlier run of the program."""
        self._smoothed = Smoothed()
        self.forget()
        if before:
            self._count, self._pressed_s = ENOUGH_PRESSES, ENOUGH_S

    def forget(self) -> None:
        """A person has looked."""
        self._count, self._pressed_s, self._present_s = 0, 0.0, 0.0
        self._stands_deg: float | None = None
        """Where the axis stood when the first of these presses began."""
        self._since_s: float | None = None
        """When the present press began; None: no relay is on."""
        self._ended_s: float | None = None
        """When the last press ended; None: it has been counted."""
        self._moved = False
        """The present press has moved it."""

    @property
    def enough(self) -> bool:
        """Whether the axis has been pressed in vain often enough, or for long enough, for the note."""
        long = self._pressed_s + self._present_s >= LONG_S
        return long or (self._count >= ENOUGH_PRESSES and self._pressed_s >= ENOUGH_S)

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed. A reversal goes on with the press."""
        if not relays.closed:
            if self._since_s is not None and not self._moved:
                self._pressed_s += relays.since_s - self._since_s
                self._ended_s = relays.since_s
            self._since_s, self._moved, self._present_s = None, False, 0.0
        elif self._since_s is None:
            self._counted()
            self._since_s = relays.since_s
            if self._stands_deg is None:
                self._stands_deg = self._smoothed.mean_deg

    def see(self, at_s: float, place_deg: float, noise_deg: float) -> None:
        """A good reading. `noise_deg`: the scatter of the readings, rms."""
        self._smoothed.see(place_deg)
        if self._stands_deg is None or self._smoothed.mean_deg is None:
            return
        if abs(self._smoothed.mean_deg - self._stands_deg) >= max(MOVED_DEG, MOVED_NOISES * noise_deg):
            self._count, self._pressed_s, self._stands_deg, self._ended_s = 0, 0.0, self._smoothed.mean_deg, None
            self._moved, self._present_s = self._since_s is not None, 0.0
        elif self._since_s is not None and not self._moved:
            self._present_s = at_s - self._since_s
        elif self._ended_s is not None and at_s - self._ended_s >= SETTLES_S:
            self._counted()

    def _counted(self) -> None:
        """The last press is over, and has not moved it."""
        self._count += self._ended_s is not None
        self._ended_s = None
