"""The text of a TOML file, and why it is none, in words for the person who wrote it.

Knows the slips that people make: a decimal comma, a table written twice, a file saved with a byte order mark. Does not
know any key.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

ENCODING = "utf-8-sig"
"""Windows' editor begins a file with a byte order mark, which is no TOML."""
_COMMA = re.compile(r"=\s*([-+]?\d+),(\d+)\s*(?:#.*)?$")
_TWICE = re.compile(r"Cannot (?:declare|overwrite)")
_LINE = re.compile(r"at line (\d+)")


def read(path: Path) -> str:
    """Raises OSError, UnicodeDecodeError."""
    return path.read_text(encoding=ENCODING)


def values(text: str) -> dict[str, Any]:
    """Raises ValueError with the line, and what to write instead where that is known."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as fault:
        raise ValueError(f"is not TOML: {fault}{_advice(text, str(fault))}") from fault


def _advice(text: str, fault: str) -> str:
    place = _LINE.search(fault)
    lines = text.splitlines()
    if place is None or not 0 < int(place[1]) <= len(lines):
        return ""
    line = lines[int(place[1]) - 1].strip()
    if comma := _COMMA.search(line):
        return f": {line!r}: write the number with a point, {comma[1]}.{comma[2]}"
    if _TWICE.search(fault) and line.startswith("["):
        return f": {line} is in the file already: write its keys there, under one heading"
    if _TWICE.search(fault):
        return f": {line!r}: this key is in its table already: leave one of the two"
    return f": {line!r}"
