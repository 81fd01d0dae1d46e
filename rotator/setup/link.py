"""The `[[link]]` to the PC in rotator.toml, for the Pi's USB serial port: adds it, and removes it again.

Knows the lines of that link. Works on texts and writes no file. A link that the user has changed stays.
"""

from __future__ import annotations

import re

from rotator.config.load import ConfigError, parse
from rotator.setup.blocks import Block
from rotator.setup.plan import SetupError

PORT = "/dev/ttyGS0"
LINES = ("[[link]]                      # the PC, over USB", 'protocol = "gs232b"', f'serial = "{PORT}"')
BLOCK = Block("rotator setup usb-serial", re.compile("|".join(map(re.escape, LINES))), last=True)

_BY_HAND = 'add a [[link]] with protocol = "gs232b" and serial = "/dev/ttyGS0" to your rotator.toml'


def added(text: str | None) -> tuple[str | None, str]:
    """The text with a link on the port, and a note for the user if the link cannot be added."""
    if text is None:
        return None, f"there is no such file; {_BY_HAND}"
    try:
        if any(link.serial == PORT for link in parse(text, "rotator.toml").link):
            return text, ""
        longer = BLOCK.into(text, LINES)
        parse(longer, "rotator.toml")
    except (ConfigError, SetupError):
        return text, f"it stays unchanged, because it has a fault or its marks are damaged; {_BY_HAND}"
    return longer, ""


def taken_out(text: str | None) -> tuple[str | None, str]:
    """The text without the link, and a note if the link stays."""
    if text is None:
        return None, ""
    if BLOCK.strangers(text):
        return text, "its link on /dev/ttyGS0 has been changed since, so it stays; without the port it only waits"
    try:
        shorter = BLOCK.without(text)
        if shorter != text:
            parse(shorter, "rotator.toml")
    except (ConfigError, SetupError):
        return text, "its link on /dev/ttyGS0 stays: without it the file could not be read"
    return shorter, ""
