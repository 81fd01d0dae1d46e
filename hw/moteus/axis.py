"""One moteus controller: the next order to it, and the meaning of its answers.

Knows its faults, its watchdog and its home states, and how often it needs an order. Knows no CAN bus, no serial port,
no library, no thread and no clock: moments are arguments, in seconds.
"""

from __future__ import annotations

import math
from enum import Enum

from hw.moteus.errands import ERRAND_S, Errands, Request
from hw.moteus.faults import LIMITS, Limit, explain
from hw.moteus.hearing import Hearing
from hw.moteus.orders import WATCHDOG_S, Answer, Mode, MoteusSpec, Move, Order, Query, SetOutput, Stop
from hw.moteus.placing import Placing
from hw.ports import HardwareError

MOVING_EVERY_S = 0.02
"""Seconds between two orders to a moving axis."""
PARKED_EVERY_S = 0.08
"""Seconds between two orders to an axis at rest: much shorter than the controller's watchdog time."""
STALE_S = 0.3
"""Seconds: an older answer is not used. A shorter silence stops nothing, because the controller carries out its last
order."""
FORGIVEN_S = 2.0
"""Seconds: after a silence up to this the axis takes the next order without an acknowledgement. Meanwhile the
controller stood and held, and it still knows its place."""

MOVES_DPS, STANDS_DPS = 0.01, 0.5
"""Speeds in degrees a second: an axis faster than the first moves; slower than the second its angle can be read by
eye."""


class Wish(Enum):
    """The program's wish for the axis."""

    NOTHING = "nothing was ordered yet"
    LET_GO = "the operator released it"
    HOLD = "hold"
    AIM = "aim"


