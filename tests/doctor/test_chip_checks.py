"""The checks of sensor chips, output boards and SPI: on simulated chips, healthy and damaged."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import NoReturn

from hw.ports import HardwareError
from tests.doctor.conftest import Pi, runs

# --- I2C: every chip that the file names


def test_a_servo_board_at_another_address(pi: Pi) -> None:
    pi.kind("servo", "[servo]\naddress = 0x43\n")
    pi.config = pi.config.model_copy(update={"servo": pi.config.servo.model_copy(update={"address": 0x40})})
    assert pi.only("I2C devices").advice == "servo.address = 0x43"
    assert pi.only("PCA9685").mark == "–"


# --- PCA9685: MODE1 and PRE_SCALE


def test_a_servo_board_before_and_after_a_run(pi: Pi) -> None:
    pi.kind("servo")
    assert pi.only("PCA9685").found == "servo: 0x40 is a PCA9685, asleep until the box starts"
    pi.world.board.write(bytes([0x00, 0x20]))
    assert "still makes the pulses of the last run" in pi.only("PCA9685").found
    runs(pi)
    assert pi.only("PCA9685").found == "servo: 0x40 is a PCA9685, awake"


def test_a_board_that_waits_for_a_clock_from_outside(pi: Pi) -> None:
    pi.kind("servo")
    pi.world.board.write(bytes([0x00, 0x10]))
    pi.world.board.write(bytes([0x00, 0x50]))
    finding = pi.only("PCA9685")
    assert finding.ok is False
    assert "off and on" in finding.advice


def test_another_chip_at_the_boards_address(pi: Pi) -> None:
    pi.kind("servo")
    pi.world.bus.detach(0x40)
    pi.world.bus.attach(0x40, Zeros())
    assert pi.only("PCA9685").found == "servo: 0x40 is no PCA9685: MODE1 0x00, PRE_SCALE 0x00"


class Zeros:
    """A chip that has nothing to say."""

    def write(self, data: bytes) -> None:
        """Takes everything."""

    def read(self, count: int) -> bytes:
        return bytes(count)


# --- sensors


def test_gravity(pi: Pi) -> None:
    pi.kind("servo", '[elevation.sensor]\nkind = "mpu6050"\n')
    finding = pi.only("sensors")
    assert finding.ok
    assert re.fullmatch(r"elevation: MPU6050 at 0x68 feels 1 g, 4[45]\.\d° up", finding.found)
    pi.world.bus.detach(0x68)
    pi.world.bus.attach(0x68, Zeros())
    finding = pi.only("sensors")
    assert finding.ok is False
    assert "the chip's identity is 0x00" in finding.found


def test_a_socket_beside_the_state_file_tells_of_a_box_too(pi: Pi) -> None:
    runs(pi, "/var/lib/rotator/monitor")
    assert pi.only("pots").mark == "–"
    runs(pi, "/home/me/other/monitor")
    assert pi.found("pots")[0].mark == "✓"


# --- SPI


def test_without_spidev(pi: Pi) -> None:
    def missing() -> NoReturn:
        raise HardwareError("SPI: the Python package spidev cannot be loaded")

    pi.kind("digipot", '[digipot]\nspi = "kernel"\n')
    pi.change(chips=replace(pi.machine.chips, spidev=missing))
    finding = pi.found("SPI")[0]
    assert finding.ok is False
    assert "pip install 'spidev>=3.6'" in finding.advice
