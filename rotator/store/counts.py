"""Where the axes that count pulses stand, kept from one run to the next: a count has no other memory.

Knows the file's form, and that an axis is marked as moving before it moves: a power cut in mid-move then leaves the
mark, and the axis knows that it is lost. Knows when a rest is worth a write. Knows nothing of how the counting is done.

Memory cards wear. A move costs a write before it and one after it, but while a satellite is tracked, a step every few
seconds, the mark stays: a rest is written after 2 s where none has been for a minute, else after 20 s. So tracking
costs an axis two writes a minute, and the busiest series of orders six. At 30 kB a write, with all that a file system
adds, eight hours of tracking a day on two axes are 60 MB a day or 21 GB a year: a 16 GB card stands a thousand times
its size.
"""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FILE_NAME = "counts.json"
"""Beside the state file."""
FORMAT = "rotator counts 1"
REST_S = 2.0
"""A rest is written this long after the axis came to stand, if none has been for SELDOM_S; else after LONG_REST_S."""
LONG_REST_S = 20.0
SELDOM_S = 60.0


class Standing(Enum):
    """What is known of a counted axis. Only KNOWN may be sent anywhere; the others obey jog until they are homed."""

    KNOWN = "known"
    MOVING = "moving"
    """In the file: it was about to move when this was written."""
    LOST = "lost"
    NEVER = "never homed"


@dataclass(frozen=True, slots=True)
class Place:
    """`angle_deg` on the rotor's own scale, where the standing is KNOWN."""

    standing: Standing
    angle_deg: float = math.nan


Cam = Mapping[str, object]
"""What the configuration says of an axis's contact: a count on another cam says nothing."""

NEVER, LOST, MOVING = Place(Standing.NEVER), Place(Standing.LOST), Place(Standing.MOVING)


def encode(places: Mapping[Axis, Place], cams: Mapping[Axis, Cam]) -> str:
    axes: dict[str, dict[str, object]] = {}
    for axis, place in places.items():
        if place.standing is not Standing.NEVER:
            axes[axis.value] = {"cam": dict(cams[axis]), "standing": place.standing.value}
        if place.standing is Standing.KNOWN:
            axes[axis.value]["angle_deg"] = round(place.angle_deg, 3)
    return json.dumps({"format": FORMAT, "axes": axes}, indent=1) + "\n"


def decode(text: str, cams: Mapping[Axis, Cam]) -> dict[Axis, Place]:
    """What each axis of `cams` may believe: KNOWN, LOST or NEVER. Raises ValueError where the file is not the box's."""
    try:
        whole = json.loads(text)
        if not isinstance(whole, dict) or whole.get("format") != FORMAT:
            raise ValueError("it is not the box's")
        tables = dict(whole["axes"])
        return {axis: _place(tables[axis.value], cam) if axis.value in tables else NEVER for axis, cam in cams.items()}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as fault:
        raise ValueError(str(fault) or type(fault).__name__) from fault


def _place(table: Mapping[str, Any], cam: Cam) -> Place:
    if Standing(table["standing"]) is not Standing.KNOWN or table["cam"] != dict(cam):
        return LOST
    angle_deg = table["angle_deg"]
    if isinstance(angle_deg, bool) or not isinstance(angle_deg, (int, float)) or not math.isfinite(angle_deg):
        raise ValueError("an angle is no number")
    return Place(Standing.KNOWN, float(angle_deg))


class CountsFile:
    """The file. `load` it; then `start` before a move, `rest` in every cycle that an axis stands, `close` at the end.

    None of them raises. `trouble` says why the file cannot be written; then nothing may move that is not lost anyway.
    """

    def __init__(self, path: Path, cams: Mapping[Axis, Cam]) -> None:
        self.trouble = ""
        self._path = path
        self._cams = cams
        self._written: dict[Axis, Place] = dict.fromkeys(cams, NEVER)
        self._stood: dict[Axis, tuple[float, float]] = {}
        """Since when an axis stands, and where."""
        self._rested_s = dict.fromkeys(cams, -math.inf)

    def load(self) -> dict[Axis, Place]:
        """What is known from the last run. A file that cannot be believed makes every axis LOST."""
        try:
            self._written = decode(self._path.read_text(encoding="utf-8"), self._cams)
        except FileNotFoundError:
            pass
        except (OSError, ValueError) as fault:
            log.warning("%s: cannot be believed, the axes must be homed: %s", self._path, fault)
            self._written = dict.fromkeys(self._cams, LOST)
        return dict(self._written)

    def start(self, axis: Axis) -> bool:
        """The axis is about to move. True: it may, for the file says so, or knows nothing of it anyway."""
        self._stood.pop(axis, None)
        return self._written[axis].standing is not Standing.KNOWN or self._write(axis, MOVING)

    def lose(self, axis: Axis) -> None:
        """The count is no longer to be relied on."""
        self._stood.pop(axis, None)
        if self._written[axis].standing is not Standing.LOST:
            self._write(axis, LOST)

    def home(self, axis: Axis, angle_deg: float) -> None:
        """A person has homed the axis: it stands there."""
        self._write(axis, Place(Standing.KNOWN, angle_deg))

    def rest(self, now_s: float, axis: Axis, angle_deg: float) -> None:
        """The axis stands there, counted without doubt. Written when it is worth it."""
        since_s = self._stood[axis][0] if axis in self._stood else now_s
        self._stood[axis] = (since_s, angle_deg)
        place = Place(Standing.KNOWN, round(angle_deg, 3))
        needed_s = REST_S if now_s - self._rested_s[axis] >= SELDOM_S else LONG_REST_S
        if place != self._written[axis] and now_s - since_s >= needed_s and self._write(axis, place):
            self._rested_s[axis] = now_s

    def close(self) -> None:
        """The box ends: whatever stands is written."""
        for axis, (_, angle_deg) in self._stood.items():
            place = Place(Standing.KNOWN, round(angle_deg, 3))
            if place != self._written[axis]:
                self._write(axis, place)

    def _write(self, axis: Axis, place: Place) -> bool:
        places = self._written | {axis: place}
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self._path, encode(places, self._cams))
        except OSError as fault:
            if str(fault) != self.trouble:
                log.error("%s: the count cannot be kept: %s", self._path, fault)
            self.trouble = str(fault)
            return False
        self.trouble = ""
        self._written = places
        return True
