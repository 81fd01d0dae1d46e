"""Whether a switched motor may do what its axis wants of it at this moment.

Knows what can forbid a run: a relay in doubt, a limit, a limit switch, the motor's heat, a control cycle that came too
late. Does not know the goal.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from hw.ports import Direction
from rotator.control.axis.relay_faults import limit_reached
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import BOTH_WAYS, RelayState
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Feed, Run
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Notice

LAPSED_S = 1.0
"""After a late cycle the relay stays open this long, so that a slow computer does not make the relay chatter."""
RESUME_SHARE = 0.5
"""A motor that had to rest may run again when it has cooled to this share, after half of its rest."""


def at_ends(angle_deg: float, limits: Range) -> tuple[Direction, ...]:
    """The directions in which an axis at this angle is at its limit, or past it."""
    beyond = angle_deg >= limits.max_deg, angle_deg <= limits.min_deg
    return tuple(way for way, there in zip(BOTH_WAYS, beyond, strict=True) if there)


class Endurance:
    """A leaky bucket: running fills it in `longest_run_s`, standing empties it in `rest_s`. Zero: no limit. There is no
    sensor for the heat."""

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


class RunPermit:
    """Ask it (`permitted`) in every cycle, and tell it after each cycle what the relays do (`note_relays`)."""

    def __init__(self, settings: SwitchedSettings, gate: RelayGate, *, lease_s: float) -> None:
        self._axis = settings.axis
        self._gate = gate
        self._lease_s = lease_s
        self._endurance = Endurance(settings.longest_run_s, settings.rest_s)
        self._relays = RelayState()
        self._lapsed_s = -math.inf
        """When a cycle last came so late that the lease had opened the relay of a running motor."""

    @property
    def cooling(self) -> bool:
        return self._endurance.resting

    @property
    def notice(self) -> Notice | None:
        """Why the motor has to rest; None: it may run."""
        return self._endurance.notice

    def note_relays(self, now_s: float, relays: RelayState) -> None:
        self._relays = relays
        self._endurance.note(now_s, running=relays.closed)

    def permitted(
        self, run: Run, now_s: float, past_s: float, *, ends: Collection[Direction], switches: Collection[Direction]
    ) -> Run | Feed | Fault | None:
        """The run, or what is done while it waits. A fault: why it is forbidden. None: the motor has to rest.

        `past_s`: since the cycle before. `ends`: directions in which the axis is at its limit. `switches`: directions
        whose limit switch is open.
        """
        if past_s > self._lease_s and self._relays.closed:
            self._lapsed_s = now_s
        found = self._judged(run, now_s, ends, switches)
        if found is None or isinstance(found, Fault):
            self._gate.rests()
        return found

    def _judged(
        self, run: Run, now_s: float, ends: Collection[Direction], switches: Collection[Direction]
    ) -> Run | Feed | Fault | None:
        if run.direction is Direction.OFF:
            self._gate.rests()
            return run
        if now_s < self._lapsed_s + LAPSED_S:
            return None
        if (suspected := self._gate.accuse(run.direction)) is not None:
            return suspected
        if run.direction in switches:
            return limit_reached(self._axis, run.direction)
        if self._endurance.resting or run.direction in ends:
            return None
        return self._gate.passed(run, now_s)
