"""Every command of the relay bank ends by itself, with any line failing; and the thread that waits for it is woken."""

from __future__ import annotations

import threading
from contextlib import suppress

import pytest

from firmware_sim.clock import SimClock
from hw.drives.motor_supply import MASTER_LINGER_S
from hw.drives.relays import RelayBank
from hw.ports import HardwareError
from tests.hw.drives.relay_bench import AZ, DEAD_TIME_S, EL, MINUS, OFF, PINS, PLUS, Bench
from tests.tables import every_row

# --- every command ends by itself


class OneLineStuck:
    """Outputs of which the azimuth's cannot be switched off."""

    def __init__(self, *, master: bool = False) -> None:
        self.levels = dict.fromkeys((*PINS, "master") if master else PINS, False)

    def set(self, levels: dict[str, bool]) -> None:
        if levels.get("azimuth_cw") is False and self.levels["azimuth_cw"]:
            raise HardwareError("GPIO: cannot switch azimuth_cw")
        self.levels.update(levels)

    def close(self) -> None:
        pass


def test_a_line_that_fails_keeps_no_other_axis_on() -> None:
    clock, lines = SimClock(), OneLineStuck()
    bank = RelayBank(lines, clock, dead_time_s=DEAD_TIME_S)
    bank.drive(AZ, PLUS, 0.2)
    bank.drive(EL, PLUS, 0.2)
    clock.sleep(0.3)
    with pytest.raises(HardwareError):
        bank.enforce(clock())
    assert not lines.levels["elevation_up"]


def test_a_line_that_fails_takes_the_supply_of_all_motors_at_once() -> None:
    clock, lines = SimClock(), OneLineStuck(master=True)
    bank = RelayBank(lines, clock, dead_time_s=DEAD_TIME_S, master=True)
    bank.drive(AZ, PLUS, 0.2)
    bank.drive(EL, PLUS, 0.4)
    assert lines.levels["master"]
    clock.sleep(0.2)
    with pytest.raises(HardwareError, match="cannot switch azimuth_cw"):
        bank.enforce(clock())
    assert not lines.levels["master"]


class MasterStuck(OneLineStuck):
    """Outputs of which the master alone cannot be switched off."""

    def set(self, levels: dict[str, bool]) -> None:
        if levels.get("master") is False and self.levels["master"]:
            raise HardwareError("GPIO: cannot switch master")
        self.levels.update(levels)


def test_a_master_that_cannot_be_opened_is_an_error_and_is_tried_again() -> None:
    clock, lines = SimClock(), MasterStuck(master=True)
    bank = RelayBank(lines, clock, dead_time_s=DEAD_TIME_S, master=True)
    bank.drive(AZ, PLUS, 0.2)
    clock.sleep(0.2)
    bank.enforce(clock())
    clock.sleep(MASTER_LINGER_S)
    for _ in range(2):
        with pytest.raises(HardwareError, match="cannot switch master"):
            bank.enforce(clock())
        assert bank.due_s() == pytest.approx(0.2 + MASTER_LINGER_S)


class NothingSwitches(OneLineStuck):
    def set(self, levels: dict[str, bool]) -> None:
        if any(self.levels.values()):
            raise HardwareError(f"GPIO: cannot switch {', '.join(levels)}")
        super().set(levels)


def test_of_several_failures_the_first_is_raised_and_the_next_try_is_due_at_once() -> None:
    clock, lines = SimClock(), NothingSwitches(master=True)
    bank = RelayBank(lines, clock, dead_time_s=DEAD_TIME_S, master=True)
    bank.drive(AZ, PLUS, 0.2)
    clock.sleep(0.3)
    for _ in range(2):
        with pytest.raises(HardwareError, match="cannot switch azimuth_cw, azimuth_ccw"):
            bank.enforce(clock())
        assert bank.driven()[AZ] is PLUS, "what is not known to be off counts as on"
        assert bank.due_s() == pytest.approx(0.2)


# --- when there is something to enforce


class Waiting:
    """A thread in `wait_until_due`, and whether it has come back."""

    def __init__(self, bank: RelayBank, patience_s: float) -> None:
        self.back = threading.Event()
        self._thread = threading.Thread(target=self._wait, args=(bank, patience_s), daemon=True)
        self._thread.start()

    def _wait(self, bank: RelayBank, patience_s: float) -> None:
        bank.wait_until_due(patience_s)
        self.back.set()


def test_a_command_wakes_the_thread_that_waits() -> None:
    bench = Bench(guarded=False)
    waiting = Waiting(bench.bank, 3600.0)
    assert not waiting.back.wait(0.05), "nothing is due: it sleeps"
    for _ in range(1000):
        bench.drive(AZ, PLUS, 0.2)
        bench.drive(AZ, OFF)
        if waiting.back.wait(0.02):
            return
    pytest.fail("it still waits")


# --- a line that fails as a relay closes


class FailsAfter:
    """Lines that switch, and then report a failure so many times."""

    def __init__(self, failures: int) -> None:
        self.failures = failures
        self.on: set[str] = set()

    def set(self, levels: dict[str, bool]) -> None:
        for name, level in levels.items():
            (self.on.add if level else self.on.discard)(name)
        if self.failures:
            self.failures -= 1
            raise HardwareError("cannot switch, says the kernel, though it has")

    def close(self) -> None:
        """There is nothing to release."""


@every_row("master", [False, True])
@every_row("failures", [1, 2, 3])
def test_a_relay_that_closed_though_its_line_failed_is_opened_and_is_known_to_have_run(
    failures: int, master: bool
) -> None:
    clock, lines = SimClock(100.0), FailsAfter(failures)
    bank = RelayBank(lines, clock, dead_time_s=DEAD_TIME_S, master=master)
    with pytest.raises(HardwareError):
        bank.drive(AZ, PLUS, clock() + 0.25)
    for _ in range(2):
        clock.sleep(0.01)
        with suppress(HardwareError):
            bank.enforce(clock())
    assert "azimuth_cw" not in lines.on
    assert bank.driven()[AZ] is OFF
    assert bank.drive(AZ, MINUS, clock() + 0.25) is OFF, "a reversal waits for its dead time"
    clock.sleep(DEAD_TIME_S)
    assert bank.drive(AZ, MINUS, clock() + 0.25) is MINUS
