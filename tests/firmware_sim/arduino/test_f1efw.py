"""The sketch on a bare board: bytes and pot volts in, relay pins out. Rotor and display are in test_station.py."""

from __future__ import annotations

import pytest

from firmware_sim.arduino.f1efw import CCW, CW, DOWN, RELAYS, UP, Coefficients, Direction, F1efwV4
from firmware_sim.arduino.uno import A0, A1, Uno
from firmware_sim.clock import SimClock

AZIMUTH_DEG_PER_COUNT = 450 / 1023
ELEVATION_DEG_PER_COUNT = 180 / 1023


class Bench:
    """A board with the sketch running and two voltages in place of the pots."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.board = Uno(self.clock, self.clock.sleep)
        self.volts = {A0: 0.0, A1: 0.0}
        self.board.analog_inputs[A0] = lambda: self.volts[A0]
        self.board.analog_inputs[A1] = lambda: self.volts[A1]
        self.sketch = F1efwV4(self.board, Coefficients(AZIMUTH_DEG_PER_COUNT, ELEVATION_DEG_PER_COUNT))
        self.sketch.setup()

    def antenna_at(self, azimuth_deg: float, elevation_deg: float) -> None:
        """Half a count over the step, so that the converter reads the count nearest to the angle."""
        self.volts[A0] = (round(azimuth_deg / AZIMUTH_DEG_PER_COUNT) + 0.5) / 1024 * 5
        self.volts[A1] = (round(elevation_deg / ELEVATION_DEG_PER_COUNT) + 0.5) / 1024 * 5

    def hear(self, *pieces: bytes) -> None:
        """Each piece comes in a turn of the loop of its own; then the line falls silent."""
        for piece in pieces:
            self.board.host_send(piece)
            self.clock.sleep(0.05)
            self.sketch.loop()
        self.sketch.loop()

    def closed(self) -> set[int]:
        return {pin for pin in RELAYS if self.board.level(pin)}


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.mark.parametrize(
    ("sent", "azimuth_deg", "elevation_deg"),
    [
        (b"W235 025", 235, 25),  # by hand from Termite, with no line end
        (b"W235 025\r", 235, 25),
        (b"W235 025\r\n", 235, 25),
        (b"w235 025\r", 235, 25),
        (b"W5 7\r", 5, 7),
        (b"W005   007\r", 5, 7),
        (b"W235,025\r", 235, 25),
        (b"W100 -05\r", 100, -5),
        (b"C2\rS\rW235 025\r", 235, 25),
        (b"WWW235 025\r", 235, 25),
        (b"noise W1 W235 025 noise", 235, 25),
        (b"W100 010\rW235 025\r", 235, 25),
        (b"W999 999\r", 999, 999),  # it knows no limits
    ],
)
def test_finds_an_order_in_what_arrives(bench: Bench, sent: bytes, azimuth_deg: int, elevation_deg: int) -> None:
    bench.hear(sent)

    assert bench.sketch.target == Direction(azimuth_deg, elevation_deg)
    assert bench.board.host_receive() == b""


@pytest.mark.parametrize(
    ("azimuth_deg", "elevation_deg", "closed"),
    [
        (235, 25, set()),
        (231.3, 25, set()),
        (230.6, 25, {CW}),
        (238.7, 25, set()),
        (239.4, 25, {CCW}),
        (235, 21.2, set()),
        (235, 20.8, {UP}),
        (235, 28.8, set()),
        (235, 29.2, {DOWN}),
        (100, 90, {CW, DOWN}),
        (300, 0, {CCW, UP}),
    ],
)
def test_a_relay_is_on_beyond_4_degrees(
    bench: Bench, azimuth_deg: float, elevation_deg: float, closed: set[int]
) -> None:
    bench.antenna_at(azimuth_deg, elevation_deg)

    bench.hear(b"W235 025\r")

    assert bench.closed() == closed


@pytest.mark.parametrize("order", [b"W100 000\r", b"W100 -01\r", b"W100 -90\r"])
def test_zero_or_negative_elevation_stops_both_motors(bench: Bench, order: bytes) -> None:
    bench.antenna_at(300, 90)
    bench.hear(b"W200 045\r")
    assert bench.closed() == {CCW, DOWN}

    bench.hear(order)

    assert bench.closed() == set()


def test_a_reversal_opens_one_relay_and_closes_the_other_at_once(bench: Bench) -> None:
    bench.antenna_at(100, 10)
    bench.hear(b"W200 010\r")
    edges: list[tuple[int, bool]] = []
    bench.board.on_pin.append(lambda _, pin, level: edges.append((pin, level)) if pin in RELAYS else None)

    bench.hear(b"W050 010\r")

    assert edges == [(CW, False), (CCW, True)]
