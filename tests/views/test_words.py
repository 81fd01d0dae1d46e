"""What the screens say of a target that is flown: who asked for it, its name, when it sets."""

from __future__ import annotations

import pytest

from rotator.protocols.console_session import report
from rotator.status import AxisStatus, Flown, Status
from rotator.views.words import orders_from


def status(source: str, *, recognised: bool) -> Status:
    flown = Flown("ISS", begin_s=-10.0, end_s=312.0, recognised=recognised)
    return Status(0.0, AxisStatus(0, 450), AxisStatus(0, 180), controlled_by=source, flown=flown)


@pytest.mark.parametrize(
    ("source", "recognised", "said", "told"),
    [
        ("gs232b#1", True, "orders from gs232b: ISS, LOS 5:12", "recognised: ISS, up for 5:12 min more"),
        ("track", False, "tracks ISS, LOS 5:12", "tracks: ISS, up for 5:12 min more"),
    ],
)
def test_recognised_in_a_programs_orders_or_tracked_by_the_box(
    source: str, recognised: bool, said: str, told: str
) -> None:
    now = status(source, recognised=recognised)
    assert orders_from(now) == said
    assert told in report(now)
    assert now.recognised == ("ISS" if recognised else "")
