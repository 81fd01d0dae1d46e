"""The corrections that a compass has found for its own errors: the chip loses them without power.

Knows how many bytes the corrections have. Does not know what the bytes mean.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rotator.store.state import Content, Section, State

OFFSETS_COUNT = 22
"""Bytes, as the BNO055's registers hold them."""


def _content(offsets: bytes | None) -> Content:
    return {"offsets": (offsets or b"").hex(" ")}


def _parse(content: dict[str, Any]) -> bytes | None:
    offsets = bytes.fromhex(content["offsets"])
    if len(offsets) != OFFSETS_COUNT:
        raise ValueError(f"the offsets are {len(offsets)} bytes, not {OFFSETS_COUNT}")
    return offsets


COMPASS: Section[bytes | None] = Section(
    "compass", _parse, _content, None, None, "ignored, the compass learns its errors anew"
)


class KeptCompass:
    """`load` the corrections, `save` new ones."""

    def __init__(self, state: State) -> None:
        self._state = state

    @property
    def path(self) -> Path:
        return self._state.path

    @property
    def trouble(self) -> str:
        """The reason of the last failed write, as a sentence for the operator; empty after a good write."""
        reason = self._state.trouble
        return f"{self.path}: what the compass learnt cannot be kept: {reason}" if reason else ""

    def load(self) -> bytes | None:
        """The corrections; None: there are none, or they are damaged."""
        return self._state.load(COMPASS)

    def save(self, offsets: bytes) -> None:
        """Keep the corrections of a fully calibrated compass."""
        self._state.keep(COMPASS, offsets)
