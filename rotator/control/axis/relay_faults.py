"""The faults of a motor relay that may not have opened, and of a limit switch, in words for a person.

Knows how far a relay is trusted, and whether a master is wired. `opening_watch` and `contact_watch` find that out.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.control.axis.relay_state import BOTH_WAYS
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.motor import Trust, Trusts

CUT_BY_HAND = "CUT MOTOR POWER!"
WAYS = {
    (Axis.AZIMUTH, Direction.PLUS): "clockwise",
    (Axis.AZIMUTH, Direction.MINUS): "counter-clockwise",
    (Axis.ELEVATION, Direction.PLUS): "up",
    (Axis.ELEVATION, Direction.MINUS): "down",
}
"""What a person calls each direction."""


def limit_reached(axis: Axis, direction: Direction) -> Fault:
    measured = f"its switch has opened on the way {WAYS[axis, direction]}"
    return Fault(FaultKind.LIMIT_SWITCH, axis, measured)


def unstoppable(fault: Fault, *, master: bool) -> Fault:
    """The same fault, for an axis that its own relays may not stop: only a cut of the supply surely stops it.

    `master`: an output switches the supply.
    """
    usual = (fault.advice or fault.kind.advice).removeprefix("Switch the motors off, and ")
    then = usual[:1].lower() + usual[1:]
    if master:
        return replace(fault, advice=f"The box has switched the motors' supply off. Now {then}", cut=True)
    by_hand = "Switch the motors' supply off by hand NOW, the box has no relay for that. Then "
    return replace(fault, advice=by_hand + then, cut=True, act_now=CUT_BY_HAND)


def accusation(axis: Axis, direction: Direction, trust: Trust, place: str, *, master: bool) -> Fault | None:
    """The fault of an order that would work against this relay; None: the relay is not suspected.

    `place`: where the axis stands, for a person; empty: not known any more.
    """
    way = WAYS[axis, direction]
    match trust:
        case Trust.WELDED:
            return unstoppable(Fault(FaultKind.RELAY_WELDED, axis, f"the relay {way} was found closed"), master=master)
        case Trust.DOUBTED:
            measured = f"the relay {way} is off, and it{place or ' stands'}, where a motor with current would stand too"
            # The motor may have current and press against its stop: a master then cuts that current.
            return Fault(FaultKind.RELAY_UNSEEN, axis, measured, cut=master)
        case _:
            return None


def doubts(axis: Axis, trusts: Trusts) -> tuple[Notice, ...]:
    """Notices for a person who drives the axis to its stops on purpose: there the relays in doubt forbid nothing."""
    return tuple(
        Notice(
            f"the box could not see the relay {WAYS[axis, way]} open, because the axis stood still: if it does not "
            f"turn {WAYS[axis, Direction(-way)]} now, stop and check that relay"
        )
        for way, trust in zip(BOTH_WAYS, trusts, strict=True)
        if trust is Trust.DOUBTED
    )
