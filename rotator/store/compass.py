"""The file with the corrections that a compass has found for its own errors: the chip loses them without power.

Knows the file's form, and how many bytes the corrections have. Does not know what the bytes mean.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rotator.store import json_file
from rotator.store.forms import Form
from rotator.store.json_file import JsonFile

FILE_NAME = "compass.json"
"""The file beside the state file. The compass loses these corrections without power."""
FORM = Form("rotator compass")
OFFSETS_COUNT = 22
"""Bytes, as the BNO055's registers hold them."""


def encode(offsets: bytes) -> str:
    return json_file.encode(FORM, _content(offsets))


def decode(text: str) -> bytes:
    """The corrections in the text of a file. Raises ValueError where the text is damaged or another file's."""
    return json_file.decode(FORM, text, _parse)


def _content(offsets: bytes) -> dict[str, object]:
    return {"offsets": offsets.hex(" ")}


def _parse(content: dict[str, Any]) -> bytes:
    offsets = bytes.fromhex(content["offsets"])
    if len(offsets) != OFFSETS_COUNT:
        raise ValueError(f"the offsets are {len(offsets)} bytes, not {OFFSETS_COUNT}")
    return offsets


class CompassFile:
    """`load` the corrections, `save` new ones. Failures go to the log, and nothing is raised."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = JsonFile(path, FORM, "what the compass learnt")
        self._saved: bytes | None = None

    @property
    def trouble(self) -> str:
        """The reason of the last failed write, as a sentence for the operator; empty after a good write."""
        reason = self._file.trouble
        return f"{self.path}: what the compass learnt cannot be kept: {reason}" if reason else ""

    def load(self) -> bytes | None:
        """The corrections; None without a file, or with a damaged one."""
        self._saved = self._file.load(
            _parse, absent=None, damaged=None, consequence="ignored, the compass learns its errors anew"
        )
        return self._saved

    def save(self, offsets: bytes) -> None:
        """Write the corrections of a fully calibrated compass, unless the file has the same ones."""
        if offsets != self._saved and self._file.save(_content(offsets)):
            self._saved = offsets
