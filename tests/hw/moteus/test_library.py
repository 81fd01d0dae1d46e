"""How mjbots' transports are opened: what they are asked for, and what is said where the package is missing."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from hw.moteus.library import CanChannel, SerialPort
from hw.moteus.orders import WATCHDOG_S


class Asked:
    """The moteus package's shape: keeps what its transports were asked for."""

    def __init__(self) -> None:
        self.wanted: dict[str, Any] = {}
        self.serial = SimpleNamespace(write_timeout=None)

    def Fdcanusb(self, path: str, **wanted: Any) -> Any:  # noqa: N802 - the package's own name
        self.wanted = {"path": path, **wanted}
        device = SimpleNamespace(_serial=SimpleNamespace(serial=self.serial))
        return SimpleNamespace(_transport=SimpleNamespace(devices=lambda: [device]))

    def PythonCan(self, **wanted: Any) -> Any:  # noqa: N802 - the package's own name
        self.wanted = wanted


def test_an_adapter_keeps_the_other_axis_waiting_for_less_than_its_watchdog_allows() -> None:
    moteus = Asked()
    SerialPort("/dev/fdcanusb")(moteus)
    assert moteus.wanted == {
        "path": "/dev/fdcanusb",
        "command_timeout": 0.05,
        "response_timeout": 0.05,
        "max_retries": 0,
    }
    assert moteus.wanted["response_timeout"] < WATCHDOG_S / 4
    assert 0.5 < moteus.serial.write_timeout < 3.0, "a thread of a busy machine may wait for half a second"


def test_a_can_interface_is_the_kernel_s_with_flexible_data_rate() -> None:
    moteus = Asked()
    CanChannel("can0")(moteus)
    assert moteus.wanted == {"interface": "socketcan", "channel": "can0", "fd": True}
