"""The checks of sensor chips, output boards and SPI: on simulated chips, healthy and damaged."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import NoReturn

from hw.ports import HardwareError
from tests.doctor.conftest import STATION, Pi, runs

# --- I2C: every chip that the file names


def test_every_chip_is_asked_at_its_address(pi: Pi) -> None:
    pi.kind(
        "servo",
        '[elevation.sensor]\nkind = "mpu6050"\n[panel]\nazimuth_meter = 0\njog = 2\n'
        '[compass]\nkind = "bno055"\nbus = 1\n',
    )
    assert [finding.found for finding in pi.found("I2C devices")] == [
        "elevation.sensor: 0x68 answers",
        "servo: 0x40 answers",
        "panel.adc: 0x49 answers",
        "panel.outputs: 0x41 answers",
        "compass: 0x28 answers",
    ]


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


def test_a_board_that_was_reset_under_a_running_box(pi: Pi) -> None:
    pi.kind("servo")
    runs(pi)
    finding = pi.only("PCA9685")
    assert finding.ok is False
    assert "has been reset since the box started" in finding.found


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


AS5600 = '[azimuth.sensor]\nkind = "as5600"\n'


def with_as5600(pi: Pi, more: str = "") -> None:
    pi.station("", base=STATION.replace("[elevation]", f"{AS5600}{more}[elevation]"))


def test_a_magnet(pi: Pi) -> None:
    with_as5600(pi)
    assert pi.only("sensors").found == "azimuth: AS5600 at 0x36, its magnet is good, 0.250 of a turn"
    assert pi.only("pots").found.startswith("elevation: ")
    pi.world.inject("azimuth-magnet-missing")
    finding = pi.only("sensors")
    assert (finding.ok, finding.found) == (False, "azimuth: AS5600 at 0x36: there is no magnet")
    assert finding.advice == "Put one over the middle of the chip, 0.5 to 3 mm away."


def test_a_magnet_that_stands_where_its_reading_jumps(pi: Pi) -> None:
    with_as5600(pi, "zero_turn = 0.25\n")
    finding = pi.only("sensors")
    assert finding.ok is False
    assert "azimuth.sensor.zero_turn" in finding.advice


def test_a_sensor_that_does_not_answer_is_told_once(pi: Pi) -> None:
    with_as5600(pi)
    pi.world.inject("azimuth-as5600-gone")
    assert pi.only("sensors").mark == "–"
    assert any(finding.ok is False for finding in pi.found("I2C devices"))


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


def test_a_compass(pi: Pi) -> None:
    pi.kind("moteus", '[compass]\nkind = "bno055"\n')
    assert pi.only("sensors").found.endswith("° magnetic, magnetometer calibrated 0 of 3")
    pi.kind("moteus", '[compass]\nkind = "bno055"\nbus = 1\n')
    finding = pi.only("sensors")
    assert finding.mark == "!"
    assert "i2c-gpio" in finding.advice
    pi.write("/proc/device-tree/model", "Raspberry Pi 5 Model B Rev 1.0\0")
    assert pi.only("sensors").mark == "✓"


def test_a_running_box_reads_its_sensors_itself(pi: Pi) -> None:
    with_as5600(pi)
    runs(pi)
    assert pi.only("sensors").mark == "–"
    assert pi.only("pots").mark == "–"


def test_a_socket_beside_the_state_file_tells_of_a_box_too(pi: Pi) -> None:
    runs(pi, "/var/lib/rotator/monitor")
    assert pi.only("pots").mark == "–"
    runs(pi, "/home/me/other/monitor")
    assert pi.found("pots")[0].mark == "✓"


# --- SPI


def test_the_kernels_spi(pi: Pi) -> None:
    pi.kind("digipot", '[digipot]\nspi = "kernel"\n')
    first, second = pi.found("SPI")
    assert first.found == "/dev/spidev0.0 is not there"
    assert "dtparam=spi=on" in first.advice
    pi.write("/dev/spidev0.0")
    pi.write("/dev/spidev0.1")
    first, second = pi.found("SPI")
    assert (first.mark, second.found) == ("✓", "/dev/spidev0.1 is there and may be opened")


def test_without_spidev(pi: Pi) -> None:
    def missing() -> NoReturn:
        raise HardwareError("SPI: the Python package spidev cannot be loaded")

    pi.kind("digipot", '[digipot]\nspi = "kernel"\n')
    pi.change(chips=replace(pi.machine.chips, spidev=missing))
    finding = pi.found("SPI")[0]
    assert finding.ok is False
    assert "pip install 'spidev>=3.6'" in finding.advice


def test_digital_pots_on_lines_need_no_spi(pi: Pi) -> None:
    pi.kind("digipot")
    assert not pi.looks_at("SPI")
