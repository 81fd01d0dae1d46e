"""The full scale of each front panel knob: its reading at the end of its travel.

Knows which full scales are possible. Does not know how a full scale is measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hw.ports import Axis
from rotator.store.json_file import number
from rotator.store.state import Content, Section

LEAST, MOST = 0.1, 1.1
"""The full scale of a working knob lies between these shares of its supply."""
DIGITS = 4
"""Digits of a share in the file."""

FullScales = Mapping[Axis, float]
"""The reading of each knob at the end of its travel, as a share of the knob's supply."""


def _content(full_scales: FullScales) -> Content:
    return {"full_scales": {axis.value: round(share, DIGITS) for axis, share in full_scales.items()}}


def _parse(content: dict[str, Any]) -> FullScales:
    shares = {Axis(name): share for name, share in content["full_scales"].items()}
    return {axis: number(share, f"the {axis.value} knob's full scale", LEAST, MOST) for axis, share in shares.items()}


NONE: FullScales = {}
KNOBS: Section[FullScales] = Section(
    "knobs", _parse, _content, NONE, NONE, "ignored, the panel's knobs count as uncalibrated"
)
