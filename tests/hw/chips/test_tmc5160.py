"""The driver of the TMC5160 and TMC5130: the figures of their data sheets, and what a chip is asked and told."""

from __future__ import annotations

import pytest

from hw.chips import tmc5160
from hw.chips.tmc5160 import Model, Register, Tmc5160
from hw.ports import HardwareError


class Wire:
    """A bus that keeps the frames, and answers with registers of its own."""

    def __init__(self, registers: dict[int, int], status: int = 0) -> None:
        self.registers = registers
        self.status = status
        self.sent: list[bytes] = []
        self._asked = 0

    def send(self, chip: str, frame: bytes) -> None:
        self.sent.append(frame)

    def exchange(self, chip: str, frame: bytes) -> bytes:
        answer = bytes([self.status]) + self.registers.get(self._asked, 0).to_bytes(4, "big")
        self._asked = frame[0]
        return answer


def test_the_figures_of_the_data_sheet() -> None:
    """Section on the ramp generator: v[Hz] = v * fCLK / 2^24, a[Hz/s] = a * fCLK² / (512 * 256) / 2^24."""
    assert tmc5160.speed(100_000 * 12e6 / 2**24, 12e6) == 100_000
    assert tmc5160.acceleration(1000 * 12e6**2 / (512 * 256) / 2**24, 12e6) == 1000
    assert tmc5160.acceleration(0.001, 12e6) == 1
    assert tmc5160.speed(1e9, 12e6) == 2**23 - 512


@pytest.mark.parametrize(
    ("model", "run_a", "sense_ohm", "registers"),
    [
        # 0.325 V / 0.075 ohm / √2: full scale is 3.06 A.
        (Model.TMC5160, 3.06, 0.075, (0, 31)),
        (Model.TMC5160, 1.53, 0.075, (128, 31)),
        (Model.TMC5160, 0.1, 0.075, (32, 7)),
        # 0.325 V / (0.11 + 0.02) ohm / √2: 1.77 A.
        (Model.TMC5130, 1.767, 0.11, (0, 31)),
        (Model.TMC5130, 0.884, 0.11, (0, 15)),
    ],
)
def test_the_current(model: Model, run_a: float, sense_ohm: float, registers: tuple[int, int]) -> None:
    assert tmc5160.current(model, run_a, sense_ohm) == registers


def test_a_current_that_the_resistor_does_not_give() -> None:
    with pytest.raises(ValueError, match=r"with 0\.075 ohm the chip gives 3\.06 A at most"):
        tmc5160.current(Model.TMC5160, 4.0, 0.075)


@pytest.mark.parametrize(
    ("pins", "said"),
    [
        (0x00000000, "azimuth does not answer"),
        (0xFFFFFFFF, "azimuth does not answer"),
        (0x11000000, "azimuth is no TMC5160: its version is 0x11"),
        (0x30000040, "SD_MODE is high"),
    ],
)
def test_what_is_not_there_or_not_this_chip(pins: int, said: str) -> None:
    with pytest.raises(HardwareError, match=said):
        Tmc5160(Wire({0x04: pins}), "azimuth.select", Model.TMC5160, "azimuth").look()


def test_a_look() -> None:
    registers = {0x04: 0x30000000, 0x21: 0xFFFFFF00, 0x22: 0xFFFFFF, 0x6F: 1 << 27, 0x39: 512, 0x6C: 0x000100C3}
    look = Tmc5160(Wire(registers, status=0b0101_0001), "s", Model.TMC5160, "azimuth").look()
    assert (look.microsteps, look.encoder, look.speed) == (-256, 512, -1)
    assert (look.was_reset, look.at_speed, look.at_switch, look.feeds) == (True, True, True, True)
    assert look.driver_off == "coil A has a short to ground"


def test_a_place_is_given_while_the_ramp_holds() -> None:
    wire = Wire({})
    Tmc5160(wire, "s", Model.TMC5160, "azimuth").place(-1)
    assert [frame[0] & 0x7F for frame in wire.sent] == [
        Register.RAMPMODE, Register.XACTUAL, Register.XTARGET, Register.X_ENC, Register.RAMPMODE,
    ]  # fmt: skip
    assert (wire.sent[0][4], wire.sent[1][1:], wire.sent[-1][4]) == (3, b"\xff\xff\xff\xff", 0)
