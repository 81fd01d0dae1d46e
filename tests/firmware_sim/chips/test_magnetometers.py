"""The simulated QMC5883L and HMC5883L as their data sheets describe the chips, in bytes."""

from __future__ import annotations

import struct

import pytest

from firmware_sim.chips.hmc5883l import Hmc5883l
from firmware_sim.chips.qmc5883l import Qmc5883l

FIELD_UT = (20.0, -5.0, -44.0)


class Bench:
    def __init__(self) -> None:
        self.now_s = 10.0
        self.feels_ut = FIELD_UT

    def qmc(self) -> Qmc5883l:
        return Qmc5883l(lambda: self.now_s, lambda: self.feels_ut, noise_ut=0.0)

    def hmc(self, *, lsm303: bool = False) -> Hmc5883l:
        return Hmc5883l(lambda: self.now_s, lambda: self.feels_ut, lsm303=lsm303, noise_ut=0.0)


def read(chip: Qmc5883l | Hmc5883l, register: int, count: int = 1) -> bytes:
    chip.write(bytes([register]))
    return chip.read(count)


# --- QST QMC5883L, section 9


@pytest.mark.parametrize(("control", "steps"), [(0x05, 120), (0x15, 30)])
def test_a_qmc_has_x_y_z_low_byte_first(control: int, steps: int) -> None:
    bench = Bench()
    chip = bench.qmc()
    assert read(chip, 0x0D) == b"\xff"
    chip.write(bytes([0x09, control]))
    bench.now_s += 0.05
    assert struct.unpack("<hhh", read(chip, 0x00, 6)) == tuple(ut * steps for ut in FIELD_UT)


def test_a_read_of_the_data_clears_drdy_until_the_next_result() -> None:
    bench = Bench()
    chip = bench.qmc()
    bench.now_s += 1.0
    assert read(chip, 0x06) == b"\x00", "it waits for its mode"
    chip.write(b"\x09\x05")
    bench.now_s += 0.019
    assert read(chip, 0x06) == b"\x00"
    bench.now_s += 0.002
    assert read(chip, 0x06) == b"\x01"
    read(chip, 0x00, 6)
    assert read(chip, 0x06) == b"\x00"
    bench.now_s += 0.02
    read(chip, 0x06)
    bench.now_s += 0.02
    assert read(chip, 0x06) == b"\x05", "a result has been skipped"


def test_above_2_gauss_a_qmc_says_overflow() -> None:
    bench = Bench()
    chip = bench.qmc()
    chip.write(b"\x09\x05")
    bench.feels_ut = (280.0, 0.0, 0.0)
    bench.now_s += 0.05
    assert read(chip, 0x06) == b"\x03"
    assert struct.unpack("<hhh", read(chip, 0x00, 6)) == (32767, 0, 0)


def test_soft_reset_makes_a_qmc_wait() -> None:
    bench = Bench()
    chip = bench.qmc()
    chip.write(b"\x09\x05")
    chip.write(b"\x0a\x80")
    bench.now_s += 1.0
    assert read(chip, 0x06, 6) == bytes(6)


# --- Honeywell HMC5883L; ST LSM303DLHC, section 7.2


@pytest.mark.parametrize(
    ("lsm303", "gain", "steps"),
    [(False, 0x20, (1090, 1090)), (False, 0xE0, (230, 230)), (True, 0x20, (1100, 980)), (True, 0xE0, (230, 205))],
)
def test_an_hmc_has_x_z_y_high_byte_first(lsm303: bool, gain: int, steps: tuple[int, int]) -> None:
    bench = Bench()
    chip = bench.hmc(lsm303=lsm303)
    assert read(chip, 0x0A, 3) == b"H43"
    for register, value in ((0x00, 0x18), (0x01, gain), (0x02, 0x00)):
        chip.write(bytes([register, value]))
    bench.now_s += 0.05
    x, y, z = FIELD_UT
    assert struct.unpack(">hhh", read(chip, 0x03, 6)) == (
        round(x * steps[0] / 100),
        round(z * steps[1] / 100),
        round(y * steps[0] / 100),
    )
    assert read(chip, 0x09) == b"\x01"


def test_the_first_result_after_a_change_of_the_gain_has_the_old_one() -> None:
    bench = Bench()
    chip = bench.hmc()
    for register, value in ((0x00, 0x18), (0x01, 0xE0), (0x02, 0x00)):
        chip.write(bytes([register, value]))
    bench.now_s += 0.014
    assert struct.unpack(">hhh", read(chip, 0x03, 6))[0] == 218
    bench.now_s += 0.014
    assert struct.unpack(">hhh", read(chip, 0x03, 6))[0] == 46


def test_what_overflows_is_minus_4096() -> None:
    bench = Bench()
    chip = bench.hmc()
    chip.write(b"\x00\x18\x20\x00")
    bench.feels_ut = (200.0, 0.0, 0.0)
    bench.now_s += 0.05
    assert struct.unpack(">hhh", read(chip, 0x03, 6)) == (-4096, 0, 0)
