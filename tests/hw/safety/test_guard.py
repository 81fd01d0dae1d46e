"""The guard's thread in real time: relays open when their command expires, also when other parts hang, fail or die.

Waits for edges with timeouts far longer than anything should take. Asserts on the moments that the edges carry.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from hw.buses.gpio import GpioOutputs
from hw.buses.i2c import SmbusI2C
from hw.drives.leases import LONGEST_LEASE_S
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction, HardwareError
from hw.safety.guard import GUARD_THREAD, Guard

PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25, "master": 26}
PATIENCE_S = 20.0
SLACK_S = 2.0
"""How late a busy machine may wake a thread."""


LINE_FAILS = HardwareError("GPIO: cannot switch azimuth_cw: Input/output error")


class FragileLines:
    """GPIO lines that can be made to fail, all of them or only where fewer than `spared` are set at once."""

    def __init__(self, lines: GpioOutputs) -> None:
        self._lines = lines
        self.broken = False
        self.failure: BaseException = LINE_FAILS
        self.spared = len(PINS) + 1
        self.refused = threading.Event()

    def set(self, levels: dict[str, bool]) -> None:
        if self.broken and len(levels) < self.spared:
            self.refused.set()
            raise self.failure
        self._lines.set(levels)

    def close(self) -> None:
        self._lines.close()


class Bench:
    def __init__(self, *, master: bool = False) -> None:
        self.gpio = SimGpio(time.monotonic)
        self.gpio.on_edges.append(self._see)
        self.opened = threading.Event()
        self.lines = FragileLines(GpioOutputs(self.gpio, "/dev/gpiochip0", PINS, consumer="test"))
        self.bank = RelayBank(self.lines, time.monotonic, dead_time_s=0.05, master=master)

    def _see(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        if changes.get(PINS["azimuth_cw"]) is False:
            self.opened.set()

    def drive(self, seconds: float) -> None:
        self.opened.clear()
        self.bank.drive(Axis.AZIMUTH, Direction.PLUS, time.monotonic() + seconds)

    def run_once(self) -> None:
        """A motor ran and rests: from here on only the master is due, in ten seconds."""
        self.drive(0.1)
        self.bank.drive(Axis.AZIMUTH, Direction.OFF, time.monotonic())

    def rouse(self) -> None:
        """Wake each thread that still waits for the bank."""
        self.drive(0.01)
        self.bank.off()

    def on_for_s(self) -> float:
        """How long the CW relay was closed the last time."""
        closed, opened = [edge for edge in self.gpio.edges if edge.offset == PINS["azimuth_cw"]][-2:]
        assert (closed.level, opened.level) == (True, False)
        return opened.at_s - closed.at_s


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.fixture
def guard(bench: Bench) -> Iterator[Guard]:
    guard = Guard(bench.bank, time.monotonic, operator_must="CUT THE MOTOR POWER")
    guard.start()
    yield guard
    bench.lines.broken = False
    guard.stop()


@pytest.mark.usefixtures("guard")
def test_a_hung_bus_holds_no_relay_on(bench: Bench) -> None:
    bus = SimI2CBus()
    bus.hang()
    reading = threading.Event()

    def control() -> None:
        bench.drive(LONGEST_LEASE_S)
        reading.set()
        with pytest.raises(HardwareError):
            SmbusI2C(bus, "bus 1").write_read(0x48, b"\x00", 2)

    thread = threading.Thread(target=control)
    thread.start()
    assert reading.wait(PATIENCE_S)
    assert bench.opened.wait(PATIENCE_S)
    assert thread.is_alive(), "the control thread still hangs on the bus"
    assert bench.on_for_s() <= LONGEST_LEASE_S + SLACK_S
    bus.release()
    thread.join(PATIENCE_S)
    assert not thread.is_alive()


@pytest.mark.usefixtures("guard")
def test_a_line_that_cannot_be_set_is_tried_again_and_said_aloud(
    bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    bench.drive(0.05)
    bench.lines.broken = True
    assert bench.lines.refused.wait(PATIENCE_S)
    bench.lines.refused.clear()
    assert bench.lines.refused.wait(PATIENCE_S), "no second try"
    bench.lines.broken = False
    assert bench.opened.wait(PATIENCE_S)
    assert "CUT THE MOTOR POWER" in caplog.text


class MeddledClock:
    """A clock during whose first reading, between the guard's look and its sleep, another thread runs."""

    def __init__(self, meddle: Callable[[], None]) -> None:
        self._meddle: Callable[[], None] | None = meddle
        self.read = threading.Event()

    def __call__(self) -> float:
        meddle, self._meddle = self._meddle, None
        if meddle is not None:
            meddle()
            self.read.set()
        return time.monotonic()


