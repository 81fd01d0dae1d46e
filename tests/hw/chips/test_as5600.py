"""The AS5600 driver on a simulated chip: the raw angle, and a magnet that cannot be relied on."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.as5600 import As5600 as SimAs5600
from firmware_sim.chips.magnet import MagnetFault
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.as5600 import ADDRESS, As5600
from hw.ports import HardwareError

STEP = 1 / 4096


class Bench:
    """A magnet over a chip, on a bus that takes its time."""

    def __init__(self, address: int = 0x36, noise_deg_rms: float = 0.0) -> None:
        self.clock = SimClock()
        self.turn = 0.3
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip = SimAs5600(lambda: self.turn, noise_deg_rms=noise_deg_rms)
        self.wire.attach(address, self.chip)

    def driver(self, address: int = ADDRESS, zero_turn: float = 0.0) -> As5600:
        return As5600(SmbusI2C(self.wire, "bus 1"), address, zero_turn=zero_turn)


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.mark.parametrize("turn", [0.0, STEP, 0.25, 0.5, 0.75, 1.0 - STEP])
def test_the_reading_is_the_share_of_a_turn(bench: Bench, turn: float) -> None:
    bench.turn = turn
    assert bench.driver().read() == turn


# --- what goes wrong


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        (MagnetFault.MISSING, "AS5600 at 0x36: there is no magnet; put one over the middle of the chip"),
        (MagnetFault.WEAK, "the magnet is too weak or too far; bring it nearer"),
        (MagnetFault.STRONG, "the magnet is too strong or too near; move it away"),
    ],
)
def test_a_magnet_that_cannot_be_relied_on(bench: Bench, fault: MagnetFault, words: str) -> None:
    sensor = bench.driver()
    bench.chip.fault = fault
    with pytest.raises(HardwareError, match=words):
        sensor.read()
    bench.chip.fault = MagnetFault.NONE
    assert sensor.read() == pytest.approx(0.3, abs=STEP)


class Corrupted:
    """A chip whose answers arrive with bits turned to ones."""

    def __init__(self, angle: bytes, status: bytes) -> None:
        self._answers = {b"\x0c": angle, b"\x0b": status}
        self._asked = b""

    def write(self, data: bytes) -> None:
        self._asked = data

    def read(self, count: int) -> bytes:
        return self._answers[self._asked]


@pytest.mark.parametrize(("angle", "status"), [(b"\x84\x00", b"\x20"), (b"\x04\x00", b"\xff"), (b"\xff\xff", b"\xff")])
def test_nonsense_is_no_angle(angle: bytes, status: bytes) -> None:
    wire = SimI2CBus()
    wire.attach(0x36, Corrupted(angle, status))
    with pytest.raises(HardwareError, match=r"the answer makes no sense .* shorten the I2C cable"):
        As5600(SmbusI2C(wire, "bus 1")).read()


def test_nothing_is_ever_written_into_the_chip(bench: Bench) -> None:
    sensor = bench.driver()
    for fault in MagnetFault:
        bench.chip.fault = fault
        try:
            sensor.read()
        except HardwareError:
            continue
    assert bench.chip.burns == []
    bench.chip.write(b"\x00")
    assert bench.chip.read(9) == bytes(9), "the settings are as they came"
