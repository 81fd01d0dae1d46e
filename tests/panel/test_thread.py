"""The threads of the front panel, which wait for events with timeouts far longer than anything should take."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest

from rotator.exchange.orders import Mode, SetMode, Stop
from rotator.panel.thread import PANEL_THREADS
from tests.panel.desk import Bench

PATIENCE_S = 30.0


@pytest.fixture
def running() -> Iterator[Bench]:
    bench = Bench(time.monotonic, lambda _seconds: None)
    bench.thread.start()
    yield bench
    bench.sim.clear("bus-hung")
    bench.thread.stop()
    assert not set(PANEL_THREADS) & {thread.name for thread in threading.enumerate()}


def test_a_bus_that_hangs_does_not_take_the_stop_button_with_it(running: Bench) -> None:
    running.sim.inject("bus-hung")
    running.sim.press_stop()
    with running.changed:
        assert running.changed.wait_for(lambda: Stop(latch=True) in running.posted, PATIENCE_S)


def test_running_it_reads_and_posts(running: Bench) -> None:
    with running.changed:
        assert running.changed.wait_for(lambda: SetMode(Mode.MANUAL) in running.posted, PATIENCE_S)


def test_a_disk_that_hangs_does_not_take_it_either() -> None:
    bench = Bench(time.monotonic, time.sleep)  # a conversion takes its milliseconds
    bench.disk.clear()
    bench.sim.set_calibrate(closed=True)
    for axis in ("azimuth", "elevation"):
        bench.sim.turn_knob(axis, 0.95)
    bench.thread.start()
    with bench.changed:
        assert bench.changed.wait_for(lambda: SetMode(Mode.MANUAL) in bench.posted, PATIENCE_S)
    bench.sim.press_stop()
    with bench.changed:
        assert bench.changed.wait_for(lambda: Stop(latch=True) in bench.posted, PATIENCE_S)
        bench.disk.set()
        assert bench.changed.wait_for(lambda: bool(bench.kept), PATIENCE_S)
    bench.thread.stop()


def test_when_a_thread_fails_it_is_as_if_the_button_were_pressed_and_the_box_hears_why() -> None:
    bench = Bench(time.monotonic, lambda _seconds: None)
    bench.bug = True
    bench.thread.start()
    with bench.changed:
        assert bench.changed.wait_for(lambda: bool(bench.failures), PATIENCE_S)
        assert Stop(latch=True) in bench.posted
        assert [str(failure) for failure in bench.failures] == ["a bug"]
    bench.thread.stop()
