"""The Pi's lines and buses: each opened once, when asked for, and all let go of together."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from hw.buses.gpio import LinesBusyError
from hw.ports import HardwareError
from rotator.assembly.buses import Board
from rotator.assembly.simulation import SimulatedStation
from rotator.config.adc import Adc
from rotator.config.model import Config

PINS = {"one": 17, "two": 27}


@pytest.fixture
def world() -> SimRotor:
    clock = SimClock()
    return SimulatedStation(Config(), clock, None, (0.0, 0.0)).build()


@pytest.fixture
def opened() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def board(world: SimRotor, opened: ExitStack) -> Board:
    return Board(world, opened, time.monotonic, time.sleep)


def test_the_chip_is_the_one_with_the_header(board: Board, world: SimRotor) -> None:
    assert board.chip() in world.gpio.paths()
    assert board.chip() == board.chip()


def test_or_the_one_the_file_names(world: SimRotor, opened: ExitStack) -> None:
    board = Board(world, opened, time.monotonic, time.sleep, chip="/dev/gpiochip4")
    assert board.chip() == "/dev/gpiochip4"


def test_a_bus_is_opened_once_whoever_asks(board: Board) -> None:
    assert board.bus(1) is board.bus(1)


def test_outputs_are_taken_and_given_back(board: Board, world: SimRotor, opened: ExitStack) -> None:
    outputs = board.outputs("rotator-test", PINS)
    outputs.set({"one": True})
    assert world.gpio.level(17)
    with pytest.raises(LinesBusyError, match="one on GPIO17"):
        board.outputs("rotator-again", {"one": 17})
    opened.close()
    Board(world, ExitStack(), time.monotonic, time.sleep).outputs("rotator-again", PINS)


def test_active_low_outputs_are_off_at_high(board: Board, world: SimRotor) -> None:
    board.outputs("rotator-test", PINS, active_low=True)
    assert [world.gpio.level(pin) for pin in PINS.values()] == [True, True]


def test_a_contact_is_read_through_its_polarity(board: Board, world: SimRotor) -> None:
    contact = board.contact("rotator-test", 17, active_low=True, pull=True, debounce_s=0.0)
    assert not contact.closed(), "the pull holds it at the open contact's level"
    world.gpio.drive_input(17, False)
    assert contact.closed()


def test_everything_goes_in_the_opposite_order(world: SimRotor) -> None:
    gone: list[str] = []
    with ExitStack() as opened:
        board = Board(world, opened, time.monotonic, time.sleep)
        board.bus(1)
        opened.callback(gone.append, "before the lines")
        lines = board.outputs("rotator-test", PINS)
        opened.callback(gone.append, "after the lines")
    assert gone == ["after the lines", "before the lines"]
    with pytest.raises(Exception, match="released"):
        lines.set({"one": True})
    with pytest.raises(HardwareError):
        board.bus(1).write(0x48, b"\x00")


@pytest.mark.parametrize(("pin", "works"), [(8, True), (7, True), (26, False)])
def test_the_kernels_spi_has_two_selects(pin: int, works: bool) -> None:
    adc = Adc.model_validate({"kind": "mcp3208", "spi": "kernel", "select": pin})
    config = Config(adc=adc)
    rotor = SimulatedStation(config, SimClock(), None, (0.0, 0.0)).build()
    with ExitStack() as opened:
        board = Board(rotor, opened, time.monotonic, time.sleep)
        if works:
            assert len(board.spi(*adc.spi_uses()).exchange("select", b"\x06\x00\x00")) == 3
        else:
            with pytest.raises(HardwareError, match=r"adc\.select = 26 is no select of the kernel's SPI: take 8 or 7"):
                board.spi(*adc.spi_uses())
