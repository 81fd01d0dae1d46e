"""The request that the box ends and starts again with its file, and what holds the antenna meanwhile.

Knows the latched stop and the person's hold that go on, and which file is next. Does not know what is in it:
`rotator.cli.anew` starts the box again, and puts the last good file back where it cannot.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.exchange.sources import Source
from rotator.exchange.status import Latch, Status


class Anew:
    """One object for a whole run of the command. `ask` may be called from any thread; it calls `on_asked`."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._asked = False
        self.file: Path | None = None
        """The configuration's file; None: the box runs without one. The page may have one made for the next start."""
        self.on_asked: Callable[[], None] = lambda: None
        self.holder: Source | None = None
        """The person who held the antenna. After the new start no other program may move it either."""
        self.latch: Latch | None = None
        """The stop that was latched."""
        self.sets_up: Axis | None = None
        """The axis to calibrate after this start. None: a normal run."""
        self.refused = ""
        """Why the file of the latest start could not be used. The file before it is in place again."""
        self.calibrated: Mapping[str, Any] | None = None
        """What came of the calibration that ended with the latest start."""
        self.again = False
        """The box has been started anew, by the page: it must come back with its page."""

    @property
    def asked(self) -> bool:
        return self._asked

    def ask(self, status: Status, sets_up: Axis | None = None) -> None:
        """End the box and start it again. The antenna stops: as at every end of the box, the relays open first."""
        with self._lock:
            if self._asked:
                return
            self._asked = True
            self.holder = _source(status.held_by) if status.held_by else None
            self.latch, self.sets_up = status.latch, sets_up
        self.on_asked()

    def forget(self) -> None:
        """A signal ends the box for good."""
        with self._lock:
            self._asked = False

    def take(self) -> bool:
        """Whether a new start was requested. This call also clears the request."""
        with self._lock:
            asked, self._asked = self._asked, False
            self.again = self.again or asked
            return asked


def _source(name: str) -> Source:
    link, _, connection = name.partition("#")
    return Source(link, int(connection) if connection.isdecimal() else 0)
