"""mjbots' Python library: how it is loaded, and how its transports are opened. The only importer of moteus.

Knows adapters and channels. Does not know orders and answers: `hw.moteus.wire` does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from hw.ports import HardwareError

LINE_S = 0.05
"""The adapter's time limit for one line, in seconds. The library's default is longer than the other axis's watchdog."""

WRITE_S = 1.0
"""Seconds for which an adapter that stops reading may block the thread. Not shorter: pyserial takes a good write for a
failure if the thread did not run for longer, and on a busy machine a thread may wait for half a second."""


def library() -> Any:
    """The moteus package. Raises HardwareError where it is missing."""
    try:
        import moteus  # noqa: PLC0415 - hardware packages are imported when hardware is opened
    except ImportError as fault:
        raise HardwareError(
            f"moteus: its Python package cannot be loaded ({fault}): "
            "pip install --no-deps moteus, and pip install importlib-metadata packaging python-can"
        ) from fault
    return moteus


@dataclass(frozen=True, slots=True)
class SerialPort:
    """An fdcanusb or mjcanfd-usb adapter, or a controller's UART."""

    path: str

    def __call__(self, moteus: Any) -> Any:
        """Open it with the library `moteus`. Raises OSError."""
        transport = moteus.Fdcanusb(self.path, command_timeout=LINE_S, response_timeout=LINE_S, max_retries=0)
        for device in transport._transport.devices():
            device._serial.serial.write_timeout = WRITE_S
        return transport

    def __str__(self) -> str:
        return self.path


@dataclass(frozen=True, slots=True)
class CanChannel:
    """A CAN-FD interface of the kernel, or another that python-can knows."""

    channel: str
    interface: str = "socketcan"

    def __call__(self, moteus: Any) -> Any:
        """Open it with the library `moteus`. Raises OSError."""
        return moteus.PythonCan(interface=self.interface, channel=self.channel, fd=True)

    def __str__(self) -> str:
        return self.channel
