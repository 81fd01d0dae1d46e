"""The display's thread, in real time, with the real driver on a simulated backpack: gone, and back again.

Waits for events with timeouts far longer than anything should take.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator, Sequence

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.hd44780 import Hd44780 as Glass
from firmware_sim.chips.pcf8574 import Backpack
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.hd44780 import BACKPACKS, BackpackPort, Hd44780
from hw.ports import HardwareError
from rotator.runtime.display import DISPLAY_THREAD, RESET_EVERY_S, DisplayThread

ADDRESS = 0x27
PATIENCE_S = 30.0
RETRY_S = 0.05
FIRST = ("SAT A:235 E:025 ", "SIM A:231 E:024 ")
SECOND = ("SAT A:236 E:025 ", "SIM A:232 E:024 ")


class HandSet:
    """A clock that the test sets."""

    def __init__(self) -> None:
        self.now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


class Watched:
    """A display that counts its calls and failures, and lets a test wait for a count."""

    def __init__(self, display: Hd44780) -> None:
        self._display = display
        self.changed = threading.Condition()
        self.resets = self.shows = self.failures = self.asks = 0

    def reset(self) -> None:
        self._try(self._display.reset)
        self.count("resets")

    def show(self, rows: Sequence[str]) -> None:
        self._try(lambda: self._display.show(rows))
        self.count("shows")

    def _try(self, work: Callable[[], None]) -> None:
        try:
            work()
        except HardwareError:
            self.count("failures")
            raise

    def count(self, what: str) -> None:
        with self.changed:
            setattr(self, what, getattr(self, what) + 1)
            self.changed.notify_all()

    def wait(self, **least: int) -> bool:
        """Wait until each count has reached this number. Returns whether it has."""
        with self.changed:
            return self.changed.wait_for(
                lambda: all(getattr(self, what) >= count for what, count in least.items()), PATIENCE_S
            )


class Bench:
    def __init__(self) -> None:
        # The wire and the driver's pauses are simulated, and belong to the display's thread alone.
        pauses = SimClock()
        self.wire = SimI2CBus(pauses.sleep)
        self.glass = Glass(self.wire.wire_time(pauses))
        self.wire.attach(ADDRESS, Backpack(self.glass, BACKPACKS["ywrobot"]).expander)
        port = BackpackPort(SmbusI2C(self.wire, "bus 1"), ADDRESS, BACKPACKS["ywrobot"], backlight_active_low=False)
        self.display = Watched(Hd44780(port, pauses.sleep))
        self.clock = HandSet()
        self.rows = FIRST
        self.thread = DisplayThread(self.display, self._asked, self.clock, retry_s=RETRY_S)

    def _asked(self, _now_s: float) -> tuple[str, str]:
        self.display.count("asks")
        return self.rows


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.fixture
def running(bench: Bench) -> Iterator[Bench]:
    bench.thread.start()
    yield bench
    bench.wire.release()
    bench.thread.stop()


def test_it_shows_what_it_should_and_follows(running: Bench) -> None:
    assert running.display.wait(shows=1)
    assert running.glass.text() == FIRST
    running.rows = SECOND
    assert running.display.wait(shows=2)
    assert running.glass.text() == SECOND
    assert running.glass.violations == 0


def test_it_writes_only_what_has_changed(running: Bench) -> None:
    assert running.display.wait(asks=4)
    assert running.display.shows == 1


def test_a_fresh_start_now_and_then_repairs_what_sparks_did(running: Bench) -> None:
    assert running.display.wait(shows=1)
    enable = 1 << BACKPACKS["ywrobot"]["e"]
    running.wire.write_byte(ADDRESS, enable)
    running.wire.write_byte(ADDRESS, 0)  # half a byte that the driver never sent
    running.rows = SECOND
    assert running.display.wait(shows=2)
    assert running.glass.text() != SECOND
    running.clock.now_s += RESET_EVERY_S
    assert running.display.wait(resets=2, shows=3)
    assert running.glass.text() == SECOND


def test_gone_it_says_so_once_and_back_it_shows_again(running: Bench, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, "rotator.runtime.display")
    assert running.display.wait(shows=1)
    running.wire.gone.add(ADDRESS)
    running.rows = SECOND
    assert running.display.wait(failures=1)
    running.wire.gone.clear()
    assert running.display.wait(shows=2)
    assert running.glass.text() == SECOND
    messages = [record.message for record in caplog.records if record.name == "rotator.runtime.display"]
    assert len(messages) == 2
    assert messages[0].startswith("display: I2C bus 1: the device does not answer")
    assert messages[1] == "display: answers again"


def test_a_display_that_was_never_there_holds_up_nothing(bench: Bench) -> None:
    bench.wire.gone.add(ADDRESS)
    bench.thread.start()
    assert bench.display.wait(failures=1)
    bench.thread.stop()  # it waits to try again, and is woken from that
    assert DISPLAY_THREAD not in {thread.name for thread in threading.enumerate()}
