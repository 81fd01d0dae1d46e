"""A card that refuses to write a file, as a full or read-only one does, or hangs: for the tests of the files on it.

Knows how a file is replaced: its new content is first written beside it. Knows nothing of the content.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rotator.store.hanging import writes
from rotator.store.whole import NEW


def refuse(path: Path) -> Path:
    """From now on this file cannot be replaced, until the folder that is returned is removed.

    The folder stands where the new content would be written.
    """
    blocked = path.with_name(path.name + NEW)
    blocked.mkdir(parents=True, exist_ok=True)
    return blocked


@contextmanager
def hanging(path: Path) -> Iterator[None]:
    """While it is open a write of this file does not return; at the end it fails. Everything can still be read.

    A pipe that no program reads stands where the new content would be written.
    """
    pipe = path.with_name(path.name + NEW)
    pipe.parent.mkdir(parents=True, exist_ok=True)
    os.mkfifo(pipe)
    try:
        yield
    finally:
        end = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        while path.resolve() in writes().values():
            time.sleep(0.001)
        # Unlinked first: a write that opened the pipe between the two would wait for a reader without end.
        pipe.unlink()
        os.close(end)


def wait_until(seen: Callable[[], object], seconds: float = 20.0) -> None:
    """Until other threads have come so far."""
    end_s = time.monotonic() + seconds
    while not seen():
        assert time.monotonic() < end_s
        time.sleep(0.001)
