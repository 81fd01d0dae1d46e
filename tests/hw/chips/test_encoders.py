"""The drivers of the encoders on simulated chips: the share of a turn, a bad magnet, a broken wire.

The AS5600 has a file of its own. What a real chip puts on the wire stands in `tests/firmware_sim/chips/test_encoders`.
"""

from __future__ import annotations

from typing import Any

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.as5045 import As5045 as SimAs5045
from firmware_sim.chips.as5048 import As5048a as SimAs5048a
from firmware_sim.chips.as5048 import As5048b as SimAs5048b
from firmware_sim.chips.magnet import MagnetFault
from firmware_sim.chips.mt6701 import Mt6701 as SimMt6701
from firmware_sim.chips.mt6701 import Mt6701Ssi as SimMt6701Ssi
from hw.buses.i2c import SmbusI2C
from hw.buses.spi import KernelSpi
from hw.chips.as5045 import As5045
from hw.chips.as5048 import As5048a, As5048b
from hw.chips.magnet import MagneticEncoder
from hw.chips.mt6701 import Mt6701, Mt6701Ssi
from hw.ports import HardwareError

Chip = SimAs5045 | SimAs5048a | SimAs5048b | SimMt6701 | SimMt6701Ssi


def on_spi(driver: type[As5045 | As5048a | Mt6701Ssi], chip: Any, mode: int, zero_turn: float = 0.0) -> MagneticEncoder:
    bus = KernelSpi(SimSpidev({(0, 0): chip}), 0, {"select": 0}, mode=mode)
    return driver(bus, "select", zero_turn=zero_turn)


def on_i2c(driver: type[As5048b | Mt6701], chip: Any, address: int, zero_turn: float = 0.0) -> MagneticEncoder:
    wire = SimI2CBus()
    wire.attach(address, chip)
    return driver(SmbusI2C(wire, "bus 1"), address, zero_turn=zero_turn)


class Bench:
    """One encoder of each kind, each over a magnet at `turn`."""

    def __init__(self, kind: str, zero_turn: float = 0.0) -> None:
        self.turn = 0.3
        self.chip: Chip
        match kind:
            case "AS5045":
                self.chip = SimAs5045(lambda: self.turn, noise_deg_rms=0.0)
                self.driver = on_spi(As5045, self.chip, 2, zero_turn)
            case "AS5048A":
                self.chip = SimAs5048a(lambda: self.turn, noise_deg_rms=0.0)
                self.driver = on_spi(As5048a, self.chip, 1, zero_turn)
            case "AS5048B":
                self.chip = SimAs5048b(lambda: self.turn, noise_deg_rms=0.0)
                self.driver = on_i2c(As5048b, self.chip, 0x40, zero_turn)
            case "MT6701":
                self.chip = SimMt6701(lambda: self.turn, noise_deg_rms=0.0)
                self.driver = on_i2c(Mt6701, self.chip, 0x06, zero_turn)
            case _:
                self.chip = SimMt6701Ssi(lambda: self.turn, noise_deg_rms=0.0)
                self.driver = on_spi(Mt6701Ssi, self.chip, 2, zero_turn)

    def refused(self) -> str:
        with pytest.raises(HardwareError) as refused:
            self.driver.read()
        return str(refused.value)


KINDS = ["AS5045", "AS5048A", "AS5048B", "MT6701", "MT6701 on SSI"]
ON_SPI = ["AS5045", "AS5048A", "MT6701 on SSI"]


