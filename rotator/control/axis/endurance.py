"""How long a motor may run, and how long it must then rest before its winding is cool again.

Knows when the motor ran. Knows no temperature: there is no sensor for it. Does not know why the motor runs.
"""

from __future__ import annotations

from rotator.exchange.faults import Notice

RESUME_SHARE = 0.5
"""A motor that had to rest may run again when it has cooled to this share, after half of its rest."""


class Endurance:
    """A leaky bucket: running fills it in `longest_run_s`, standing empties it in `rest_s`. Zero: no limit."""

    def __init__(self, longest_run_s: float, rest_s: float) -> None:
        self._longest_run_s = longest_run_s
        self._cooling = longest_run_s / rest_s if rest_s > 0 else float("inf")
        self._heat_s = 0.0
        self._at_s: float | None = None
        self._running = False
        self.resting = False
        """The motor has run for too long, and must not be started now."""

    def note(self, now_s: float, *, running: bool) -> None:
        """What the motor does from now on."""
        if self._longest_run_s <= 0:
            return
        if self._at_s is not None:
            passed_s = now_s - self._at_s
            self._heat_s += passed_s if self._running else -passed_s * self._cooling
            self._heat_s = max(0.0, self._heat_s)
        self._at_s, self._running = now_s, running
        if self._heat_s >= self._longest_run_s:
            self.resting = True
        elif self._heat_s <= RESUME_SHARE * self._longest_run_s:
            self.resting = False

    @property
    def notice(self) -> Notice | None:
        """Why the motor does not move; None while it may run."""
        if not self.resting:
            return None
        return Notice(f"motor hot: it has run for {self._longest_run_s:g} s and has to rest", "MOTOR HOT")
