"""One heap for all threads, so that the memory of a box that runs for months does not grow.

Knows the C library's allocator. By default glibc gives each thread a heap of its own; with twenty threads memory that
one has freed is not used by the others, and each heap becomes as large as its busiest moment.
"""

from __future__ import annotations

import ctypes
from contextlib import suppress

M_ARENA_MAX = -8
"""The parameter's number in glibc's malloc.h."""


def use_one_heap() -> None:
    """Call it before a thread starts. Another C library has no such setting: nothing happens there."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).mallopt(M_ARENA_MAX, 1)
