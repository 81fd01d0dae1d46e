"""What the screens say of a target that the box tracks by itself."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.protocols.console_session import report
from rotator.views.lcd import rows as lcd_rows
from rotator.views.words import headline, orders_from

STANDS = Status(100.0, AxisStatus(0, 450, 231.0), AxisStatus(0, 180, 24.0), controlled_by="track")


@pytest.mark.parametrize(
    ("begin_s", "end_s", "said"),
    [
        (300.0, 900.0, "tracks ISS, AOS 3:20"),
        (8000.0, 9000.0, "tracks ISS, AOS 2h11"),
        (50.0, 165.4, "tracks ISS, LOS 1:05"),
        (50.0, 90.0, "tracks ISS, LOS 0:00"),
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
        (0.04, False, "tracks ISS, LOS 1:05"),
        (0.31, False, "tracks ISS, LOS 1:05, error up to 0.3°"),
        (12.4, True, "tracks ISS, LOS 1:05, ERROR UP TO 12°: BEYOND THE BEAM"),
    ],
)
def test_how_far_the_target_may_be_off(error_deg: float, beyond: bool, said: str) -> None:
    flown = Flown("ISS", 50.0, 165.4, error_deg, beyond_beam=beyond)
    status = replace(STANDS, flown=flown)
    assert orders_from(status) == said
    assert any(line == f"tracks: ISS, up for 1:05 min more{flown.error_text}" for line in report(status))


@pytest.mark.parametrize(("begin_s", "said"), [(150.0, "tracks abs, IN 0:50"), (50.0, "tracks abs, ENDS 1:05")])
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
