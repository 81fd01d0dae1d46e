"""What a front panel's knobs read at their maximum, kept in a small JSON file from one run to the next.

Knows the file's form, and that a damaged or foreign file is as good as none. Does not know how it was found out.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from pathlib import Path

from hw.ports import Axis
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FILE_NAME = "knobs.json"
"""Beside the state file."""
FORMAT = "rotator knobs 1"
LEAST, MOST = 0.1, 1.1
"""A full scale outside of these is no knob's, in shares of its supply."""


def encode(full_scales: Mapping[Axis, float]) -> str:
    shares = {axis.value: round(share, 4) for axis, share in full_scales.items()}
    return json.dumps({"format": FORMAT, "full_scales": shares}, indent=1) + "\n"


def decode(text: str) -> dict[Axis, float]:
    """Raises ValueError where that is not the box's."""
    try:
        whole = json.loads(text)
        if not isinstance(whole, dict) or whole.get("format") != FORMAT:
            raise ValueError("it is not the box's")
        shares = {Axis(name): share for name, share in whole["full_scales"].items()}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as fault:
        raise ValueError(str(fault) or type(fault).__name__) from fault
    for axis, share in shares.items():
        if isinstance(share, bool) or not isinstance(share, (int, float)) or not LEAST <= share <= MOST:
            raise ValueError(f"{share!r} is no full scale of the {axis.value} knob")
    return {axis: float(share) for axis, share in shares.items()}


class KnobsFile:
    """The file. `load` it, `save` what is new; neither ever raises."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._kept: dict[Axis, float] = {}

    def load(self) -> dict[Axis, float]:
        """The full scales that are known; none where there is no file, or none that can be believed."""
        try:
            self._kept = decode(self._path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as fault:
            log.warning("%s: ignored, the panel's knobs count as uncalibrated: %s", self._path, fault)
            return {}
        return dict(self._kept)

    def save(self, full_scales: Mapping[Axis, float]) -> None:
        """Keep them. What is there already is not written again."""
        wanted = {axis: round(share, 4) for axis, share in full_scales.items()}
        if wanted == self._kept:
            return
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self._path, encode(wanted))
        except OSError as fault:
            log.error("%s: the knobs' full scales cannot be kept: %s", self._path, fault)
            return
        self._kept = wanted
