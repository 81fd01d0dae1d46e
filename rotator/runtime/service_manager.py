"""Reports to the service manager that the box is ready, well, or stopping, by systemd's sd_notify protocol.

Knows the socket and the folder that the environment names. Without them it does nothing. Does not know when the box is
well: the control loop calls `alive` after each good step. Source: sd_notify(3), one datagram a message.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Mapping
from contextlib import suppress

from rotator.config.places import runtime_folder

ALIVE_EVERY = 4
"""Messages sent within the longest silence that the service manager allows."""
ANEW_S = 60.0
"""Longest silence, in seconds, while the box ends and starts again."""


class ServiceManager:
    """`environment`: the process's. `clock` gives seconds. May be used from any thread. Only `leave` raises."""

    def __init__(self, environment: Mapping[str, str], clock: Callable[[], float]) -> None:
        address = environment.get("NOTIFY_SOCKET", "")
        # A leading @ means Linux's abstract name space, in which an address begins with a zero byte.
        self._address = "\0" + address[1:] if address.startswith("@") else address
        self._folder = runtime_folder(environment)
        self._clock = clock
        self._every_s = _longest_silence_s(environment) / ALIVE_EVERY
        self._next_s = clock()
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) if address else None

    def ready(self) -> None:
        self._say("READY=1")

    def pausing(self) -> None:
        """The box ends and starts again in this process: allow a longer silence."""
        if self._every_s:
            self._say(f"WATCHDOG_USEC={ANEW_S * 1e6:.0f}")

    def resumed(self) -> None:
        """The box has started again: the usual limit of silence holds."""
        if self._every_s:
            self._say(f"WATCHDOG_USEC={self._every_s * ALIVE_EVERY * 1e6:.0f}")

    def alive(self) -> None:
        """The box is well. May be called in every cycle: a message goes out only when one is due."""
        now_s = self._clock()
        if self._every_s and now_s >= self._next_s:
            self._next_s = now_s + self._every_s
            self._say("WATCHDOG=1")

    def stopping(self) -> None:
        self._say("STOPPING=1")

    def leave(self, name: str, text: str) -> None:
        """Write a file for the commands that the service manager runs after the program's death. Raises OSError."""
        if self._folder:
            (self._folder / name).write_text(text, encoding="utf-8")

    def close(self) -> None:
        """May be called twice."""
        if self._socket:
            self._socket.close()

    def _say(self, message: str) -> None:
        # A service manager that does not listen must not stop the antenna.
        if self._socket:
            with suppress(OSError):
                self._socket.sendto(message.encode(), socket.MSG_DONTWAIT, self._address)


def _longest_silence_s(environment: Mapping[str, str]) -> float:
    """After this silence, in seconds, the service manager ends the program. 0: it does not watch this process."""
    with suppress(ValueError):
        if int(environment.get("WATCHDOG_PID", os.getpid())) == os.getpid():
            return int(environment.get("WATCHDOG_USEC", "0")) / 1e6
    return 0.0
