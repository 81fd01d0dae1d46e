"""An encoder of two channels on simulated lines: A leads clockwise; an edge that is lost is not guessed."""

from __future__ import annotations

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import EVENTS_KEPT, GpioPair
from hw.sensors.quadrature import RESTS_S, QuadratureCounter

A, B = 16, 20
CLOCKWISE = ((A, True), (B, True), (A, False), (B, False))
"""A whole period: four counts."""


class Bench:
    def __init__(self, counts_per_deg: float = 20.0) -> None:
        self.clock = SimClock()
        self.gpio = SimGpio(self.clock)
        for pin in (A, B):
            self.gpio.drive_input(pin, False)
        pair = GpioPair(self.gpio, "/dev/gpiochip0", (A, B), consumer="test")
        self.counter = QuadratureCounter(pair, counts_per_deg, self.clock)
        self.counter.place(90.0)

    def turn(self, counts: int) -> None:
        """One whole period and more; negative: counter-clockwise."""
        levels = [(pin, level) for pin, level in CLOCKWISE]
        back = [(pin, not level) for pin, level in reversed(CLOCKWISE)]
        for count in range(abs(counts)):
            self.gpio.drive_input(*(levels if counts > 0 else back)[count % 4])


@pytest.mark.parametrize(("counts_per_deg", "there_deg"), [(20.0, 91.0), (-20.0, 89.0), (4.0, 95.0)])
def test_twenty_edges_there_and_back(counts_per_deg: float, there_deg: float) -> None:
    bench = Bench(counts_per_deg)
    bench.turn(20)
    assert bench.counter.read() == pytest.approx(there_deg)
    bench.turn(-20)
    assert bench.counter.read() == pytest.approx(90.0)
    assert (bench.counter.changes, bench.counter.trouble) == (40, "")


def test_a_magnet_that_trembles_on_an_edge_counts_to_and_fro() -> None:
    bench = Bench()
    for level in (True, False) * 50:
        bench.gpio.drive_input(A, level)
    assert bench.counter.read() == 90.0
    assert bench.counter.trouble == ""


def test_more_edges_than_the_kernel_keeps_make_the_count_doubtful_until_it_is_told() -> None:
    bench = Bench()
    bench.turn(EVENTS_KEPT)
    bench.counter.read()
    assert bench.counter.trouble == ""
    bench.turn(EVENTS_KEPT + 4)
    bench.counter.read()
    assert "edges of its encoder were lost" in bench.counter.trouble
    bench.counter.place(123.0)
    assert (bench.counter.read(), bench.counter.trouble) == (123.0, "")


def test_an_edge_of_the_same_level_twice_is_no_direction() -> None:
    class Channels:
        def levels(self) -> tuple[int, int]:
            return 0, 0

        def changes(self) -> list[tuple[int, int, int]]:
            return [(0, 1, 0), (0, 1, 0)]

    counter = QuadratureCounter(Channels(), 20.0, SimClock())
    counter.place(0.0)
    assert counter.read() == pytest.approx(0.05)
    assert "lost" in counter.trouble


def test_it_stands_a_second_after_its_last_count_while_its_motor_is_off() -> None:
    bench = Bench()
    bench.clock.sleep(10.0)
    bench.turn(1)
    bench.counter.read()
    assert not bench.counter.at_rest
    bench.clock.sleep(RESTS_S + 0.01)
    assert bench.counter.at_rest
    bench.counter.fed = lambda: (True, 0.0)
    assert not bench.counter.at_rest
    bench.counter.fed = lambda: (False, bench.clock() - 0.5)
    assert not bench.counter.at_rest
