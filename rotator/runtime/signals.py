"""Ctrl-C, SIGTERM and a closed terminal end motion at once, even while the main thread is stuck.

Python runs a signal's handler in the main thread, between two instructions. A main thread that waits for a terminal
or a disk never gets there. But the interpreter also writes the signal's number into a socket, from the thread that
the kernel interrupted; the thread of this file reads it there. Does not know what it ends.
"""

from __future__ import annotations

import signal
import socket
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any, Self

ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def never_pause() -> Any:
    """Ignore Ctrl-Z: a program that stands still serves no stop, and with a relay on its sentinel would kill it.

    Returns what the signal did before.
    """
    return signal.signal(signal.SIGTSTP, signal.SIG_IGN)


class SignalThread:
    """While it is open, each of ENDINGS calls `ended`, in a thread of its own, and Ctrl-Z does nothing. Open it in the
    main thread."""

    def __init__(self, ended: Callable[[], None]) -> None:
        self._ended = ended
        self._reading, self._written = socket.socketpair()
        self._written.setblocking(False)
        self._before: dict[signal.Signals, Any] = {}
        self._thread = threading.Thread(target=self._run, name="signals", daemon=True)

    def __enter__(self) -> Self:
        signal.set_wakeup_fd(self._written.fileno(), warn_on_full_buffer=False)
        # `nohup` or `trap` ignore the signal: then the box must outlive its terminal.
        outlives = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
        self._before = {
            signum: signal.signal(signum, _noted) for signum in ENDINGS if not (outlives and signum is signal.SIGHUP)
        }
        self._before[signal.SIGTSTP] = never_pause()
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        for signum, handler in self._before.items():
            signal.signal(signum, handler)
        signal.set_wakeup_fd(-1)
        self._written.shutdown(socket.SHUT_WR)
        self._thread.join()
        self._written.close()
        self._reading.close()

    def _run(self) -> None:
        while received := self._reading.recv(16):
            if any(signum in ENDINGS for signum in received):
                self._ended()


def _noted(_signum: int, _frame: FrameType | None) -> None:
    """Does nothing: the number is already in the socket."""
