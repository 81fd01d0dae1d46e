"""One axis of a rotor: relay contacts, motor, gear play, end stops.

Knows mechanics: the delay of a contact, how a motor gathers speed and coasts, the backlash, the end stops, a brake, and
the faults of contacts and motor. Knows no volts, no GPIO line and no protocol. Motion between two contact changes is a
closed formula, so the result does not depend on how often `advance` is called.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from firmware_sim.parts.brake import SimBrake

JOLT_SHARE = 0.05
"""A shaft slower than this share of its motor's speed stands, for a wedge that falls."""


@dataclass(frozen=True, slots=True)
class MotorSpec:
    """A motor with its gear. The motor is a first-order lag: switched off at full speed it coasts speed x lag."""

    speed_dps: float
    lag_s: float
    relay_delay_s: float
    """Delay of a contact after its coil."""
    backlash_deg: float
    """Total play between the shaft (where the pot sits) and the boom (where the antenna is)."""
    stop_low_deg: float
    stop_high_deg: float


Stretch = Callable[[float, float, Callable[[float], float]], None]
"""A listener for a turn of the shaft in one direction. It gets the moment of the beginning in seconds, the duration in
seconds, and a function from seconds since the beginning to the shaft's angle in degrees."""


class SimMotor:
    """A motor behind two relay contacts. Call `coils` when a coil changes, and `advance` before you read an angle."""

    def __init__(self, spec: MotorSpec, start_deg: float, now_s: float) -> None:
        self.spec = spec
        self.shaft_deg = start_deg
        self.boom_deg = start_deg
        self.speed_dps = 0.0
        self.drive = 0
        """How the contacts feed the motor: -1, 0, 1."""
        self.supply = True
        """Whether the contacts have current; a master relay switches it."""
        self.stalled = False
        """Fault: the motor has current and does not turn."""
        self.welded = 0
        """Fault: the contact of this direction (-1, 1) stays closed, even when its coil is off; 0: none is welded."""
        self.reversed = False
        """Fault: the two wires of the motor are swapped."""
        self.pace = 1.0
        """Fault: its speed as a share of the normal speed, as with cold grease or a weak supply."""
        self.throttle = 1.0
        """The share of its speed that a bridge feeds it for; relays feed it for all."""
        self.sticks_s = 0.0
        """Fault: a contact opens so much later than it should, as one that is burnt or held by an arc."""
        self.pushed = 0.0
        """Fault: a hand or the wind turns it while it has no current, at this share of its normal speed."""
        self.stop_low_deg, self.stop_high_deg = spec.stop_low_deg, spec.stop_high_deg
        """The end stops; a fault may move them."""
        self.shorted_s = 0.0
        """Total time for which both directions had current at once, which burns a motor. Must stay 0."""
        self.brake: SimBrake | None = None
        """Its brake; None: it has none."""
        self.on_turn: list[Stretch] = []
        """Called for each turn of the shaft, oldest first."""
        self._now_s = now_s
        self._contacts = (False, False)
        self._moving_contacts: deque[tuple[float, tuple[bool, bool]]] = deque()

    @property
    def fastest_dps(self) -> float:
        """No faster can it turn, as its faults are now."""
        return self.spec.speed_dps * max(1.0, self.pace, abs(self.pushed))

    @property
    def rests_deg(self) -> float:
        """Where the shaft comes to rest if the current ends now: the coast ends at a stop at the latest."""
        return self._stopped(self.shaft_deg + self.speed_dps * self.spec.lag_s)

    def coils(self, plus: bool, minus: bool, now_s: float) -> None:
        """Switch the coils at `now_s`. The contacts follow after the relay's delay."""
        self.advance(now_s)
        at_s = now_s + self.spec.relay_delay_s
        if self.sticks_s:
            while self._moving_contacts and self._moving_contacts[-1][0] > at_s:
                self._moving_contacts.pop()
            before = self._moving_contacts[-1][1] if self._moving_contacts else self._contacts
            self._moving_contacts.append((at_s, (plus or before[0], minus or before[1])))
            at_s += self.sticks_s
        self._moving_contacts.append((at_s, (plus, minus)))
        self.advance(now_s)

    def advance(self, now_s: float) -> None:
        """Bring the motor up to `now_s`."""
        while True:
            contacts_s = self._moving_contacts[0][0] if self._moving_contacts else math.inf
            brake_s = self.brake.next_s() if self.brake else math.inf
            if min(contacts_s, brake_s) > now_s:
                break
            self._run(min(contacts_s, brake_s))
            if contacts_s <= brake_s:
                _, self._contacts = self._moving_contacts.popleft()
            elif self.brake:
                self.brake.move(turning=abs(self.speed_dps) > JOLT_SHARE * self.spec.speed_dps)
        self._run(now_s)

    def _run(self, until_s: float) -> None:
        left_s = until_s - self._now_s
        if left_s <= 0:
            return
        from_s, self._now_s = self._now_s, until_s
        plus, minus = self._contacts
        self.drive = 0
        if self.supply and (plus or minus or self.welded):
            plus, minus = plus or self.welded > 0, minus or self.welded < 0
            if plus and minus:
                self.shorted_s += left_s
            self.drive = (plus - minus) * (-1 if self.reversed else 1)
        wanted_dps = (self.drive * self.pace * self.throttle if self.drive else self.pushed) * self.spec.speed_dps
        if self.brake and self.brake.holds(self.drive):
            self.brake.fed_s += left_s if self.drive and not self.brake.drawn else 0.0
            self.speed_dps = wanted_dps = 0.0
        if self.stalled:
            self.speed_dps = wanted_dps = 0.0
        if wanted_dps == 0.0 and self.speed_dps == 0.0:
            return
        # A reversal is two turns: the backlash then begins at the angle where the shaft really turned back.
        turn_s = self._time_to_standstill(wanted_dps)
        if turn_s is not None and turn_s < left_s:
            self._glide(wanted_dps, turn_s, from_s)
            from_s, left_s = from_s + turn_s, left_s - turn_s
        self._glide(wanted_dps, left_s, from_s)

    def _time_to_standstill(self, wanted_dps: float) -> float | None:
        if self.spec.lag_s <= 0 or wanted_dps * self.speed_dps >= 0:
            return None
        return self.spec.lag_s * math.log((wanted_dps - self.speed_dps) / wanted_dps)

    def _glide(self, wanted_dps: float, seconds: float, from_s: float) -> None:
        """Turn for so many seconds while the speed approaches `wanted_dps`."""
        lag_s, start_deg = self.spec.lag_s, self.shaft_deg
        gap_dps = self.speed_dps - wanted_dps

        def shaft_deg(after_s: float, fade: float) -> float:
            return start_deg + wanted_dps * after_s + gap_dps * lag_s * (1.0 - fade)

        fade = math.exp(-seconds / lag_s) if lag_s > 0 else 0.0
        self.speed_dps = wanted_dps + gap_dps * fade
        if wanted_dps == 0.0 and abs(self.speed_dps) < 1e-6:  # slower than 1e-6 °/s is standstill
            self.speed_dps = 0.0
        self._move_to(shaft_deg(seconds, fade))
        for listener in self.on_turn:

            def turned(after_s: float) -> float:
                return self._stopped(shaft_deg(after_s, math.exp(-after_s / lag_s) if lag_s > 0 else 0.0))

            listener(from_s, seconds, turned)

    def _move_to(self, shaft_deg: float) -> None:
        self.shaft_deg = self._stopped(shaft_deg)
        if self.shaft_deg != shaft_deg:
            self.speed_dps = 0.0
        half_deg = self.spec.backlash_deg / 2
        self.boom_deg = min(max(self.boom_deg, self.shaft_deg - half_deg), self.shaft_deg + half_deg)

    def _stopped(self, shaft_deg: float) -> float:
        return min(max(shaft_deg, self.stop_low_deg), self.stop_high_deg)
