"""An order that cannot be carried out, with the reason as a sentence for the log.

Knows the reasons that are given in more than one place: before an order is taken, and when it is to be carried out.
Knows neither the order nor its sender.
"""

from __future__ import annotations


class Refused(ValueError):  # noqa: N818 - a sentence for a person; the program has not failed
    """The order is not carried out. Except where a method says otherwise, everything stays as it was."""


def no_homing(axis: str, *, lost: bool) -> str:
    """Of an axis without an end stop to find. `lost`: it does not know its angle either."""
    if lost:
        return f"{axis} has no end stop to find: look where it points, then rotator confirm {axis} DEGREES"
    return f"{axis} knows its angle: it needs no homing"


def measures_its_angle(axis: str) -> str:
    return f"{axis} measures its angle: there is nothing to confirm"


def is_not_fitted(axis: str) -> str:
    return f"this rotor has no {axis}: {axis}.fitted = false"


def turns_while_calibrated(axis: str) -> str:
    return f"{axis} cannot be calibrated while the antenna moves"


def no_relay_in_doubt(axis: str) -> str:
    return f"nothing is in doubt about the relays of {axis}"
