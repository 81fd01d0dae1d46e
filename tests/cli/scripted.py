"""A box that says what a test has written down: for commands that a simulated G-5500 does not understand, or too late.

Knows the socket of the console and statuses in turn. Knows no command.
"""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from hw.ports import AngleSource, Direction
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols.status_object import as_object

Start = Callable[..., Any]
StartInTerminal = Callable[..., Any]
Rotator = Callable[..., Any]


def said(done: Any) -> str:
    """What a command printed that did what it was asked."""
    assert (done.returncode, done.stderr) == (0, "")
    return str(done.stdout)


def why(done: Any, code: int = 1) -> str:
    """What one said that did not."""
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    return str(done.stderr)


COMMAND = "console#1"
"""What the scripted box calls the command of the test."""


class ScriptedConsole:
    """Where the box would have it. `heard` is what was said to it, but for the questions about its status."""

    def __init__(self, path: Path, statuses: list[Status]) -> None:
        path.parent.mkdir(exist_ok=True)
        self.heard: list[str] = []
        self.ordered = threading.Event()
        self.states: list[str] = []
        """What is tracked, in turn, as the console tells it."""
        self.ends_after: int | None = None
        """The box ends after so many answers; None: it stays."""
        self._statuses = statuses
        self._server = socket.socket(socket.AF_UNIX)
        self._server.bind(str(path))
        self._server.listen()
        threading.Thread(target=self._serve, daemon=True).start()

    def close(self) -> None:
        with suppress(OSError):  # it has ended before
            self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()

    def _serve(self) -> None:
        while True:
            try:
                client, _ = self._server.accept()
            except OSError:
                return
            threading.Thread(target=self._talk, args=(client,), daemon=True).start()

    def _talk(self, client: socket.socket) -> None:
        with suppress(OSError), client, client.makefile("rw", encoding="utf-8") as lines:
            for line in lines:
                if self.ends_after is not None:
                    self.ends_after -= 1
                    if self.ends_after < 0:
                        self.close()
                        return
                lines.write(self._answer(line.strip()))
                lines.flush()

    def _answer(self, line: str) -> str:
        if line == "status json":
            told = self._statuses.pop(0) if len(self._statuses) > 1 else self._statuses[0]
            if not self.ordered.is_set() and told.controlled_by == COMMAND:
                told = replace(told, controlled_by="")  # before its order it moves nothing
            return json.dumps(as_object(told)) + "\nok\n"
        if line == "track" and self.states:
            return f"{self.states.pop(0)}\nok\n"
        self.heard.append(line)
        self.ordered.set()
        return "ok\n"


def counted(azimuth_deg: float, *, turns: bool = False, by: str = COMMAND, **more: Any) -> Status:
    """A box that counts its azimuth."""
    drive = Direction.MINUS if turns else Direction.OFF
    counts: dict[str, Any] = {"source": AngleSource.COUNTED, "homeable": True}
    azimuth = AxisStatus(0.0, 450.0, azimuth_deg, drive=drive, moving=turns, confirmable=True, **counts, **more)
    return Status(0.0, azimuth, AxisStatus(0.0, 180.0, 0.0, **counts), controlled_by=by)


def pointed(azimuth: AxisStatus, by: str = COMMAND, **more: Any) -> Status:
    """A box on its way, or where it was sent."""
    return Status(0.0, azimuth, AxisStatus(0.0, 180.0, 45.0), controlled_by=by, **more)
