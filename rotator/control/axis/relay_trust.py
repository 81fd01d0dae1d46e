"""The faults of a motor relay that may not have opened, in words for a person.

Knows how far a relay is trusted, and whether a master is wired. `opening_watch` and `contact_watch` find that out.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.faults import Fault, FaultKind, Notice
from rotator.status import Trust, Trusts

CUT_BY_HAND = "CUT MOTOR POWER!"
WAYS = {
    (Axis.AZIMUTH, Direction.PLUS): "clockwise",
    (Axis.AZIMUTH, Direction.MINUS): "counter-clockwise",
    (Axis.ELEVATION, Direction.PLUS): "up",
    (Axis.ELEVATION, Direction.MINUS): "down",
}


def unstoppable(fault: Fault, *, master: bool) -> Fault:
    """That fault, of an axis that no relay of its own is sure to stop: only the supply is.

    `master`: an output switches the supply.
    """
    if master:
        return replace(fault, measured=f"{fault.measured}; the box has switched the motors' supply off", cut=True)
    measured = f"{fault.measured}; switch the motors' supply off by hand NOW, the box has no relay for that"
    return replace(fault, measured=measured, cut=True, act_now=CUT_BY_HAND)


def accusation(axis: Axis, direction: Direction, trust: Trust, place: str, *, master: bool) -> Fault | None:
    """The fault that an order against that relay meets; None where the relay is not suspected.

    `place`: where the axis stood when the doubt arose, for a person; empty: not known any more.
    """
    way = WAYS[axis, direction]
    match trust:
        case Trust.WELDED:
            return unstoppable(Fault(FaultKind.RELAY_WELDED, axis, f"the relay {way} was found closed"), master=master)
        case Trust.DOUBTED:
            measured = f"the relay {way} is off, and it{place or ' stands'}, where a motor with current would stand too"
            # The motor may have current and be held by its stop: with a master it is spared that.
            return Fault(FaultKind.RELAY_UNSEEN, axis, measured, cut=master)
        case _:
            return None


def doubts(axis: Axis, trusts: Trusts) -> tuple[Notice, ...]:
    """What a person who drives the axis to its stops on purpose should know: the relays in doubt forbid nothing."""
    return tuple(
        Notice(
            f"the box could not see the relay {WAYS[axis, way]} open, because the axis stood still: if it does not "
            f"turn {WAYS[axis, Direction(-way)]} now, release the key and look at that relay"
        )
        for way, trust in zip((Direction.PLUS, Direction.MINUS), trusts, strict=True)
        if trust is Trust.DOUBTED
    )
