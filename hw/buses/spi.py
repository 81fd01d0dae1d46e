"""Frames to and from chips on SPI, most significant bit first: by the kernel's driver, or in mode 0 on GPIO lines.

Knows clock, data and select lines. Does not know what a frame means. The only importer of spidev.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any, Protocol

from hw.ports import HardwareError, OutputLines

SCK, SI, SO = "sck", "si", "so"
"""Clock, data to the chip, data from the chip."""
SPEED_HZ = 100_000
"""Slow on purpose: the wires to a control box are long, and a frame has 16 or 24 bits."""


class SpiBus(Protocol):
    """An SPI adapter as drivers use it; the chips are called by the names of their select lines."""

    def send(self, chip: str, frame: bytes) -> None:
        """Select the chip, clock the frame in, deselect the chip. Raises HardwareError when the lines cannot be set."""

    def exchange(self, chip: str, frame: bytes) -> bytes:
        """Send the frame, and return as many bytes that the chip sent meanwhile. Raises HardwareError."""


class AnswerLine(Protocol):
    """The data line from the chips: an input with a pull-up, which reads 1 while no chip drives it."""

    def read(self) -> dict[str, bool]:
        """`SO`: True while the line is at ground, which is a 0. Raises HardwareError."""


class LineSpi:
    """SPI on any GPIO lines. `selects` are requested as active low; `wires` are `SCK` and `SI`, active high.

    `answer`: the line `SO`; None: no chip here has an output.
    """

    def __init__(self, selects: OutputLines, wires: OutputLines, answer: AnswerLine | None = None) -> None:
        self._selects = selects
        self._wires = wires
        self._answer = answer
        self._lock = threading.Lock()

    def send(self, chip: str, frame: bytes) -> None:
        self._clock(chip, frame, None)

    def exchange(self, chip: str, frame: bytes) -> bytes:
        if self._answer is None:
            raise HardwareError(f"SPI: {chip} cannot answer: no line is wired to its output")
        return self._clock(chip, frame, self._answer)

    def _clock(self, chip: str, frame: bytes, answer: AnswerLine | None) -> bytes:
        received = 0
        with self._lock:
            self._selects.set({chip: True})
            try:
                for octet in frame:
                    for bit in range(7, -1, -1):
                        self._wires.set({SCK: False, SI: bool(octet >> bit & 1)})
                        # The chip sets its bit at the falling edge of the clock, and holds it over the rising edge.
                        received = received << 1 | (answer is not None and not answer.read()[SO])
                        self._wires.set({SCK: True})
                self._wires.set({SCK: False})
            finally:
                self._selects.set({chip: False})
        return received.to_bytes(len(frame), "big")


class KernelSpi:
    """SPI on the Pi's controller, through `api`: the spidev package, or an object of its shape.

    `selects` gives each chip the number of its select: /dev/spidevBUS.SELECT. `mode`: of the clock, 0 to 3.
    Raises HardwareError.
    """

    def __init__(
        self, api: Any, bus: int, selects: Mapping[str, int], *, mode: int = 0, speed_hz: int = SPEED_HZ
    ) -> None:
        self._lock = threading.Lock()
        self._devices = {chip: _opened(api, bus, select, mode, speed_hz) for chip, select in selects.items()}

    def send(self, chip: str, frame: bytes) -> None:
        self.exchange(chip, frame)

    def exchange(self, chip: str, frame: bytes) -> bytes:
        with self._lock:
            try:
                return bytes(self._devices[chip].xfer2(list(frame)))
            except OSError as fault:
                raise HardwareError(f"SPI: cannot send to {chip}: {fault.strerror or fault}") from fault

    def close(self) -> None:
        for device in self._devices.values():
            device.close()


def real_spidev() -> Any:
    """The spidev package. Raises HardwareError where it is missing."""
    try:
        import spidev  # noqa: PLC0415 - hardware packages are imported when hardware is opened
    except ImportError as fault:
        raise HardwareError(
            f"SPI: the Python package spidev cannot be loaded ({fault}): install it, or use GPIO lines"
        ) from fault
    return spidev


def _opened(api: Any, bus: int, select: int, mode: int, speed_hz: int) -> Any:
    path = f"/dev/spidev{bus}.{select}"
    device = api.SpiDev()
    try:
        device.open(bus, select)
    except FileNotFoundError as fault:
        raise HardwareError(
            f"SPI: there is no {path}: switch SPI on (dtparam=spi=on in /boot/firmware/config.txt) and reboot"
        ) from fault
    except PermissionError as fault:
        raise HardwareError(f"SPI: no permission for {path}: add the user to the group spi") from fault
    except OSError as fault:
        raise HardwareError(f"SPI: {path}: {fault.strerror or fault}") from fault
    device.mode = mode
    device.max_speed_hz = speed_hz
    return device
