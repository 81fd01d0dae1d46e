"""The plan of many passes.

`schedule` is pure: time is an argument.
"""

from __future__ import annotations

from collections.abc import Sequence

from rotator.control.sky.flight_plan import Antenna
from rotator.tracking.planned import Followed, PlannedPass


def schedule(
    followed: Sequence[Followed], antenna: Antenna, from_s: float, until_s: float
) -> tuple[PlannedPass, ...]:
    """Every pass of the followed targets between two moments, by rise: flown or left out, and why.

    `antenna`: where it stands at `from_s`, with mount and motors, as `plan_flight` takes it. To fly one of them:
    `plan_flight(name, path, replace(antenna, stands_deg=flight.wait_deg), flight.set_off_s)`, with a path from
    `begin_s` to `end_s`.
    """
    raise NotImplementedError
