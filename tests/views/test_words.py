"""The words of the screens: a target that is flown, the way on after a fault, an antenna that turns by itself."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.protocols.console_session import report
from rotator.views.lcd import rows as lcd_rows
from rotator.views.plain_lines import line
from rotator.views.words import headline, orders_from, release
from tests.tables import every_row
from tests.views.screens import ASLEEP, show


def status(source: str, *, recognised: bool) -> Status:
    flown = Flown("ISS", begin_s=-10.0, end_s=312.0, recognised=recognised)
    return Status(0.0, AxisStatus(0, 450), AxisStatus(0, 180), controlled_by=source, flown=flown)


@pytest.mark.parametrize(
    ("source", "recognised", "said", "told"),
    [
        ("gs232b#1", True, "orders from gs232b: ISS, LOS in 5:12", "recognised: ISS, up for 5:12 min more"),
        ("track", False, "tracks ISS, LOS in 5:12", "tracks: ISS, up for 5:12 min more"),
    ],
)
def test_recognised_in_a_programs_orders_or_tracked_by_the_box(
    source: str, recognised: bool, said: str, told: str
) -> None:
    now = status(source, recognised=recognised)
    assert orders_from(now) == said
    assert told in report(now)
    assert now.recognised == ("ISS" if recognised else "")


@every_row(
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


@every_row("size", [(40, 12), (80, 24), (200, 50)])
@every_row(
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


STANDS = Status(100.0, AxisStatus(0, 450, 231.0), AxisStatus(0, 180, 24.0), controlled_by="track")


@every_row(
    ("begin_s", "end_s", "said"),
    [
        (300.0, 900.0, "tracks ISS, AOS in 3:20"),
        (8000.0, 9000.0, "tracks ISS, AOS in 2h11"),
        (50.0, 165.4, "tracks ISS, LOS in 1:05"),
        (50.0, 90.0, "tracks ISS, LOS in 0:00"),
        (50.0, math.inf, "tracks ISS, always up"),
    ],
)
def test_when_the_target_rises_or_sets(begin_s: float, end_s: float, said: str) -> None:
    assert orders_from(replace(STANDS, flown=Flown("ISS", begin_s, end_s))) == said


def test_it_waits_for_a_target_that_has_not_risen() -> None:
    waits = replace(STANDS, flown=Flown("ISS", 300.0, 900.0))
    assert headline(waits)[0] == "WAITS FOR ISS"
    turns = replace(waits, azimuth=replace(waits.azimuth, drive=Direction.PLUS, moving=True))
    assert turns.axis(Axis.AZIMUTH).moving
    assert headline(turns)[0] == "TURNING"
    assert headline(replace(waits, at_s=301.0))[0] != "WAITS FOR ISS"


@pytest.mark.parametrize(
    ("error_deg", "beyond", "said"),
    [
        (0.04, False, "tracks ISS, LOS in 1:05"),
        (0.31, False, "tracks ISS, LOS in 1:05, error up to 0.3°"),
        (12.4, True, "tracks ISS, LOS in 1:05, ERROR UP TO 12°: BEYOND THE BEAM"),
    ],
)
def test_how_far_the_target_may_be_off(error_deg: float, beyond: bool, said: str) -> None:
    flown = Flown("ISS", 50.0, 165.4, error_deg, beyond_beam=beyond)
    status = replace(STANDS, flown=flown)
    assert orders_from(status) == said
    assert any(line == f"tracks: ISS, up for 1:05 min more{flown.error_text}" for line in report(status))


@pytest.mark.parametrize(
    ("begin_s", "said"), [(150.0, "tracks abs, begins in 0:50"), (50.0, "tracks abs, ends in 1:05")]
)
def test_a_table_begins_and_ends_and_does_not_rise_or_set(begin_s: float, said: str) -> None:
    status = replace(STANDS, flown=Flown("abs", begin_s, 165.4, table=True))
    assert orders_from(status) == said
    assert not any("rise" in line or " up " in line for line in report(status))


@pytest.mark.parametrize("error_deg", [10.1, 99.9, 180.0])
def test_the_lcd_tells_an_error_beyond_the_beam_in_its_sixteen_columns(error_deg: float) -> None:
    flown = Flown("ISS", 50.0, 165.4, error_deg, beyond_beam=True)
    shown = {lcd_rows(replace(STANDS, flown=flown), now_s)[0] for now_s in range(30)}
    assert any(f"{error_deg:.0f}DEG" in row and row.startswith("OFF BY") for row in shown)
    assert all(len(row) == 16 for row in shown)
