"""Reads TOML, JSON and XML that others have written: a file, a backup, the body of a request, a message of a broker.

Knows how deep and how long such a text may be, so that none takes the box's memory or its time, or ends a thread with a
RecursionError. Does not know what is in it. The program parses these three forms here and nowhere else.
"""

from __future__ import annotations

import re
import tomllib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

DEEPEST = 32
"""Brackets inside each other, and parts of a key. Our own deepest text has six. Python ends at about a thousand, and
the memory for `a.a.a = 1` grows with the square of its parts."""
LONGEST_TOML = 128 * 1024
"""Characters of a TOML text: ten times the longest configuration. The worst text of this length takes 60 MB."""
_STRINGS = re.compile(r'"(?:[^"\\]|\\.?)*+"?', re.DOTALL)
STRINGS_AND_REMARKS = re.compile(
    r'"""(?:[^"\\]|\\.?|"(?!""))*+(?:"{3,5})?'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5})?"
    r'|"(?:[^"\\\n]|\\[^\n]?)*+"?'
    r"|'[^'\n]*+'?|#[^\n]*+",
    re.DOTALL,
)
_NO_BRACKETS = re.compile(r"[^\[\]{}]++")
_KEY_ENDS = re.compile(r"[\[\]{},=\n]")


class TooMuchError(ValueError):
    """The text is too long, or too deep. The words say which, and follow the name of the file."""


def json_of(text: str | bytes) -> Any:
    """Raises ValueError: JSONDecodeError for what is no JSON."""
    import json  # noqa: PLC0415 - `rotator stop` reads a configuration, and no JSON

    text = text if isinstance(text, str) else text.decode("utf-8")
    _check_depth(_STRINGS.sub("", text))
    return json.loads(text)


def toml_of(text: str) -> dict[str, Any]:
    """Raises ValueError: TOMLDecodeError for what is no TOML."""
    check_toml(text)
    return tomllib.loads(text)


def check_toml(text: str) -> None:
    """Raises TooMuchError for a text that no reader of TOML should see."""
    if len(text) > LONGEST_TOML:
        raise TooMuchError(f"is longer than {LONGEST_TOML // 1024} KiB: it is no configuration")
    bare = STRINGS_AND_REMARKS.sub("", text)
    _check_depth(bare)
    if any(part.count(".") >= DEEPEST for part in _KEY_ENDS.split(bare)):
        raise TooMuchError(f"has a key of more than {DEEPEST} parts")


def xml_of(text: str) -> Element:
    """Raises ValueError. A text with a document type is refused: its entities can be a thousand times as long."""
    from xml.etree import ElementTree  # noqa: PLC0415 - slow to load, and rarely needed

    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise TooMuchError("is XML with a document type of its own")
    try:
        return ElementTree.fromstring(text.encode())
    except ElementTree.ParseError as fault:
        raise ValueError(f"line {fault.position[0]}: no XML ({fault})") from fault


def _check_depth(text: str) -> None:
    depth = 0
    for bracket in _NO_BRACKETS.sub("", text):
        depth += 1 if bracket in "[{" else -1
        if depth > DEEPEST:
            raise TooMuchError("has too many brackets inside each other")
