"""The relay bank on simulated GPIO lines: the rules that no caller can bypass.

Off from the first instant; opposite relays never together; a reversal waits; every command ends by itself; the master
relay follows the motors.
"""

from __future__ import annotations

import math
import threading

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import LONGEST_LEASE_S, MASTER_LINGER_S, RELAYS, RelayBank
from hw.ports import Axis, Direction, HardwareError

CHIP = "/dev/gpiochip0"
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25}
MASTER_PIN = 26
DEAD_TIME_S = 0.5
MINUS, OFF, PLUS = Direction
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
EACH_AXIS = pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)


class Bench:
    """A bank with its four relays (and a master), and an alarm that stands in for the guard's thread."""

    def __init__(
        self, *, active_low: bool = False, master: bool = False, guarded: bool = True, one_at_a_time: bool = False
    ) -> None:
        self.clock = SimClock(100.0)
        self.gpio = SimGpio(self.clock)
        self.pins = PINS | ({"master": MASTER_PIN} if master else {})
        self.active_low = active_low
        lines = GpioOutputs(self.gpio, CHIP, self.pins, consumer="test", active_low=active_low)
        self.bank = RelayBank(lines, self.clock, dead_time_s=DEAD_TIME_S, master=master, one_at_a_time=one_at_a_time)
        if guarded:
            self.clock.add_alarm(self.bank.due_s, self.bank.enforce)

    def drive(self, axis: Axis, way: Direction, seconds: float = 0.25) -> Direction:
        return self.bank.drive(axis, way, self.clock() + seconds)

    def run(self, axis: Axis, way: Direction, seconds: float) -> None:
        """Keep a motor running, its command renewed every 50 ms as the control loop does."""
        for _ in range(round(seconds / 0.05)):
            self.drive(axis, way)
            self.clock.sleep(0.05)
        self.drive(axis, OFF)

    def on(self) -> set[str]:
        return {name for name, pin in self.pins.items() if self.gpio.level(pin) != self.active_low}


# --- off from the very call that takes the lines


@pytest.mark.parametrize("active_low", [False, True], ids=["active-high", "active-low"])
@pytest.mark.parametrize("pins", [(4, 5, 6, 7), (22, 23, 24, 25)], ids=["pulled-up", "pulled-down"])
def test_off_in_the_very_call_that_takes_the_lines(active_low: bool, pins: tuple[int, ...]) -> None:
    gpio = SimGpio(SimClock())
    GpioOutputs(gpio, CHIP, dict(zip(PINS, pins, strict=True)), consumer="test", active_low=active_low)
    assert [gpio.level(pin) for pin in pins] == [active_low] * 4
    # Where the boot pull meant on this is the edge that ends it; where it meant off there is none at all.
    assert all(edge.level == active_low for edge in gpio.edges)
    assert len(gpio.edges) == (0 if active_low == (pins[0] < 9) else 4)


@pytest.mark.parametrize("active_low", [False, True])
def test_each_direction_has_its_relay(active_low: bool) -> None:
    for (axis, way), name in RELAYS.items():
        bench = Bench(active_low=active_low)
        assert bench.drive(axis, way) is way
        assert bench.on() == {name}
        assert bench.bank.driven()[axis] is way


# --- a reversal waits out its dead time


@EACH_AXIS
@BOTH_WAYS
def test_a_reversal_opens_at_once_and_closes_after_the_dead_time(axis: Axis, way: Direction) -> None:
    bench = Bench()
    bench.drive(axis, way)
    assert bench.drive(axis, Direction(-way)) is OFF
    assert bench.on() == set()
    bench.clock.sleep(DEAD_TIME_S - 0.001)
    assert bench.drive(axis, Direction(-way)) is OFF
    bench.clock.sleep(0.001)
    assert bench.drive(axis, Direction(-way)) == -way
    assert bench.on() == {RELAYS[axis, Direction(-way)]}


def test_the_dead_time_counts_from_the_moment_the_relay_opened() -> None:
    bench = Bench()
    bench.drive(AZ, PLUS, 0.2)
    bench.clock.sleep(0.6)  # 0.4 s after its command ended
    assert bench.drive(AZ, MINUS) is OFF
    bench.clock.sleep(0.101)
    assert bench.drive(AZ, MINUS) is MINUS


def test_everything_off_is_a_stop_like_any_other() -> None:
    bench = Bench()
    bench.drive(AZ, PLUS)
    bench.bank.off()
    assert bench.drive(AZ, MINUS) is OFF


