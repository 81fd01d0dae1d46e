"""The file with the angles of the axes that count pulses: without it the count is lost at power-off.

Knows the file's form, and when an angle is written. The file marks an axis as moving before the axis moves. After a
power cut during a move the mark remains, and the axis is lost. Does not know how pulses are counted.

Memory cards wear. A move costs one write before it and one after it. While a satellite is tracked, with a step every
few seconds, the mark stays in the file: a rest is written after 2 s if the last write is a minute old, otherwise after
20 s.
So tracking costs two writes a minute for each axis, and the busiest series of orders six. With 30 kB a write (the file
system included), eight hours of tracking a day on two axes write 60 MB a day or 21 GB a year. A 16 GB card can take a
thousand times its size.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.store import json_file
from rotator.store.forms import Form
from rotator.store.json_file import JsonFile, number

FILE_NAME = "counts.json"
"""Beside the state file."""
FORM = Form("rotator counts")
REST_S = 2.0
"""Seconds of rest before an angle is written, if the last write is older than REST_EVERY_S; otherwise LONG_REST_S."""
WIDEST_DEG = 1000.0
"""Degrees: no rotor turns further. The rotor's own, narrower range is checked when the count is used."""
LONG_REST_S = 20.0
REST_EVERY_S = 60.0


class Standing(Enum):
    """The state of an axis in the file. A KNOWN axis can be aimed; any other takes only jog orders until homed."""

    KNOWN = "known"
    MOVING = "moving"
    """The mark in the file: the axis was about to move when the mark was written."""
    LOST = "lost"
    NEVER = "never homed"


@dataclass(frozen=True, slots=True)
class Place:
    """`angle_deg` is on the rotor's own scale; NaN unless the standing is KNOWN."""

    standing: Standing
    angle_deg: float = math.nan


CamSettings = Mapping[str, object]
"""The settings of an axis's contact in the configuration. A count made with other settings is not valid."""

NEVER, LOST, MOVING = Place(Standing.NEVER), Place(Standing.LOST), Place(Standing.MOVING)


def encode(places: Mapping[Axis, Place], cams: Mapping[Axis, CamSettings]) -> str:
    return json_file.encode(FORM, _content(places, cams))


def decode(text: str, cams: Mapping[Axis, CamSettings]) -> dict[Axis, Place]:
    """KNOWN, LOST or NEVER for each axis of `cams`. Raises ValueError where the text is damaged or another file's."""
    return json_file.decode(FORM, text, lambda content: _parse(content, cams))


def _content(places: Mapping[Axis, Place], cams: Mapping[Axis, CamSettings]) -> dict[str, object]:
    axes: dict[str, dict[str, object]] = {}
    for axis, place in places.items():
        if place.standing is not Standing.NEVER:
            axes[axis.value] = {"cam": dict(cams[axis]), "standing": place.standing.value}
        if place.standing is Standing.KNOWN:
            axes[axis.value]["angle_deg"] = place.angle_deg
    return {"axes": axes}


def _parse(content: dict[str, Any], cams: Mapping[Axis, CamSettings]) -> dict[Axis, Place]:
    tables = dict(content["axes"])
    return {axis: _place(tables[axis.value], cam) if axis.value in tables else NEVER for axis, cam in cams.items()}


def _known(angle_deg: float) -> Place:
    """In thousandths of a degree, which are finer than any contact: a digit more would only be another write."""
    return Place(Standing.KNOWN, round(angle_deg, 3))


def _place(table: Mapping[str, Any], cam: CamSettings) -> Place:
    if Standing(table["standing"]) is not Standing.KNOWN or table["cam"] != dict(cam):
        return LOST
    return Place(Standing.KNOWN, number(table["angle_deg"], "an angle", -WIDEST_DEG, WIDEST_DEG))


class CountsFile:
    """Call `load` first; then `start` before a move, `rest` in each cycle while an axis stands, `close` at the end.

    Failures go to the log, and nothing is raised. While the file cannot be written, only an axis without a known angle
    may move.
    """

    def __init__(self, path: Path, cams: Mapping[Axis, CamSettings]) -> None:
        self._file = JsonFile(path, FORM, "the count")
        self._cams = cams
        self._written: dict[Axis, Place] = dict.fromkeys(cams, NEVER)
        self._stood: dict[Axis, tuple[float, float]] = {}
        """For an axis at rest: since when, and its angle."""
        self._doubted: set[Axis] = set()
        """The axes whose count may be wrong. The file may not show it yet: a card may have refused the write."""
        self._rested_s = dict.fromkeys(cams, -math.inf)

    @property
    def trouble(self) -> str:
        """The reason of the last failed write; empty after a good one."""
        return self._file.trouble

    def load(self) -> dict[Axis, Place]:
        """The state of each axis at the end of the last run. With a damaged file every axis is LOST."""
        self._written = self._file.load(
            lambda content: _parse(content, self._cams),
            absent=self._written,
            damaged=dict.fromkeys(self._cams, LOST),
            consequence="cannot be believed, the axes must be homed",
        )
        return dict(self._written)

    def start(self, axis: Axis) -> bool:
        """The axis is about to move. True: it may, because the mark is in the file or the axis has no known angle."""
        self._stood.pop(axis, None)
        return self._written[axis].standing is not Standing.KNOWN or self._write(axis, MOVING)

    def lose(self, axis: Axis) -> None:
        """The count can no longer be trusted. After a failed write the next call, or `close`, tries again."""
        self._stood.pop(axis, None)
        self._doubted.add(axis)
        if self._written[axis].standing is not Standing.LOST:
            self._write(axis, LOST)

    def home(self, axis: Axis, angle_deg: float) -> None:
        """The axis has been homed and stands at this angle. Angles before belong to another count."""
        self._stood.pop(axis, None)
        self._doubted.discard(axis)
        if not self._write(axis, _known(angle_deg)):
            self._stood[axis] = (-math.inf, angle_deg)  # the next `rest`, or `close`, tries again

    def rest(self, now_s: float, axis: Axis, angle_deg: float) -> None:
        """The axis stands at this angle, and its count is right. The angle is written after a long enough rest."""
        since_s = self._stood[axis][0] if axis in self._stood else now_s
        self._stood[axis] = (since_s, angle_deg)
        place = _known(angle_deg)
        needed_s = REST_S if now_s - self._rested_s[axis] >= REST_EVERY_S else LONG_REST_S
        different = place != self._written[axis] or self._file.changed
        if different and now_s - since_s >= needed_s and self._write(axis, place):
            self._rested_s[axis] = now_s

    def close(self) -> None:
        """The box ends: write the angle of each axis at rest, and each doubt that a card has refused."""
        for axis in self._doubted:
            self.lose(axis)
        for axis, (_, angle_deg) in self._stood.items():
            place = _known(angle_deg)
            if place != self._written[axis] or self._file.changed:
                self._write(axis, place)

    def _write(self, axis: Axis, place: Place) -> bool:
        places = self._written | {axis: place}
        if not self._file.save(_content(places, self._cams)):
            return False
        self._written = places
        return True
