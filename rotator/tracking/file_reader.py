"""Reads files of elements for the running box: a large one in a process of its own.

Parsing ten megabytes keeps the interpreter busy for seconds, and the control loop needs the same interpreter. Knows
only sizes; `rotator.orbits` knows the forms.
"""

from __future__ import annotations

from pathlib import Path

from rotator.orbits.element_files import Found, read_file
from rotator.runtime.own_process import OwnProcess

LARGE_BYTES = 200_000
"""Bytes of some hundred satellites. A smaller file takes some milliseconds; the start of a process, half a second."""
LONGEST_S = 120.0


class FileReader:
    """`read` may be called from one thread only, `close` from any."""

    def __init__(self) -> None:
        self._process = OwnProcess(LONGEST_S, once=True)

    def read(self, path: Path) -> Found:
        """Raises OSError, ValueError; RuntimeError where the process fails."""
        if path.stat().st_size <= LARGE_BYTES:
            return read_file(path)
        return self._process.compute(read_file, path)

    def close(self) -> None:
        """Give up a file that is being read."""
        self._process.close()