def test_the_same_direction_goes_on_at_once() -> None:
    bench = Bench()
    bench.drive(AZ, PLUS)
    bench.drive(AZ, OFF)
    assert bench.drive(AZ, PLUS) is PLUS


def test_one_axis_does_not_wait_for_the_other() -> None:
    bench = Bench()
    bench.run(AZ, PLUS, 0.2)
    assert bench.drive(EL, MINUS) is MINUS
    assert bench.on() == {"elevation_down"}


# --- every command ends by itself


@pytest.mark.parametrize("asked_s", [0.02, 0.25, LONGEST_LEASE_S, 0.51, 3600.0, math.inf])
def test_without_renewal_the_relay_opens(asked_s: float) -> None:
    bench = Bench()
    bench.drive(EL, PLUS, asked_s)
    bench.clock.sleep(60.0)
    on, off = bench.gpio.edges
    assert off.at_s - on.at_s == pytest.approx(min(asked_s, 0.5))


def test_a_renewed_command_runs_on_without_a_click() -> None:
    bench = Bench()
    bench.run(AZ, PLUS, 5.0)
    assert len(bench.gpio.edges) == 2
    assert bench.gpio.edges[1].at_s == pytest.approx(105.0)


@pytest.mark.parametrize("left_s", [0.1, 0.0])
def test_a_command_may_be_shortened(left_s: float) -> None:
    bench = Bench()
    bench.drive(AZ, PLUS, 0.4)
    bench.drive(AZ, PLUS, left_s)
    bench.clock.sleep(left_s)
    assert bench.on() == set()


def test_enforcing_early_opens_nothing() -> None:
    bench = Bench(guarded=False)
    bench.drive(AZ, PLUS, 0.2)
    bench.bank.enforce(bench.clock() + 0.199)
    assert bench.on() == {"azimuth_cw"}
    bench.bank.enforce(bench.clock() + 0.2)
    assert bench.on() == set()


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


def test_a_master_that_cannot_be_opened_is_told_and_tried_again() -> None:
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


def test_of_several_failures_the_first_is_told_and_the_next_try_is_due_at_once() -> None:
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


def test_due_is_the_earliest_end_of_what_is_on() -> None:
    bench = Bench(guarded=False)
    assert bench.bank.due_s() is None
    bench.drive(AZ, PLUS, 0.4)
    bench.drive(EL, PLUS, 0.3)
    assert bench.bank.due_s() == pytest.approx(100.3)
    bench.drive(EL, OFF)
    assert bench.bank.due_s() == pytest.approx(100.4)
    bench.bank.off()
    assert bench.bank.due_s() is None


class Waiting:
    """A thread in `wait_until_due`, and whether it has come back."""

    def __init__(self, bank: RelayBank, patience_s: float) -> None:
        self.back = threading.Event()
        self._thread = threading.Thread(target=self._wait, args=(bank, patience_s), daemon=True)
        self._thread.start()

    def _wait(self, bank: RelayBank, patience_s: float) -> None:
        bank.wait_until_due(patience_s)
        self.back.set()


def test_who_waits_for_the_next_end_comes_back_at_once_when_it_is_due() -> None:
    bench = Bench(guarded=False)
    bench.drive(AZ, PLUS, 0.2)
    bench.clock.sleep(0.2)
    bench.bank.wait_until_due(math.inf)  # else this test would not end
    bench.clock.sleep(5.0)
    bench.bank.wait_until_due(math.inf)


def test_who_waits_has_no_more_patience_than_was_asked() -> None:
    bench = Bench(guarded=False)
    bench.bank.wait_until_due(0.001)
    bench.drive(AZ, PLUS, 0.5)
    bench.bank.wait_until_due(0.001)
    assert bench.on() == {"azimuth_cw"}, "and nothing else happens"


def test_a_command_wakes_who_waits() -> None:
    bench = Bench(guarded=False)
    waiting = Waiting(bench.bank, 3600.0)
    assert not waiting.back.wait(0.05), "nothing is due: it sleeps"
    for _ in range(1000):
        bench.drive(AZ, PLUS, 0.2)
        bench.drive(AZ, OFF)
        if waiting.back.wait(0.02):
            return
    pytest.fail("it still waits")


# --- the master


