"""Whether a terminal is this command's own at the moment: its keys come here, and it may be drawn on.

A command that a shell has started behind its prompt (`rotator run &`) shares the terminal with that prompt. The kernel
would stop it as soon as it changed the terminal's modes, and its box with it.
"""

from __future__ import annotations

import os
from typing import TextIO


def in_front(stream: TextIO) -> bool:
    """Whether the stream is a terminal, and this command not behind the prompt of a shell in it."""
    if not stream.isatty():
        return False
    try:
        return os.tcgetpgrp(stream.fileno()) == os.getpgrp()
    except OSError:  # it is not the terminal of this session: no shell shares it
        return True
