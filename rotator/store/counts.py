"""The file with the angles of the axes that count pulses, or are reckoned by time: lost at power-off without it.

Knows the file's form, and when an angle is written. The file marks an axis as moving before the axis moves. After a
power cut during a move the mark remains, and the axis is lost. Does not know how pulses are counted.

Memory cards wear. Each move costs two writes: the mark before it, and the angle as soon as the axis stands. Each
overwrites the file's one block of 4 kB in place, and the check sum in it shows a block that a power failure has mixed:
then both axes are lost. `python -m benchmarks.cuts` counts the writes of a year.
"""

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.store import json_file
from rotator.store.json_file import Form, JsonFile, number

FILE_NAME = "counts.json"
"""Beside the state file."""
FORM = Form("rotator counts")
WIDEST_DEG = 1000.0
"""Degrees: no rotor turns further. The rotor's own, narrower range is checked when the count is used."""

FURTHEST_DEG = 1e9
"""Degrees: no rotor turns so far in its life."""


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
    travelled_deg: float = 0.0
    """How far an axis that is reckoned by time has turned since it was at its end stop."""
    mid_move: bool = field(default=False, compare=False)
    """LOST because the program ended in mid-move: a chip that counts without it knows more."""


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
        if place.travelled_deg:
            axes[axis.value]["travelled_deg"] = place.travelled_deg
    return {"axes": axes, "check": _check(axes)}


def _check(axes: Mapping[str, object]) -> int:
    """A sum over all that is written of the axes."""
    return zlib.crc32(json.dumps(axes, sort_keys=True).encode("utf-8"))


def _parse(content: dict[str, Any], cams: Mapping[Axis, CamSettings]) -> dict[Axis, Place]:
    tables = dict(content["axes"])
    # A file without a sum is an earlier version's, which replaced it as a whole.
    if content.get("check", _check(tables)) != _check(tables):
        raise ValueError("its check sum is wrong: the power may have failed while it was written")
    return {axis: _place(tables[axis.value], cam) if axis.value in tables else NEVER for axis, cam in cams.items()}


def _known(angle_deg: float, travelled_deg: float = 0.0) -> Place:
    """In thousandths of a degree, which are finer than any contact: a digit more would only be another write. Only an
    axis without ends gets beyond the widest range, and one turn is as good as another there."""
    if abs(angle_deg) > WIDEST_DEG:
        angle_deg %= 360.0
    return Place(Standing.KNOWN, round(angle_deg, 3), round(travelled_deg, 3))


def _place(table: Mapping[str, Any], cam: CamSettings) -> Place:
    standing, same = Standing(table["standing"]), table["cam"] == dict(cam)
    if standing is not Standing.KNOWN or not same:
        return Place(Standing.LOST, mid_move=same and standing is Standing.MOVING)
    travelled_deg = number(table.get("travelled_deg", 0.0), "a way", 0.0, FURTHEST_DEG)
    return Place(Standing.KNOWN, number(table["angle_deg"], "an angle", -WIDEST_DEG, WIDEST_DEG), travelled_deg)


class CountsFile:
    """Call `load` first; then `start` before a move, `rest` now and then while an axis stands, `close` at the end.

    Failures go to the log, and nothing is raised. While the file cannot be written, only an axis without a known angle
    may move.
    """

    def __init__(self, path: Path, cams: Mapping[Axis, CamSettings]) -> None:
        self._file = JsonFile(path, FORM, "the count", one_block=True)
        self._cams = cams
        self._written: dict[Axis, Place] = dict.fromkeys(cams, NEVER)
        self._stood: dict[Axis, Place] = {}
        """The place of each axis at rest."""
        self._doubted: set[Axis] = set()
        """The axes whose count may be wrong. The file may not show it yet: a card may have refused the write."""

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
            self._stood[axis] = _known(angle_deg)  # the next `rest`, or `close`, tries again

    def rest(self, axis: Axis, angle_deg: float, travelled_deg: float = 0.0) -> None:
        """The axis stands at this angle, and its count is right. Writes it, if the file does not have it."""
        place = self._stood[axis] = _known(angle_deg, travelled_deg)
        if place != self._written[axis] or self._file.trouble or self._file.changed:
            self._write(axis, place)

    def close(self) -> None:
        """The box ends: write each angle at rest, and each doubt, that a card has refused."""
        for axis in self._doubted:
            self.lose(axis)
        for axis, place in self._stood.items():
            self.rest(axis, place.angle_deg, place.travelled_deg)

    def _write(self, axis: Axis, place: Place) -> bool:
        places = self._written | {axis: place}
        done = self._file.save(_content(places, self._cams))
        # An angle that was written halfway may be on the card all the same: before a move it needs its mark.
        if done or (place.standing is Standing.KNOWN and self._file.touched):
            self._written = places
        return done
