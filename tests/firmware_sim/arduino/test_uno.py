"""The UNO against its datasheet: pins, converter, counters, serial port. Knows nothing of the sketch."""

from __future__ import annotations

import pytest

from firmware_sim.arduino.uno import A0, A1, A5, HIGH, LOW, PinMode, Uno
from firmware_sim.clock import SimClock

BYTE_S = 10 / 9600


@pytest.fixture
def clock() -> SimClock:
    return SimClock()


@pytest.fixture
def board(clock: SimClock) -> Uno:
    return Uno(clock, clock.sleep)


@pytest.mark.parametrize(
    ("volts", "count"),
    [(0.0, 0), (0.004, 0), (0.005, 1), (2.5, 512), (4.994, 1022), (4.996, 1023), (5.0, 1023), (5.4, 1023), (-0.2, 0)],
)
def test_converter_counts_1024ths_of_the_supply(board: Uno, volts: float, count: int) -> None:
    board.analog_inputs[A0] = lambda: volts

    assert board.analog_read(A0) == count


def test_conversion_takes_104_us(board: Uno, clock: SimClock) -> None:
    board.analog_inputs[A5] = lambda: 1.0

    board.analog_read(A5)

    assert clock() == pytest.approx(104e-6)


def test_channel_0_is_pin_a0(board: Uno) -> None:
    board.analog_inputs[A0] = lambda: 2.5

    assert board.analog_read(0) == board.analog_read(A0) == 512


def test_open_input_reads_what_the_sampling_capacitor_still_holds(board: Uno) -> None:
    board.analog_inputs[A0] = lambda: 2.5

    assert board.analog_read(A1) == 0
    board.analog_read(A0)
    assert board.analog_read(A1) == 512


def test_outputs_tell_their_changes_and_inputs_drive_nothing(board: Uno, clock: SimClock) -> None:
    edges: list[tuple[float, int, bool]] = []
    board.on_pin.append(lambda now_s, pin, level: edges.append((now_s, pin, level)))

    board.digital_write(3, HIGH)  # still an input: the pull-up only
    board.pin_mode(3, PinMode.OUTPUT)  # the latch drives now
    clock.sleep(1.0)
    board.digital_write(3, HIGH)
    board.digital_write(3, LOW)
    board.digital_write(3, HIGH)
    clock.sleep(1.0)
    board.pin_mode(3, PinMode.INPUT)

    assert edges == [(0.0, 3, True), (1.0, 3, False), (1.0, 3, True), (2.0, 3, False)]


def test_digital_read(board: Uno) -> None:
    board.pin_mode(2, PinMode.OUTPUT)
    board.digital_write(2, HIGH)
    board.pin_mode(4, PinMode.INPUT_PULLUP)
    board.pin_mode(5, PinMode.INPUT_PULLUP)
    board.digital_inputs[5] = lambda: False

    assert board.digital_read(2) is HIGH
    assert board.digital_read(4) is HIGH
    assert board.digital_read(5) is LOW
    assert board.digital_read(6) is LOW


def test_counters_start_with_the_board(clock: SimClock) -> None:
    clock.sleep(5.0)
    board = Uno(clock, clock.sleep)

    board.delay(20)
    board.delay_microseconds(503)

    assert board.millis() == 20
    assert board.micros() == 20500  # in steps of 4


def test_counters_wrap_at_32_bits(board: Uno, clock: SimClock) -> None:
    clock.sleep(2**32 / 1e6 + 0.001)
    assert board.micros() == 1000
    clock.sleep_until(2**32 / 1e3 + 0.0075)
    assert board.millis() == 7


def test_a_byte_takes_ten_bits(board: Uno, clock: SimClock) -> None:
    board.serial.begin(9600)
    board.host_send(b"W2")

    clock.sleep(0.99 * BYTE_S)
    assert board.serial.available() == 0
    assert board.serial.read() == -1
    clock.sleep(0.02 * BYTE_S)
    assert board.serial.available() == 1
    clock.sleep(BYTE_S)
    assert [board.serial.read() for _ in range(3)] == [ord("W"), ord("2"), -1]


def test_full_receive_buffer_loses_the_newest(board: Uno, clock: SimClock) -> None:
    board.serial.begin(9600)
    board.host_send(bytes(range(70)))
    clock.sleep(1.0)

    assert board.serial.available() == 63
    assert board.serial.read() == 0
    board.host_send(b"\xff")
    clock.sleep(1.0)

    assert [board.serial.read() for _ in range(64)] == [*range(1, 63), 0xFF, -1]


def test_bytes_before_begin_are_lost(board: Uno, clock: SimClock) -> None:
    board.host_send(b"W235 025\r")
    assert board.serial.print("hello") == 0
    board.serial.begin(9600)
    clock.sleep(1.0)

    assert board.serial.available() == 0
    assert board.host_receive() == b""


def test_host_hears_what_has_come_over_the_line(board: Uno, clock: SimClock) -> None:
    board.serial.begin(9600)
    assert board.serial.print("hello") == 5

    clock.sleep(2.5 * BYTE_S)
    assert board.host_receive() == b"he"
    clock.sleep(1.0)
    assert board.host_receive() == b"llo"


def test_write_waits_only_when_the_ring_is_full(board: Uno, clock: SimClock) -> None:
    board.serial.begin(9600)

    board.serial.write(bytes(63))
    assert clock() == 0.0
    board.serial.write(bytes(20))
    assert clock() == pytest.approx(19 * BYTE_S)  # the first byte had already left the ring for the shift register
