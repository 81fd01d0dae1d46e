"""The same picture for a terminal that has only ASCII: each other character is replaced by one of ASCII.

Knows characters. Does not know the picture. The console of a Raspberry Pi, for example, has no dots and no part blocks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.text import Text

_ASCII = str.maketrans(
    {
        **dict.fromkeys("╭╮╰╯┏┓┗┛", "+"),
        **dict.fromkeys("─━", "-"),
        **dict.fromkeys("│┃▕", "|"),
        **dict.fromkeys("▏▎", "."),
        **dict.fromkeys("▍▌▋", ":"),
        **dict.fromkeys("▊▉█", "#"),
        **dict(zip("░▒●○◆◇◈→…–—✓✗≈", ":x*.#o@>~--vx~", strict=True)),
        **{chr(code): "." for code in range(0x2801, 0x2900)},
    }
)
_NO_UNICODE = frozenset({"linux", "vt100", "vt102", "vt220", "ansi", "cons25", "dumb", "unknown"})
"""Values of TERM. The text mode of Linux has only some hundred characters, with any encoding."""


def ascii_only(encoding: str, term: str) -> bool:
    """Whether a terminal of this name, with this encoding, shows only ASCII."""
    return term in _NO_UNICODE or "utf" not in encoding.lower()


def in_ascii(text: Text) -> Text:
    """The text with the same cells and colours. The degree sign stays: Latin-1 and the Linux console have it."""
    plain = text.copy()
    plain.plain = text.plain.translate(_ASCII)
    return plain
