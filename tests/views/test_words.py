"""The words of the screens: a target that is flown, the way on after a fault, an antenna that turns by itself."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import Axis
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.protocols.console_session import report
from rotator.views.plain_lines import line
from rotator.views.words import orders_from, release
from tests.views.screens import ASLEEP, show


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


@pytest.mark.parametrize(
    ("kind", "passing", "latched", "says"),
    [
        (None, False, "", ""),
        (None, False, "panel", "resume + Enter: it may move again"),
        (FaultKind.POT_OPEN, False, "", "resume + Enter: go on when repaired"),
        (FaultKind.POT_OPEN, False, "panel", "resume + Enter: go on when repaired"),
        (FaultKind.POT_OPEN, True, "", "This ends by itself when the cause is gone."),
        (FaultKind.POT_OPEN, True, "panel", "resume + Enter: it may move when the cause is gone"),
        (FaultKind.RELAY_WELDED, False, "", "Repaired? rotator relays-checked azimuth, then resume"),
        (FaultKind.RELAY_WELDED, False, "panel", "Repaired? rotator relays-checked azimuth, then resume"),
        (FaultKind.NOT_HOMED, False, "", "Repaired? rotator home azimuth, then resume"),
        (FaultKind.POSITION_UNKNOWN, False, "", "Repaired? rotator confirm azimuth DEGREES, then resume"),
    ],
)
def test_the_way_on_promises_no_motion_that_resume_does_not_give(
    kind: FaultKind | None, passing: bool, latched: str, says: str
) -> None:
    fault = Fault(kind, Axis.AZIMUTH, "it turns", passing=passing) if kind else None
    assert release(replace(ASLEEP, azimuth=replace(ASLEEP.azimuth, fault=fault), latched=latched)) == says


@pytest.mark.parametrize("size", [(40, 12), (80, 24), (200, 50)])
@pytest.mark.parametrize(
    ("axis", "speed_dps", "says"), [(Axis.AZIMUTH, -5.94, "TURNS CCW 5.9°/s"), (Axis.ELEVATION, 2.0, "TURNS UP 2.0°/s")]
)
def test_an_antenna_that_turns_by_itself_shows_at_a_glance(
    size: tuple[int, int], axis: Axis, speed_dps: float, says: str
) -> None:
    each = replace(ASLEEP.axis(axis), by_itself_dps=speed_dps)
    is_azimuth = axis is Axis.AZIMUTH
    status = replace(ASLEEP, azimuth=each) if is_azimuth else replace(ASLEEP, elevation=each)
    assert says in show(status, size=size)
    assert f"TURNING BY ITSELF: {axis.value}" in show(status, size=size)
    assert "BY ITSELF at" in "\n".join(report(status))
    assert "BY ITSELF" in line(status)
