"""What the service manager hears: ready, alive, stopping. systemd's sd_notify protocol, one datagram a message.

Knows the socket and the folder that the environment names; without them it says nothing. Does not know when the program
is well: the control thread says so after a good step.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path

ALIVE_EVERY = 4
"""Signs of life within the time that the service manager allows between two."""


def runtime_folder(environment: Mapping[str, str]) -> Path | None:
    """The folder that the service manager made for as long as the program runs; None where there is no such manager."""
    folder = environment.get("RUNTIME_DIRECTORY", "").split(":")[0]
    return Path(folder) if folder else None


class ServiceManager:
    """`environment` is the process's; `clock` gives seconds. May be used from any thread."""

    def __init__(self, environment: Mapping[str, str], clock: Callable[[], float]) -> None:
        address = environment.get("NOTIFY_SOCKET", "")
        # A leading @ stands for a name that is in no folder.
        self._address = "\0" + address[1:] if address.startswith("@") else address
        self._folder = runtime_folder(environment)
        self._clock = clock
        self._every_s = self._asked_for(environment) / ALIVE_EVERY
        self._next_s = clock()
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) if address else None

    def ready(self) -> None:
        self._say("READY=1")

    def alive(self) -> None:
        """Said as often as asked for, however often it is called."""
        now_s = self._clock()
        if self._every_s and now_s >= self._next_s:
            self._next_s = now_s + self._every_s
            self._say("WATCHDOG=1")

    def stopping(self) -> None:
        self._say("STOPPING=1")

    def leave(self, name: str, text: str) -> None:
        """A file for the commands that the service manager runs when the program has died. Raises OSError."""
        if self._folder:
            (self._folder / name).write_text(text, encoding="utf-8")

    def close(self) -> None:
        if self._socket:
            self._socket.close()

    def _asked_for(self, environment: Mapping[str, str]) -> float:
        """How long it waits for a sign of life, in seconds; 0: it does not watch, or watches another process."""
        with suppress(ValueError):
            if int(environment.get("WATCHDOG_PID", os.getpid())) == os.getpid():
                return int(environment.get("WATCHDOG_USEC", "0")) / 1e6
        return 0.0

    def _say(self, message: str) -> None:
        # A service manager that does not listen is no reason to stop a motor.
        if self._socket:
            with suppress(OSError):
                self._socket.sendto(message.encode(), socket.MSG_DONTWAIT, self._address)
