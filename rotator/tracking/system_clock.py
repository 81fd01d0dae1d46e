"""Whether this computer's clock has been set by a time server: a Raspberry Pi has no clock of its own.

Knows the kernel's own answer, which every time service keeps (adjtimex(2), STA_UNSYNC).
"""

from __future__ import annotations

import ctypes
import ctypes.util

_ASK_NOTHING = bytes(512)
"""A `struct timex` of zeros asks and changes nothing. It has 208 bytes at most on the machines that are known."""
_ERROR = 5
"""TIME_ERROR: the clock is not synchronised."""


def is_set() -> bool:
    """Whether the kernel holds its clock for synchronised. Where it does not tell: no."""
    try:
        libc = ctypes.CDLL(ctypes.util.find_library("c") or "libc.so.6", use_errno=True)
        state = int(libc.adjtimex(ctypes.create_string_buffer(_ASK_NOTHING, len(_ASK_NOTHING))))
    except (OSError, AttributeError):
        return False
    return 0 <= state < _ERROR