class MoteusAxis:
    """Call `aim`, `hold` or `release`; send what `order` returns; pass on the answer (`heard`), or that none came
    (`missed`).
    """

    def __init__(self, spec: MoteusSpec, *, look_only: bool = False) -> None:
        """`look_only`: only query the controller, and never give it an order or a position."""
        self.spec = spec
        self._look_only = look_only
        self.fault: str | None = None
        """What stopped this axis, in a sentence. None: no fault, or the operator has acknowledged it."""
        self.hearing = Hearing()
        self.until_s = -math.inf
        """When the present aim expires."""
        self.wish = Wish.NOTHING
        self._name = f"moteus {spec.can_id}"
        self._placing = Placing(spec)
        self._aim = (0.0, 0.0, 0.0)  # angle_deg, rate_dps, and the moment of the command
        self._errands = Errands()
        self._engaged = False
        """Whether this program has ordered the controller to move or to hold, so that it has torque."""
        self._ordered_to_hold = False
        """Whether the latest answered order was to hold."""
        self._next_s = -math.inf

    # --- what the program wants

    def aim(self, angle_deg: float, rate_dps: float, until_s: float, now_s: float) -> None:
        """Be at `angle_deg` at `now_s` and move on at `rate_dps`, until `until_s`.

        Raises HardwareError: no finite number, a fault, an unknown position, or no answer.
        """
        if not (math.isfinite(angle_deg) and math.isfinite(rate_dps)):
            raise HardwareError(f"{self._name}: {angle_deg}° at {rate_dps}°/s is nowhere to aim at")
        if self.fault:
            raise HardwareError(self.fault)
        self.angle_deg(now_s)
        self._aim = (angle_deg, rate_dps, now_s)
        self.until_s = until_s
        self._want(Wish.AIM)

    def hold(self) -> None:
        """Decelerate and hold. An axis that was never aimed, or that the operator released, stays without torque."""
        if self.wish is Wish.AIM:
            self._want(Wish.HOLD)

    def release(self) -> None:
        """Take the torque away, now or as soon as the controller answers again."""
        self._send_first(Stop())
        self._want(Wish.LET_GO)

    def acknowledge(self, now_s: float) -> None:
        """Clear the fault. If its cause is still present, it comes back. Raises HardwareError: no answer."""
        self._must_answer(now_s)
        self.fault = None
        self._send_first(Stop(), until_s=now_s + ERRAND_S)

    def confirm(self, angle_deg: float, exactly: bool, now_s: float) -> None:
        """The operator or a sensor has found the axis at `angle_deg`: `exactly`, or at the nearest angle that agrees
        with the encoder. Raises HardwareError: no answer, or no finite angle.
        """
        answer = self._must_answer(now_s)
        if not math.isfinite(angle_deg):
            raise HardwareError(f"{self._name}: {angle_deg}° is no angle")
        if self._faster_than(STANDS_DPS):
            raise HardwareError(f"{self._name}: it turns; look where it points when it stands")
        agreed_deg = angle_deg if exactly else self._placing.agreed_deg(answer, angle_deg)
        if agreed_deg is None:
            raise HardwareError(
                f"{self._name}: its encoder shows {self.spec.degrees(answer.position_rev) % 360:.0f}°, which is not "
                f"{angle_deg:g}°: look again, or correct zero_rev"
            )
        self.hold()
        self._placing.doubt()
        # First take the torque away. A controller that holds would turn the motor by the shift of its scale.
        taken = SetOutput(self.spec.revolutions(agreed_deg), exactly)
        self._send_first(Stop(), taken, until_s=now_s + ERRAND_S)

    def _want(self, wish: Wish) -> None:
        self.wish = wish
        self._next_s = -math.inf

    def _send_first(self, *requests: Request, until_s: float = math.inf) -> None:
        self._errands.put(*requests, until_s=until_s)
        self._next_s = -math.inf

    # --- what is known

    @property
    def answer(self) -> Answer | None:
        """The latest answer; None: none has come yet."""
        return self.hearing.answer

    @property
    def busy(self) -> bool:
        """Whether a request of the operator is not carried out yet."""
        return bool(self._errands)

    @property
    def moving(self) -> bool:
        return self._faster_than(MOVES_DPS)

    def _faster_than(self, speed_dps: float) -> bool:
        return self.answer is not None and abs(self.answer.velocity_rev_s) > self.spec.span_rev(speed_dps)

    @property
    def at_rest(self) -> bool:
        """Whether the bus may be closed: each request is carried out, and the axis holds or has no torque."""
        if self.fault or self.wish in (Wish.NOTHING, Wish.LET_GO):
            return not self._errands
        return self._ordered_to_hold and not self.moving

    @property
    def position_known(self) -> bool:
        return self.answer is not None and not self._placing.unknown

    @property
    def limited_by(self) -> Limit | None:
        """What limits a controller without a fault; None: no limit is active."""
        return LIMITS.get(self.answer.fault) if self.answer else None

    def angle_deg(self, now_s: float) -> float:
        """The angle in degrees on the rotor's own scale. Raises HardwareError: no answer, or an unknown position."""
        answer = self._must_answer(now_s)
        if self._placing.unknown:
            raise HardwareError(f"{self._name} {self._placing.unknown}")
        return self._placing.angle_deg(answer)

    def _must_answer(self, now_s: float) -> Answer:
        if self.answer is None or self.hearing.silent_s(now_s) > STALE_S:
            raise HardwareError(f"{self._name} does not answer: check its supply, the CAN wires and its id")
        return self.answer

    # --- orders and answers

    def due_s(self) -> float:
        return self._next_s

    def order(self, now_s: float) -> Order | None:
        """The order to send now; None: none is due."""
        if now_s < self._next_s:
            return None
        self._next_s = now_s + (MOVING_EVERY_S if self.wish is Wish.AIM or self.moving or self.busy else PARKED_EVERY_S)
        self._errands.expire(now_s)
        self.hearing.ordered(now_s)
        # A silent controller may have lost its supply, and its position with it: ask for its state before it may move.
        if self.hearing.missed or self.answer is None:
            return Query()
        if self._errands:
            return self._errands.first
        if self.fault or self.wish not in (Wish.AIM, Wish.HOLD):
            return Query()
        if not self._engaged and self.answer.mode == Mode.TIMEOUT:  # from an earlier run of the program
            self._send_first(Stop())
            return Stop()
        return self._move(now_s)

    def _move(self, now_s: float) -> Move:
        self._engaged = True
        if self.wish is not Wish.AIM or not self.position_known:
            return Move(math.nan, 0.0)
        angle_deg, rate_dps, at_s = self._aim
        speed_rev_s = rate_dps / 360 * self.spec.rev_per_turn
        return Move(self.spec.revolutions(angle_deg + rate_dps * (now_s - at_s)), speed_rev_s)

    def missed(self) -> None:
        """The latest order was not answered."""
        self.hearing.note_miss()

    def heard(self, order: Order, answer: Answer, now_s: float) -> None:
        """The answer to `order`."""
        self.hearing.note(answer, now_s)
        self._ordered_to_hold = isinstance(order, Move) and math.isnan(order.position_rev)
        if self._errands and self._placing.given_rev is None:
            self._run_errand(order, answer)
            return
        given_rev = self._placing.see(answer)
        if given_rev is not None and not self._errands and not self._look_only:
            # As in `confirm`. But a fault stays: only a person clears it.
            loosen = [] if answer.mode in (Mode.STOPPED, Mode.FAULT) else [Stop()]
            self._send_first(*loosen, SetOutput(given_rev, exactly=False))
        if self._errands:
            self._run_errand(order, answer)
            return
        if self._timed_out(answer) and self.hearing.gap_s <= FORGIVEN_S:
            self._send_first(Stop())
        elif self.fault is None:
            self.fault = self._judge(answer)
            if self.fault and self.wish is Wish.AIM:
                self.wish = Wish.HOLD

    def _run_errand(self, order: Order, answer: Answer) -> None:
        match self._errands.answered(order, answer, placed=self._placing.given_rev is None):
            case Stop():
                self._engaged = False
            case SetOutput():
                self._placing.confirmed()
            case None:
                return
        self._next_s = -math.inf

    def _timed_out(self, answer: Answer) -> bool:
        return answer.mode == Mode.TIMEOUT and self._engaged

    def _judge(self, answer: Answer) -> str | None:
        if answer.mode == Mode.FAULT:
            fault = explain(answer.fault)
            return f"{self._name}: {fault.name} ({answer.fault}): {fault.remedy}, then acknowledge it"
        if self._timed_out(answer):
            return (
                f"{self._name} heard nothing for {WATCHDOG_S} s and stopped by itself: "
                "look for a loose cable or a frozen computer, then acknowledge it"
            )
        return None
