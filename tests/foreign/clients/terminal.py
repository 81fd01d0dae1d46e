"""A program that wants a terminal of its own, on a pseudo-terminal: what it shows, and the keys that a person presses.

Knows no screen layout: `shows` looks for words in what was drawn, in the order in which it was drawn.
"""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

PATIENCE_S = 30.0
_ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b[()][0-9A-B]|\x1b[=>]")


class Screen:
    """One program's terminal."""

    def __init__(self, master: int, process: subprocess.Popen[bytes]) -> None:
        self._master = master
        self.process = process
        self._drawn = ""

    def shows(self, words: str) -> None:
        """Wait until it has drawn these words; what was drawn before them is forgotten."""
        give_up_s = time.monotonic() + PATIENCE_S
        while words not in (plain := _ESCAPES.sub("", self._drawn)):
            assert time.monotonic() < give_up_s, f"{words!r} is not in {plain[-1000:]!r}"
            assert self.process.poll() is None, f"it has ended: {plain[-1000:]!r}"
            self.look()
        self._drawn = plain[plain.index(words) + len(words) :]

    def look(self) -> None:
        """Take what it has drawn. A terminal that takes nothing stops its program."""
        ready, _, _ = select.select([self._master], [], [], 0.05)
        if ready:
            with suppress(OSError):  # it has ended
                self._drawn += os.read(self._master, 65536).decode("latin-1")

    def press(self, keys: str) -> None:
        os.write(self._master, keys.encode())


@contextmanager
def terminal(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Iterator[Screen]:
    """Run the command in that folder on a terminal of 80 by 25; it ends with the context."""
    master, slave = pty.openpty()
    everything = {**os.environ, "TERM": "vt100", "LINES": "25", "COLUMNS": "80", **environment}
    process = subprocess.Popen(
        command, cwd=folder, env=everything, stdin=slave, stdout=slave, stderr=slave, start_new_session=True
    )
    os.close(slave)
    try:
        yield Screen(master, process)
    finally:
        process.kill()
        process.wait()
        os.close(master)
