"""The file with the full scale of each front panel knob: its reading at the end of its travel.

Knows the file's form, and which full scales are possible. Does not know how a full scale is measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.store import json_file
from rotator.store.forms import Form
from rotator.store.json_file import JsonFile, number

FILE_NAME = "knobs.json"
"""Beside the state file."""
FORM = Form("rotator knobs")
LEAST, MOST = 0.1, 1.1
"""The full scale of a working knob lies between these shares of its supply."""
DIGITS = 4
"""Digits of a share in the file."""

FullScales = dict[Axis, float]
"""The reading of each knob at the end of its travel, as a share of the knob's supply."""


def _parse(content: dict[str, Any]) -> FullScales:
    shares = {Axis(name): share for name, share in content["full_scales"].items()}
    return {axis: number(share, f"the {axis.value} knob's full scale", LEAST, MOST) for axis, share in shares.items()}


def decode(text: str) -> FullScales:
    """The full scales in the text of a file. Raises ValueError where the text is damaged or another file's."""
    return json_file.decode(FORM, text, _parse)


class KnobsFile:
    """`load` the full scales, `save` new ones. Failures go to the log, and nothing is raised."""

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORM, "the knobs' full scales")
        self._saved: FullScales = {}

    def load(self) -> FullScales:
        """The known full scales; none without a file, or with a damaged one."""
        self._saved = self._file.load(
            _parse, absent={}, damaged={}, consequence="ignored, the panel's knobs count as uncalibrated"
        )
        return dict(self._saved)

    def save(self, full_scales: Mapping[Axis, float]) -> bool:
        """Write the full scales, unless the file has the same ones. False: the write failed."""
        rounded = {axis: round(share, DIGITS) for axis, share in full_scales.items()}
        content = {axis.value: share for axis, share in rounded.items()}
        if rounded == self._saved:
            return True
        done = self._file.save({"full_scales": content})
        if done:
            self._saved = rounded
        return done
