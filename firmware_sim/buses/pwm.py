"""The kernel's files of hardware PWM, /sys/class/pwm, as those of a Raspberry Pi 4 (drivers/pwm/core.c, sysfs.c).

Knows what each file takes and refuses: a channel is exported once, its duty is no longer than its period, and it is not
enabled without a period. Knows no pin and no motor. The channels of the fan's chip are not simulated.
"""

from __future__ import annotations

import errno
import os
import threading
from collections.abc import Callable
from dataclasses import dataclass

CHIP = "/sys/class/pwm/pwmchip0"
DEVICE = "/sys/devices/platform/soc/fe20c000.pwm"
CHANNELS = 2
PINS = {12: 0, 13: 1, 18: 0, 19: 1}
"""The channel that comes out at each GPIO, as `dtoverlay=pwm-2chan` sets the pins (BCM2711 ARM Peripherals, 5.3)."""


@dataclass(slots=True)
class Channel:
    period_ns: int = 0
    duty_ns: int = 0
    enabled: bool = False

    @property
    def share(self) -> float:
        """Of the time in which the pin is high."""
        return self.duty_ns / self.period_ns if self.enabled and self.period_ns else 0.0


class SimPwm:
    """Text files by path. `changed` is called with the channel's number after each change."""

    def __init__(self) -> None:
        self.channels = [Channel() for _ in range(CHANNELS)]
        self.exported: set[int] = set()
        self.refuses = False
        """Fault: no channel takes a duty any more."""
        self.changed: Callable[[int], None] = lambda number: None
        self._lock = threading.RLock()

    def list(self, path: str) -> list[str]:
        if path != os.path.dirname(CHIP):
            raise _error(errno.ENOENT)
        return [os.path.basename(CHIP)]

    def target(self, path: str) -> str:
        return DEVICE if path == f"{CHIP}/device" else path

    def read(self, path: str) -> str:
        if path != f"{CHIP}/npwm":
            raise _error(errno.ENOENT)
        return f"{CHANNELS}\n"

    def write(self, path: str, text: str) -> None:
        with self._lock:
            folder, file = os.path.split(path)
            if path == f"{CHIP}/export":
                self._export(int(text))
                return
            number = next((each for each in self.exported if folder == f"{CHIP}/pwm{each}"), None)
            if number is None:
                raise _error(errno.ENOENT)
            self._set(self.channels[number], file, int(text))
            self.changed(number)

    def _export(self, number: int) -> None:
        if number in self.exported:
            raise _error(errno.EBUSY)
        if number >= CHANNELS:
            raise _error(errno.ENODEV)
        self.exported.add(number)

    def _set(self, channel: Channel, file: str, number: int) -> None:
        match file:
            case "period" if number > 0 and number >= channel.duty_ns:
                channel.period_ns = number
            case "duty_cycle" if self.refuses and number:
                raise _error(errno.EIO)
            case "duty_cycle" if number <= channel.period_ns:
                channel.duty_ns = number
            case "enable" if number == 0 or channel.period_ns:
                channel.enabled = bool(number)
            case _:
                raise _error(errno.EINVAL)


def _error(number: int) -> OSError:
    return OSError(number, os.strerror(number))
