"""The names of senders as a person reads them: `console#8` is a command that a person typed in a terminal.

Knows the form of such a name. Logs and objects for programs keep the name itself, which tells two connections apart.
"""

from __future__ import annotations

import re

COMMAND = "a rotator command"
_COMMAND = re.compile(r"\bconsole#[0-9]+")


def spoken(text: str) -> str:
    """A text for a person, with its senders' names as a person says them."""
    return _COMMAND.sub(COMMAND, text)