def test_the_master_closes_with_the_first_motor_and_lingers_after_the_last() -> None:
    bench = Bench(master=True)
    assert bench.on() == set()
    bench.drive(AZ, PLUS)
    assert bench.on() == {"azimuth_cw", "master"}
    bench.clock.sleep(0.3)
    assert bench.bank.due_s() == pytest.approx(100.25 + MASTER_LINGER_S)
    bench.clock.sleep(MASTER_LINGER_S - 0.06)
    assert bench.on() == {"master"}
    bench.clock.sleep(0.02)
    assert bench.on() == set()


def test_the_master_stays_while_a_motor_runs_long() -> None:
    bench = Bench(master=True)
    bench.run(AZ, PLUS, 3 * MASTER_LINGER_S)
    assert [edge.level for edge in bench.gpio.edges if edge.offset == MASTER_PIN] == [True]


def test_a_correction_within_the_linger_does_not_click_the_master() -> None:
    bench = Bench(master=True)
    for _ in range(5):
        bench.run(AZ, PLUS, 0.2)
        bench.clock.sleep(MASTER_LINGER_S - 0.1)
    assert [edge.level for edge in bench.gpio.edges if edge.offset == MASTER_PIN] == [True]


# --- one motor at a time, for a small transformer


def test_while_one_motor_is_fed_the_other_is_not() -> None:
    bench = Bench(one_at_a_time=True)
    assert bench.drive(AZ, PLUS) is PLUS
    assert bench.drive(EL, MINUS) is OFF
    assert bench.on() == {"azimuth_cw"}
    assert bench.drive(AZ, PLUS) is PLUS, "the one that runs is not disturbed by the one that asks"
    bench.drive(AZ, OFF)
    assert bench.drive(EL, MINUS) is MINUS
    assert bench.drive(AZ, PLUS) is OFF, "who came first goes on, whichever axis it is"
    assert bench.on() == {"elevation_down"}


def test_a_command_that_waits_is_not_remembered() -> None:
    bench = Bench(one_at_a_time=True)
    bench.drive(AZ, PLUS, 0.2)
    bench.drive(EL, MINUS, 0.5)
    bench.clock.sleep(0.3)
    assert bench.on() == set(), "nothing starts by itself"


def test_asked_for_in_turn_the_second_starts_when_the_first_has_expired() -> None:
    bench = Bench(one_at_a_time=True)
    bench.drive(AZ, PLUS, 0.2)
    for _ in range(10):
        bench.drive(EL, PLUS)
        bench.clock.sleep(0.05)
    assert bench.on() == {"elevation_up"}


def test_a_reversal_waits_for_the_dead_time_and_for_the_other_motor() -> None:
    bench = Bench(one_at_a_time=True)
    bench.run(AZ, PLUS, 1.0)
    bench.drive(EL, PLUS, 0.5)
    assert bench.drive(AZ, MINUS) is OFF
    bench.clock.sleep(DEAD_TIME_S)
    assert bench.on() == set()
    assert bench.drive(AZ, MINUS) is MINUS


def test_otherwise_both_run_together() -> None:
    bench = Bench()
    bench.drive(AZ, PLUS)
    assert bench.drive(EL, MINUS) is MINUS
    assert bench.on() == {"azimuth_cw", "elevation_down"}


# --- everything off


@pytest.mark.parametrize("master", [False, True])
def test_off_works_from_any_thread(master: bool) -> None:
    bench = Bench(master=master)
    bench.drive(AZ, PLUS)
    bench.drive(EL, MINUS)
    caller = threading.Thread(target=bench.bank.off)
    caller.start()
    caller.join(10.0)
    assert bench.on() == set()
    assert set(bench.bank.driven().values()) == {OFF}


def test_a_cut_takes_the_supply_and_keeps_it_until_restored() -> None:
    bench = Bench(master=True)
    bench.run(AZ, PLUS, 1.0)
    assert bench.bank.cut()
    assert bench.on() == set()
    assert bench.drive(EL, PLUS) is OFF
    assert bench.on() == set()
    bench.bank.restore()
    assert bench.on() == set(), "the supply comes with the next motor, not by itself"
    assert bench.drive(EL, PLUS) is PLUS
    assert bench.on() == {"elevation_up", "master"}


def test_without_a_master_a_cut_says_that_it_is_none() -> None:
    bench = Bench()
    bench.drive(EL, PLUS)
    assert not bench.bank.cut()
    assert bench.drive(AZ, PLUS) is PLUS, "the other axis is not to suffer for nothing"
