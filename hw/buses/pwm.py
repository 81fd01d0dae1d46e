"""The Pi's hardware PWM, through the kernel's files in /sys/class/pwm.

Knows those files, which GPIO is which channel, and that the kernel goes on with a pulse after the program has died.
Does not know what the pulses feed. Kernel documentation: driver-api/pwm.rst; the overlay: `pwm-2chan`.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from hw.ports import HardwareError

ROOT = "/sys/class/pwm"
HEADERS = ("20c000.pwm", "98000.pwm")
"""How the device of the header's PWM is called: a Pi up to the 4, and the Pi 5. Its other chip turns the fan."""
CHANNELS = {2: {12: 0, 18: 0, 13: 1, 19: 1}, 4: {12: 0, 13: 1, 18: 2, 19: 3}}
"""By the number of a chip's channels: the channel of each GPIO (BCM2711 and RP1 peripherals, alternate functions)."""
SETTLES_S, LOOK_S = 1.0, 0.05
"""After the export of a channel udev gives its files to the group gpio: within this time, looked at so often."""
ADVICE = "add dtoverlay=pwm-2chan,pin=18,func=2,pin2=19,func2=2 to config.txt, and reboot"
NS = 1e9


class Files(Protocol):
    """Text files by path. Each raises OSError."""

    def list(self, path: str) -> list[str]: ...

    def target(self, path: str) -> str:
        """Where a symbolic link leads."""

    def read(self, path: str) -> str: ...

    def write(self, path: str, text: str) -> None: ...


class KernelFiles:
    """The files of this computer."""

    def list(self, path: str) -> list[str]:
        return sorted(os.listdir(path))

    def target(self, path: str) -> str:
        return os.path.realpath(path)

    def read(self, path: str) -> str:
        return Path(path).read_text(encoding="ascii")

    def write(self, path: str, text: str) -> None:
        Path(path).write_text(text, encoding="ascii")


def header_chip(files: Files) -> str:
    """The folder of the PWM at the pins of the header. Raises HardwareError."""
    with suppress(OSError):
        for name in files.list(ROOT):
            if files.target(f"{ROOT}/{name}/device").endswith(HEADERS):
                return f"{ROOT}/{name}"
    raise HardwareError(f"PWM: this Pi has none at its header: {ADVICE}")


class KernelPwm:
    """One channel, at `gpio`. It begins, and ends, with a duty of 0. Raises HardwareError."""

    def __init__(self, files: Files, gpio: int, hz: float, sleep: Callable[[float], None]) -> None:
        chip = header_chip(files)
        self._files = files
        self._name = f"PWM on GPIO{gpio}"
        self._period_ns = round(NS / hz)
        self._duty_ns: int | None = None
        try:
            channel = CHANNELS[int(files.read(f"{chip}/npwm"))][gpio]
        except (OSError, KeyError, ValueError) as fault:
            raise HardwareError(f"{self._name}: the kernel's PWM is not at that pin: take 18 and 19") from fault
        self._path = f"{chip}/pwm{channel}"
        try:
            files.write(f"{chip}/export", str(channel))
        except OSError as fault:
            if fault.errno != errno.EBUSY:  # busy: an earlier run has exported it
                raise self._failed(fault) from fault
        self._settle(sleep)

    def duty(self, share: float) -> None:
        """The share of the time in which the line is high, 0 to 1. Raises HardwareError."""
        duty_ns = round(min(max(share, 0.0), 1.0) * self._period_ns)
        if duty_ns == self._duty_ns:
            return
        self._duty_ns = None  # if the write fails, nobody knows
        self._write("duty_cycle", duty_ns)
        self._duty_ns = duty_ns

    def close(self) -> None:
        """May be called twice. Raises HardwareError."""
        self._duty_ns = None
        self.duty(0.0)
        self._write("enable", 0)

    def _settle(self, sleep: Callable[[float], None]) -> None:
        for _ in range(round(SETTLES_S / LOOK_S)):
            try:
                self._files.write(f"{self._path}/enable", "0")
                break
            except (PermissionError, FileNotFoundError):
                sleep(LOOK_S)
            except OSError:
                break  # a channel without a period yet cannot be switched: it is off
        # A duty of an earlier run may be longer than the new period, which the kernel refuses.
        with suppress(HardwareError):
            self._write("duty_cycle", 0)
        self._write("period", self._period_ns)
        self.duty(0.0)
        self._write("enable", 1)

    def _write(self, file: str, number: int) -> None:
        try:
            self._files.write(f"{self._path}/{file}", str(number))
        except OSError as fault:
            raise self._failed(fault) from fault

    def _failed(self, fault: OSError) -> HardwareError:
        if isinstance(fault, PermissionError):
            return HardwareError(f"{self._name}: no permission: add the user to the group gpio")
        return HardwareError(f"{self._name}: the kernel does not take it: {fault.strerror or fault}")
