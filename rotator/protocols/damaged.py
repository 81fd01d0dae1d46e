"""The rule of every protocol for bytes that are no valid command: a damaged stop stops.

Knows how a stop looks when something is wrong with it. Each protocol asks only after its own reading has failed, so
that no valid command becomes a stop. Knows no protocol.
"""

from __future__ import annotations

import re

_STOP = re.compile(
    rb"STOP"  # whatever is around it
    rb"|\A[^A-Z0-9]*S(?:[^A-Z0-9]|[^0-9]*\Z)"  # S alone and anything behind it; a word with S in front, and no digit
    rb"|<ST?O?(?![A-Z0-9])"  # a tag that is cut off
)
"""In capitals. A digit behind other letters is more likely an order that has lost something."""


NOISE = "".join(map(chr, (*range(0x21), *range(0x7F, 0x100))))
"""What may come before a command, from a port being plugged in: blanks, control characters, bytes beyond ASCII."""


def is_stop(data: bytes) -> bool:
    """Whether bytes that are no valid command were meant as a stop."""
    return _STOP.search(data.upper()) is not None