@pytest.mark.parametrize("kind", KINDS)
def test_the_reading_is_the_share_of_a_turn(kind: str) -> None:
    bench = Bench(kind)
    steps = 4096 if kind == "AS5045" else 16384
    for code in (1, 2, steps // 4, steps // 3, steps // 2, steps - 1):
        bench.turn = code / steps
        assert bench.driver.read() == code / steps
    moved = Bench(kind, zero_turn=0.75)
    moved.turn = 0.5
    assert moved.driver.read() == 0.75


@pytest.mark.parametrize(
    ("kind", "fault", "words"),
    [
        ("AS5045", MagnetFault.MISSING, "AS5045: the magnet is missing, too far, too near, or beside the middle"),
        ("AS5045", MagnetFault.WEAK, "the magnet is missing, too far, too near"),
        ("AS5045", MagnetFault.STRONG, "the magnet is missing, too far, too near"),
        ("AS5048A", MagnetFault.MISSING, "AS5048A: there is no magnet, or it is too far or too weak"),
        ("AS5048A", MagnetFault.STRONG, "the magnet is too strong or too near"),
        ("AS5048B", MagnetFault.WEAK, "AS5048B at 0x40: there is no magnet, or it is too far or too weak"),
        ("AS5048B", MagnetFault.STRONG, "the magnet is too strong or too near"),
        ("MT6701 on SSI", MagnetFault.MISSING, "MT6701: the magnet is missing, too far, too near"),
        ("MT6701 on SSI", MagnetFault.STRONG, "the magnet is missing, too far, too near"),
    ],
)
def test_a_magnet_that_cannot_be_relied_on(kind: str, fault: MagnetFault, words: str) -> None:
    bench = Bench(kind)
    bench.chip.fault = fault
    assert words in bench.refused()
    bench.chip.fault = MagnetFault.NONE
    assert bench.driver.read() == pytest.approx(0.3, abs=1 / 4096)


class Held:
    """A data line that something holds at one level."""

    def __init__(self, level: bool) -> None:
        self.so = level

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        pass


@pytest.mark.parametrize("level", [False, True])
@pytest.mark.parametrize(("driver", "mode"), [(As5045, 2), (As5048a, 1), (Mt6701Ssi, 2)])
def test_a_line_held_at_one_level_is_no_angle(
    driver: type[As5045 | As5048a | Mt6701Ssi], mode: int, level: bool
) -> None:
    with pytest.raises(HardwareError, match="does not answer; look at its supply"):
        on_spi(driver, Held(level), mode).read()


SPOILT = {"the answer arrives with errors"}


@pytest.mark.parametrize("kind", ON_SPI)
def test_one_turned_bit_is_seen_each_time(kind: str) -> None:
    """Parity and checksum find every single error, wherever it is; the next answer is good again."""
    bench = Bench(kind)
    assert isinstance(bench.chip, SimAs5045 | SimAs5048a | SimMt6701Ssi)
    good, spoilt = 0, set()
    bench.chip.sparks.every = 4
    for _ in range(400):
        try:
            assert bench.driver.read() == pytest.approx(0.3, abs=1 / 4096)
            good += 1
        except HardwareError as fault:
            spoilt.add(str(fault).partition(": ")[2].partition(";")[0])
    assert good > 50
    assert spoilt <= SPOILT
    assert "the answer arrives with errors" in spoilt


def test_the_error_flag_of_an_as5048a_is_cleared() -> None:
    """A spark on the way to the chip: its next answers carry the flag until somebody clears it."""
    bench = Bench("AS5048A")
    assert isinstance(bench.chip, SimAs5048a)
    bench.chip.took(0x7FFF, 16)  # READ ANGLE with wrong parity
    assert "arrives with errors" in bench.refused()
    assert bench.driver.read() == pytest.approx(0.3, abs=1 / 16384)


def test_a_chip_that_starts() -> None:
    bench = Bench("AS5045")
    assert isinstance(bench.chip, SimAs5045)
    bench.chip.started = False
    assert bench.refused().startswith("AS5045: it has not finished its start")


def test_a_magnet_that_an_mt6701_lost() -> None:
    bench = Bench("MT6701 on SSI")
    assert isinstance(bench.chip, SimMt6701Ssi)
    bench.chip.track_lost = True
    assert "turned too fast for the chip" in bench.refused()


@pytest.mark.parametrize(("registers", "words"), [(b"\x12\x40\x01", "errors"), (b"\xff\xff\xff", "errors")])
def test_bits_that_an_as5048b_does_not_have(registers: bytes, words: str) -> None:
    class Corrupted:
        asked = 0

        def write(self, data: bytes) -> None:
            self.asked = data[0]

        def read(self, count: int) -> bytes:
            return registers[:2] if self.asked == 0xFE else registers[2:]

    with pytest.raises(HardwareError, match=words):
        on_i2c(As5048b, Corrupted(), 0x40).read()


@pytest.mark.parametrize("kind", ["AS5048A", "AS5048B", "MT6701"])
def test_nothing_is_ever_written_into_a_chip(kind: str) -> None:
    bench = Bench(kind)
    for fault in MagnetFault:
        bench.chip.fault = fault
        try:
            bench.driver.read()
        except HardwareError:
            continue
    assert not isinstance(bench.chip, SimAs5045 | SimMt6701Ssi)
    assert bench.chip.written == []
