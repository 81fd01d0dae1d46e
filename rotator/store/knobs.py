"""What a front panel's knobs read at their maximum, from one run to the next.

Knows the file's form. Does not know how the maximum was measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.store import json_file
from rotator.store.json_file import JsonFile

FILE_NAME = "knobs.json"
"""Beside the state file."""
FORMAT = "rotator knobs 1"
LEAST, MOST = 0.1, 1.1
"""The full scale of a working knob lies between these shares of its supply."""

FullScales = dict[Axis, float]


def encode(full_scales: Mapping[Axis, float]) -> str:
    return json_file.encode(FORMAT, _content(full_scales))


def decode(text: str) -> FullScales:
    """Raises ValueError where the text is not such a file."""
    return json_file.decode(FORMAT, text, _parse)


def _content(full_scales: Mapping[Axis, float]) -> dict[str, object]:
    return {"full_scales": {axis.value: share for axis, share in _rounded(full_scales).items()}}


def _rounded(full_scales: Mapping[Axis, float]) -> FullScales:
    return {axis: round(share, 4) for axis, share in full_scales.items()}


def _parse(content: dict[str, Any]) -> FullScales:
    shares = {Axis(name): share for name, share in content["full_scales"].items()}
    for axis, share in shares.items():
        if isinstance(share, bool) or not isinstance(share, (int, float)) or not LEAST <= share <= MOST:
            raise ValueError(f"{share!r} is no full scale of the {axis.value} knob")
    return {axis: float(share) for axis, share in shares.items()}


class KnobsFile:
    """`load` the full scales, `save` new ones; neither raises."""

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORMAT, "the knobs' full scales")
        self._saved: FullScales = {}

    def load(self) -> FullScales:
        """The known full scales; empty where there is no file, or none that can be trusted."""
        self._saved = self._file.load(
            _parse, absent={}, damaged={}, consequence="ignored, the panel's knobs count as uncalibrated"
        )
        return dict(self._saved)

    def save(self, full_scales: Mapping[Axis, float]) -> None:
        """Equal full scales are not written again."""
        wanted = _rounded(full_scales)
        if wanted != self._saved and self._file.save(_content(wanted)):
            self._saved = wanted
