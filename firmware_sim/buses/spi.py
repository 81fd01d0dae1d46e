"""Simulated SPI: the kernel's controller in the shape of the module `spidev`, and a chip on four GPIO lines.

Knows clocks and selects, in all four modes. Knows no chip. Not simulated: the time of a transfer.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

from firmware_sim.buses.gpio import SimGpio


class SpiChip(Protocol):
    """A chip at its pins."""

    @property
    def so(self) -> bool | None:
        """The level of its data output; None: it does not drive the line."""

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        """Take the levels of its inputs from now on; `cs` low selects the chip."""


@runtime_checkable
class TakesFrames(Protocol):
    """A chip that does the edges of a whole frame at once: that takes a tenth of the time."""

    def frame(self, values: Sequence[int]) -> list[int]:
        """As the edges of `pins` would: select, the bytes, release. Returns what it sent meanwhile."""


def wire_spi(gpio: SimGpio, chip: SpiChip, *, select: int, sck: int, si: int, so: int) -> None:
    """Connect the chip to lines that a program switches bit by bit."""
    watched = {select, sck, si}

    def lines_changed(_now_s: float, changes: Mapping[int, bool]) -> None:
        if watched & changes.keys():
            chip.pins(cs=gpio.level(select), sck=gpio.level(sck), si=gpio.level(si))
            gpio.drive_input(so, chip.so)

    gpio.on_edges.append(lines_changed)


class SimSpidev:
    """Takes the place of the module `spidev`. `chips[BUS, SELECT]` is the chip at /dev/spidevBUS.SELECT."""

    def __init__(self, chips: Mapping[tuple[int, int], SpiChip] | None = None) -> None:
        self.chips: dict[tuple[int, int], SpiChip] = dict(chips or {})

    def SpiDev(self) -> SimSpiDevice:  # noqa: N802 - spidev's own name
        return SimSpiDevice(self.chips)


class SimSpiDevice:
    """As `spidev.SpiDev`. `mode` is CPOL, 2, and CPHA, 1."""

    def __init__(self, chips: Mapping[tuple[int, int], SpiChip]) -> None:
        self.mode = 0
        self.max_speed_hz = 500_000
        self._chips = chips
        self._chip: SpiChip | None = None
        self._frames: TakesFrames | None = None

    def open(self, bus: int, device: int) -> None:
        if (bus, device) not in self._chips:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        chip = self._chip = self._chips[bus, device]
        self._frames = chip if isinstance(chip, TakesFrames) else None

    def xfer2(self, values: Sequence[int]) -> list[int]:
        """Select the chip, exchange each byte, release the chip. Modes 0 and 3 sample the output where the clock
        rises, 1 and 2 where it falls."""
        if self._chip is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        chip, rest, si = self._chip, self.mode >= 2, False
        sampled = self.mode in (1, 2)
        if self._frames is not None:
            return self._frames.frame(values)
        answer = []
        chip.pins(cs=True, sck=rest, si=si)
        chip.pins(cs=False, sck=rest, si=si)
        for value in values:
            octet = 0
            for bit in range(7, -1, -1):
                si = bool(value >> bit & 1)
                chip.pins(cs=False, sck=sampled, si=si)
                octet = octet << 1 | bool(chip.so)
                chip.pins(cs=False, sck=not sampled, si=si)
            answer.append(octet)
        chip.pins(cs=False, sck=rest, si=si)
        chip.pins(cs=True, sck=rest, si=si)
        return answer

    def close(self) -> None:
        self._chip = None
