"""A mistake in a plan, or in the program itself, ends what is tracked with a sentence; the next target is tracked.

Real threads, and for the planner its real process.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rotator.assembly.tracking import build_antenna
from rotator.config.model import Config
from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.timed_table import TimedTable
from rotator.store.favourites import KeptFavourites
from rotator.store.priorities import Priorities
from rotator.store.state import State
from rotator.tracking.follower import Follower
from rotator.tracking.known_sky import FileReader
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import NextFlight, Now
from rotator.tracking.planner import ProcessPlanner
from rotator.tracking.program import Program, program_flight
from rotator.tracking.system_clock import SystemClock
from rotator.tracking.thread import TrackingThread
from rotator.tracking.tracker import Tracker
from tests.tracking.tracked_box import FEBRUARY_S, PERIOD_S, Box, InThisProcess

PATIENCE_S = 60.0
UP_S = 1e6
"""The control loop runs for so long: on its clock the two rows are one moment."""
GOOD = TimedTable("good", ((0.0, 80.0, 5.0), (600.0, 100.0, 30.0)), (2, 3))
AT_ONE_MOMENT = TimedTable("bad", ((5.0, 10.0, 20.0), (5.00000000000001, 10.0, 20.0), (60.0, 20.0, 30.0)), (2, 3, 4))


@pytest.fixture
def planner() -> Iterator[ProcessPlanner]:
    planner = ProcessPlanner()
    yield planner
    planner.close()


@pytest.mark.long
def test_a_plan_that_fails_in_its_process_is_logged_and_the_next_one_is_made(planner: ProcessPlanner) -> None:
    antenna, now = build_antenna(Config()), Now(FEBRUARY_S, UP_S)
    with pytest.raises(RuntimeError, match="the plan could not be made"):
        planner.plan_program(Program(AT_ONE_MOMENT, UP_S), antenna, now)
    assert planner.plan_program(Program(GOOD, UP_S), antenna, now).order.name == "good"


class FailsOnce(InThisProcess):
    """A planner with a mistake in it, which comes to light at one table."""

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        if program.table.name == "bad":
            raise ZeroDivisionError("float division by zero")
        return program_flight(program, antenna, now)


def comes(box: Box, what: Callable[[], bool]) -> bool:
    """Whether it comes while the box turns its control loop, on its own clock: the computer's may have just begun."""
    waits = threading.Event()
    for _ in range(round(PATIENCE_S / PERIOD_S)):
        if what():
            return True
        box.clock.sleep(PERIOD_S)
        box.loop.cycle()
        waits.wait(PERIOD_S)
    return False


@pytest.mark.long
def test_the_thread_outlives_a_mistake_of_the_program(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    box = Box(FEBRUARY_S)
    known, planner = box.known, FailsOnce()
    tracker = Tracker(known, planner, box.tracked, lambda: True)
    thread = TrackingThread(
        tracker,
        Follower(tracker, planner, box.tracked, lambda: ()),
        StreamListener(known, planner, box.tracked, lambda: box.utc_s, lambda: True),
        known,
        planner=ProcessPlanner(),
        reader=FileReader(),
        clock=SystemClock(),
        priorities=Priorities(State(tmp_path / "state.json")),
        favourites=KeptFavourites(State(tmp_path / "state.json")),
        steady_s=box.clock,
    )
    thread.start()
    try:
        for _ in range(2):
            assert tracker.program(AT_ONE_MOMENT) == ""
            assert comes(box, lambda: tracker.state.startswith("ended: "))
            assert tracker.state == (
                "ended: the program has a mistake (ZeroDivisionError('float division by zero')): see the log"
            )
        assert tracker.program(GOOD) == ""
        assert comes(box, lambda: tracker.state != "planning")
        assert tracker.state == "tracking"
    finally:
        thread.stop()
    told = [record for record in caplog.records if "please report it" in record.getMessage()]
    assert len(told) == 1, "each mistake once"
    assert told[0].exc_info is not None
