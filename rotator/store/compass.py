"""The corrections that a compass has found for its own errors: the chip loses them without power.

Knows how many bytes the corrections have. Does not know what the bytes mean.
"""

from __future__ import annotations

from typing import Any

from rotator.store.state import Content, Section

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
