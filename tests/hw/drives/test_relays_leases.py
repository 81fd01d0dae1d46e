"""What the relay bank reports to the sentinel: each lease before its relay closes, and the end of the last one."""

from __future__ import annotations

from collections.abc import Collection

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction, HardwareError

PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25, "master": 26}
MINUS, OFF, PLUS = Direction
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION


class Journal:
    """A watch that writes down what it hears, and what is on at that moment."""

    def __init__(self, gpio: SimGpio) -> None:
        self._gpio = gpio
        self.heard: list[tuple[str, bool]] = []
        self.gone = False

    def renew(self) -> None:
        if self.gone:
            raise HardwareError("the sentinel is gone")
        self.heard.append(("renew", self._any_on()))

    def rest(self) -> None:
        self.heard.append(("rest", self._any_on()))

    def unbraked(self, lines: Collection[str]) -> None:
        self.heard.append((f"unbraked {' '.join(lines)}".strip(), self._any_on()))

    def words(self) -> list[str]:
        return [word for word, _ in self.heard]

    def _any_on(self) -> bool:
        return any(self._gpio.level(pin) for name, pin in PINS.items() if name != "master")


class Bench:
    def __init__(self) -> None:
        self.clock = SimClock(100.0)
        self.gpio = SimGpio(self.clock)
        self.journal = Journal(self.gpio)
        lines = GpioOutputs(self.gpio, "/dev/gpiochip0", PINS, consumer="test")
        self.bank = RelayBank(lines, self.clock, dead_time_s=0.5, master=True, watch=self.journal)
        self.clock.add_alarm(self.bank.due_s, self.bank.enforce)

    def drive(self, axis: Axis, way: Direction) -> Direction:
        return self.bank.drive(axis, way, self.clock() + 0.25)


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_the_watch_hears_of_the_first_lease_before_the_relay_closes(bench: Bench) -> None:
    bench.drive(AZ, PLUS)
    assert bench.journal.heard == [("renew", False)]
    assert bench.gpio.level(22)


def test_the_watch_hears_of_the_end_when_the_relay_is_open(bench: Bench) -> None:
    bench.drive(AZ, PLUS)
    bench.drive(AZ, OFF)
    assert bench.journal.heard[-1] == ("rest", False)


def test_without_a_watch_no_relay_closes(bench: Bench) -> None:
    bench.journal.gone = True
    with pytest.raises(HardwareError, match="the sentinel is gone"):
        bench.drive(AZ, PLUS)
    assert not bench.gpio.level(22)


def test_a_watch_that_goes_away_stops_the_motor_by_its_lease(bench: Bench) -> None:
    bench.drive(AZ, PLUS)
    bench.journal.gone = True
    with pytest.raises(HardwareError):
        bench.drive(AZ, PLUS)
    bench.clock.sleep(0.3)
    assert not bench.gpio.level(22)


def test_a_look_at_the_supply_is_a_lease_and_the_watch_hears_of_its_end(bench: Bench) -> None:
    bench.bank.feed(AZ, bench.clock() + 0.25)
    assert bench.journal.words() == ["renew"]
    bench.clock.sleep(0.3)
    assert bench.journal.words() == ["renew", "rest"]
    assert not bench.gpio.level(26)