def test_a_command_given_just_before_the_guard_falls_asleep_ends_in_time() -> None:
    bench = Bench(master=True)
    bench.run_once()
    clock = MeddledClock(lambda: bench.drive(0.1))
    guard = Guard(bench.bank, clock)
    guard.start()
    try:
        assert clock.read.wait(PATIENCE_S)
        assert bench.opened.wait(LONGEST_LEASE_S + SLACK_S)
    finally:
        guard.stop()
        bench.rouse()


# --- bugs


@pytest.mark.usefixtures("guard")
def test_a_bug_in_the_drive_is_logged_once_and_the_guard_goes_on(
    bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    bench.lines.failure = ZeroDivisionError("a bug")
    bench.drive(0.05)
    bench.lines.broken = True
    for _ in range(3):
        assert bench.lines.refused.wait(PATIENCE_S), "no further try"
        bench.lines.refused.clear()
    bench.lines.broken = False
    assert bench.opened.wait(PATIENCE_S)
    said = [record for record in caplog.records if "a bug" in record.getMessage()]
    assert len(said) == 1
    assert said[0].exc_info is not None, "its traceback says where"
    assert said[0].getMessage() == "CUT THE MOTOR POWER: ZeroDivisionError('a bug'); trying again"
    bench.drive(0.05)
    assert bench.opened.wait(PATIENCE_S), "it still guards"


@pytest.mark.usefixtures("guard")
def test_after_a_bug_the_relays_open_by_the_way_that_still_works(bench: Bench) -> None:
    """One motor's relays cannot be switched, all relays together can."""
    bench.lines.failure = ValueError("a bug that only two lines meet")
    bench.lines.spared = 3
    bench.drive(0.05)
    bench.lines.broken = True
    assert bench.opened.wait(PATIENCE_S)


class CannotWait:
    """The bank, but for the way in which the guard sleeps."""

    def __init__(self, bank: RelayBank, failure: BaseException) -> None:
        self._bank = bank
        self._failure = failure
        self.off, self.due_s, self.enforce = bank.off, bank.due_s, bank.enforce

    def wait_until_due(self, patience_s: float) -> None:
        self._bank.wait_until_due(patience_s)
        if self._bank.due_s() is not None:
            raise self._failure


def test_a_guard_that_cannot_wait_opens_the_relays(bench: Bench, caplog: pytest.LogCaptureFixture) -> None:
    guard = Guard(CannotWait(bench.bank, RuntimeError("a bug")), time.monotonic)
    guard.start()
    try:
        for _ in range(2):
            bench.drive(LONGEST_LEASE_S)
            assert bench.opened.wait(PATIENCE_S)
        guard.check()
    finally:
        guard.stop()
    assert caplog.text.count("Traceback") == 1


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_guard_that_has_died_says_so_when_it_is_asked(bench: Bench) -> None:
    guard = Guard(CannotWait(bench.bank, SystemExit()), time.monotonic)
    guard.check()
    guard.start()
    guard.check()
    bench.drive(0.01)
    for thread in threading.enumerate():
        if thread.name == GUARD_THREAD:
            thread.join(PATIENCE_S)
    with pytest.raises(HardwareError, match="the guard, which ends expired commands, has died"):
        guard.check()
    guard.stop()
    guard.check()
    assert not any(bench.gpio.level(pin) for pin in PINS.values())


class AlwaysDue:
    """A drive with something to enforce at every moment, which may fail each time. Counts the tries."""

    def __init__(self, *, fails: bool) -> None:
        self._fails = fails
        self.tries = 0
        self.many = {count: threading.Event() for count in (25, 2000)}

    def off(self) -> None:
        pass

    def due_s(self) -> float | None:
        return 0.0

    def wait_until_due(self, patience_s: float) -> None:
        assert patience_s == 1.0, "it looks at the drive once a second at least"

    def enforce(self, now_s: float) -> None:
        self.tries += 1
        if self.tries in self.many:
            self.many[self.tries].set()
        if self._fails:
            raise LINE_FAILS


def test_a_line_that_fails_is_tried_20_times_a_second_and_leaves_the_machine_its_time() -> None:
    drive = AlwaysDue(fails=True)
    guard = Guard(drive, time.monotonic)
    guard.start()
    try:
        assert drive.many[25].wait(PATIENCE_S), "at 20 Hz, 25 tries take little more than a second"
        assert drive.tries < 1000, "it pauses"
    finally:
        guard.stop()


# --- the end


def test_a_stop_that_fails_can_be_tried_again(bench: Bench, guard: Guard) -> None:
    bench.drive(0.5)
    bench.lines.broken = True
    with pytest.raises(HardwareError, match="Input/output error"):
        guard.stop()
    assert GUARD_THREAD not in [thread.name for thread in threading.enumerate()], "the thread has ended all the same"
    bench.lines.broken = False
    guard.stop()
    assert not any(bench.gpio.level(pin) for pin in PINS.values())
