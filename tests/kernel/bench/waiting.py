"""Waiting for what the kernel does in its own time: for a condition, never for a fixed while."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

PATIENCE_S = 20.0
LOOK_EVERY_S = 0.01

Found = TypeVar("Found")


def until(condition: Callable[[], Found], what: str, patience_s: float = PATIENCE_S) -> Found:
    """The first true value of `condition`. Raises TimeoutError that says what did not come."""
    deadline_s = time.monotonic() + patience_s
    while not (found := condition()):
        if time.monotonic() > deadline_s:
            raise TimeoutError(f"after {patience_s:g} s still not: {what}")
        time.sleep(LOOK_EVERY_S)
    return found
