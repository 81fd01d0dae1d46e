"""A timed table handed in to a box in simulated time: it waits, follows, ends, and gives way like any tracking."""

from __future__ import annotations

import pytest

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.tracking.tracker import CLOCK_UNSURE
from tests.tracking.tracked_box import FEBRUARY_S, Box, pass_of

ROWS = ((60.0, 80.0, 5.0), (100.0, 100.0, 30.0), (140.0, 140.0, 45.0), (180.0, 180.0, 20.0))


def table(offset_s: float = 0.0, *, utc: bool = False) -> TimedTable:
    rows = tuple((at_s + offset_s, azimuth_deg, elevation_deg) for at_s, azimuth_deg, elevation_deg in ROWS)
    return TimedTable("test", rows, (2, 3, 4, 5), utc=utc)


@pytest.fixture
def box() -> Box:
    return Box(FEBRUARY_S)


def off_deg(box: Box, row: int) -> float:
    return great_circle_deg(*box.world.antenna(), *ROWS[row][1:])


@pytest.mark.long
@pytest.mark.parametrize("utc", [False, True])
def test_it_waits_at_the_first_row_and_is_at_each_row_in_time(box: Box, utc: bool) -> None:
    assert box.tracker.program(table(box.utc_s if utc else 0.0, utc=utc)) == ""
    box.wait(55.0)
    assert off_deg(box, 0) < 7.0  # whole steps, for the tolerance of the motors is 4°
    for row in range(4):
        assert box.tracker.state == "tracking"
        box.wait(ROWS[row][0] - (55.0 if row == 0 else ROWS[row - 1][0]))
        assert off_deg(box, row) < 7.0
    box.wait(5.0)
    assert box.tracker.state == "ended: test is over"
    box.wait(20.0)
    assert off_deg(box, 3) < 7.0
    assert not box.loop.status.moving


def test_a_table_that_has_begun_is_flown_from_now_on(box: Box) -> None:
    box.tracker.program(table(box.utc_s - 100.0, utc=True))
    box.wait(40.0)
    assert off_deg(box, 2) < 5.0


@pytest.mark.parametrize(
    ("offset_s", "told"), [(-200.0, "test is over"), (9 * 86_400.0, "test begins in 9 days: that is too far ahead")]
)
def test_a_table_of_another_day_is_refused(box: Box, offset_s: float, told: str) -> None:
    box.tracker.program(table(box.utc_s + offset_s, utc=True))
    box.wait(2.0)
    assert box.tracker.state == f"ended: {told}"
    assert not box.loop.status.moving


def test_a_table_into_a_sector_is_refused_before_anything_turns() -> None:
    mast = '[[mount.forbidden]]\nname = "mast"\nazimuth_deg = [130, 150]\nelevation_deg = [0, 180]\n'
    box = Box(FEBRUARY_S, follow=mast)
    box.tracker.program(table())
    box.wait(2.0)
    assert box.tracker.state.startswith("ended: test, line 3: azimuth 1")
    assert box.tracker.state.endswith("is in a forbidden sector, or in its margin")
    assert not box.loop.status.moving


def test_utc_needs_a_clock_that_is_right_and_seconds_from_now_do_not(box: Box) -> None:
    box.clock_trusted = False
    assert box.tracker.program(table(box.utc_s, utc=True)) == CLOCK_UNSURE
    assert box.tracker.program(table()) == ""


def test_when_the_clock_is_set_seconds_from_now_stay_the_same(box: Box) -> None:
    box.tracker.program(table())
    box.wait(30.0)
    box.set_clock(3600.0)
    box.wait(70.0)
    assert off_deg(box, 1) < 5.0


# --- a request that cannot be tracked, while something is


PAST, WALLED = "past", "walled"


def refused(box: Box, how: str) -> str:
    """Ask for a table that cannot be flown. Returns the reason."""
    rows = {
        PAST: tuple((box.utc_s - 500.0 + at_s, az_deg, el_deg) for at_s, az_deg, el_deg in ROWS),
        WALLED: tuple((box.utc_s + at_s, (340.0 + at_s) % 360, 20.0) for at_s in (10.0, 20.0, 30.0)),
    }[how]
    mast = TimedTable(how, rows, tuple(range(2, 2 + len(rows))), utc=True)
    box.tracker.program(mast)
    box.wait(2.0)
    return {PAST: "past is over", WALLED: "walled, line"}[how]


WALL = '[[mount.forbidden]]\nname = "mast"\nazimuth_deg = [352, 359]\nelevation_deg = [0, 90]\n'


@pytest.mark.long
@pytest.mark.parametrize("how", [PAST, WALLED])
@pytest.mark.parametrize("first", ["table", "iss"])
def test_a_refused_request_keeps_what_was_tracked(first: str, how: str) -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s - 60.0, follow=WALL)
    box.tracker.program(table()) if first == "table" else box.tracker.track("iss")
    box.wait(2.0)
    before = box.loop.status.flown
    assert before is not None
    reason = refused(box, how)
    assert box.tracker.state.startswith(f"refused: {reason}")
    assert box.loop.status.flown == before
    box.wait(70.0)
    assert box.loop.status.flown is not None
    assert box.loop.status.flown.name == before.name
    box.loop.post(Source("rotctld", 1), Aim(10.0, 10.0))
    box.wait(5.0)
    assert box.tracker.state.startswith("ended: rotctld"), "it is watched as before"


def test_the_status_says_that_a_table_is_flown(box: Box) -> None:
    box.tracker.program(table())
    box.wait(2.0)
    assert box.loop.status.flown is not None
    assert box.loop.status.flown.table
