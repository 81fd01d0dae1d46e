"""How the program keeps its memory: one heap for all threads, and no search for garbage among what stays for ever.

Knows the C library's allocator. By default glibc gives each thread a heap of its own; with twenty threads memory that
one has freed is not used by the others, and each heap becomes as large as its busiest moment. Knows Python's collector:
a look at everything takes tenths of a second on a Pi, and no thread runs meanwhile, not even for a stop.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

M_ARENA_MAX = -8
"""The parameter's number in glibc's malloc.h."""


def use_one_heap() -> None:
    """Call it before a thread starts. Another C library has no such setting: nothing happens there."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).mallopt(M_ARENA_MAX, 1)


@contextmanager
def loading() -> Iterator[None]:
    """While modules are loaded: what they make stays for ever, and the collector never looks at it again. Where all are
    loaded already, as when a page begins anew, nothing is kept from it."""
    loaded = len(sys.modules)
    gc.disable()
    try:
        yield
    finally:
        if len(sys.modules) > loaded:
            gc.freeze()
        gc.enable()
