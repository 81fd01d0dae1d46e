"""Guides the box through a cross about its target: it looks by itself where a receiver hears the target best.

Knows what to say, what to refuse, and when a place has been heard. Pure: no clock, no socket; the target's place and
the receiver's strength come with `see` and `hear`. A point found is one as if a person had centred the target.
"""

from __future__ import annotations

import math
from collections.abc import Generator

from hw.ports import Axis
from rotator.calibrating.cross import (
    LEAST_PLACES,
    NARROW,
    WIDE,
    Beside,
    Cross,
    at_edge,
    boom_direction,
    nearby,
    within_reach,
)
from rotator.calibrating.entries import Entry, Press, StopNow
from rotator.calibrating.facts import SkyFacts
from rotator.calibrating.guide import Steps
from rotator.calibrating.receiver import Strength
from rotator.calibrating.sky_guide import KEYS, SkyGuide
from rotator.calibrating.sky_table import miss_text
from rotator.control.sky.beam_fit import Heard, Middle, NoPeak, middle
from rotator.control.sky.model_fit import SkyPoint
from rotator.exchange.status import Status

STANDS_S = 0.5
"""So long the antenna stands before its receiver is listened to: its automatic gain settles."""
LISTENS_S = 1.5
LEAST_READINGS = 5
SILENT_S = 5.0
"""A receiver that gives no strength for this long is gone."""
PASSES_BY = 1 / 8
"""A target that has moved on by this part of the beam ends the listening at a place."""
MOST_DOUBT = 1 / 8
"""The middle must be known to this part of the beam."""

Scanned = Generator[None, None, list[Heard]]


class _Ended(Exception):  # noqa: N818 - the scan ends here; the program has not failed
    """Why there is no point. The text is shown."""


class ScanGuide(SkyGuide):
    """Give `hear` the receiver's latest strength before each step."""

    def __init__(self, facts: SkyFacts) -> None:
        super().__init__(facts)
        self._strength: Strength | None = None
        self._good_s: float | None = None
        """When the receiver last gave a strength; before the first one, when the wait for it began."""
        self._came = {Axis.AZIMUTH: 0, Axis.ELEVATION: 0}
        """Which way each axis turned last."""

    def hear(self, strength: Strength | None) -> None:
        """One that tells a problem counts as silent: a single answer that fails ends nothing."""
        self._strength = strength
        if strength is not None and not strength.problem:
            self._good_s = strength.at_s

    def _take(self, status: Status, entry: Entry | None) -> None:
        super()._take(status, entry)
        for axis in Axis:
            if drive := int(status.axis(axis).drive):
                self._came[axis] = drive

    def _explain(self) -> None:
        name, beam_deg = self._facts.target, self._facts.beam_deg
        self._say(
            f"How the mount really stands, by {name} and a receiver. The box turns across {name}, and up and down,",
            f"{beam_deg:g}° to each side ([station] beam_deg), and finds where it is loudest; that takes some minutes.",
            "Be ready to cut its supply. Space or s stops it.",
            f"  {KEYS}",
        )

    @property
    def _offer(self) -> str:
        return f"turn to {self._facts.target} and scan"

    def _go(self) -> Steps:
        self._check_up()
        try:
            self._receiver_hears()
            found = yield from self._scan()
        except (_Ended, NoPeak) as reason:
            self._halt()
            text = str(reason)
            end = "" if text.endswith("?") else "."
            self._say(f"{text[0].upper()}{text[1:]}{end} No point is taken.")
            return
        self._say(*_told(found, self._facts.beam_deg))
        self._add(self._point(found))

    def _scan(self) -> Generator[None, None, Middle]:
        """Raises _Ended, NoPeak."""
        beam_deg = self._facts.beam_deg
        heard = yield from self._cross((0.0, 0.0), WIDE, "the first cross")
        found = middle(heard, beam_deg)
        if at_edge(heard, (found.right_deg, found.above_deg), beam_deg):
            self._say(f"  The peak lies at the edge, {_place(found)}: once more about that place.")
            heard += yield from self._cross((found.right_deg, found.above_deg), WIDE, "the second cross")
            found = middle(heard, beam_deg)
            if at_edge(heard, (found.right_deg, found.above_deg), beam_deg):
                raise _Ended(f"the peak lies further out still, {_place(found)}: steer nearer to it, or wait")
        self._say(f"  Loudest {_place(found)}, ±{found.doubt_deg:.2f}°: once more, about that place.")
        heard += yield from self._cross((found.right_deg, found.above_deg), NARROW, "the last cross")
        found = middle(nearby(heard, (found.right_deg, found.above_deg), beam_deg), beam_deg)
        if max(found.right_doubt_deg, found.above_doubt_deg) > beam_deg * MOST_DOUBT:
            raise _Ended(f"the signal fades too much: the peak is known to ±{found.doubt_deg:.1f}° only")
        return found

    def _cross(self, centre: Beside, size: tuple[float, int], name: str) -> Scanned:
        heard: list[Heard] = []
        cross = Cross(centre, self._facts.beam_deg, *size)
        arms = [[place for place in arm if self._free(place)] for arm in cross.arms()]
        if min(map(len, arms)) < LEAST_PLACES:
            raise _Ended(f"range, horizon or sectors leave too little room around {self._facts.target}")
        there_and_back = [place for arm in arms for place in (*arm, *reversed(arm))]
        for number, place in enumerate(there_and_back, 1):
            self.prompt = f"{name[0].upper()}{name[1:]}: place {number} of {len(there_and_back)}; s stops it."
            seen = self._seen
            target = seen.azimuth_deg, seen.elevation_deg
            if problem := (yield from self._turn(*boom_direction(target, place), STANDS_S)):
                raise _Ended(problem.rstrip("."))
            heard.append((yield from self._listen()))
        return heard

    def _free(self, place: Beside) -> bool:
        facts, seen = self._facts, self._seen
        there = boom_direction((seen.azimuth_deg, seen.elevation_deg), place)
        stands_deg = self._status.azimuth.angle_deg or 0.0
        return within_reach(facts.mount, there, stands_deg, facts.beam_deg)

    def _listen(self) -> Generator[None, None, Heard]:
        """The mean of what the receiver tells while the boom stands, and of where the target is beside it."""
        began_s = self._now_s
        told: list[float] = []
        latest_s = -math.inf
        beside: list[Beside] = []
        while True:
            yield
            if isinstance(self._entry, (Press, StopNow)):
                raise _Ended("stopped")
            self._check_axes()
            if self._seen.elevation_deg < 0:
                raise _Ended(f"{self._facts.target} has set")
            self._receiver_hears()
            beside.append(self._beside())
            strength = self._strength
            # An answer to a question of before is of the place before.
            if strength is not None and strength.is_of(began_s) and strength.at_s > latest_s:
                latest_s = strength.at_s
                told.append(strength.strength_db)
            passes_by = math.dist(beside[0], beside[-1]) > PASSES_BY * self._facts.beam_deg
            if len(told) >= LEAST_READINGS and (self._now_s - began_s >= LISTENS_S or passes_by):
                break
        right_deg, above_deg = (sum(part) / len(beside) for part in zip(*beside, strict=True))
        over = self._facts.model.over_the_top(self._status.elevation.angle_deg or 0.0)
        came_up = -self._came[Axis.ELEVATION] if over else self._came[Axis.ELEVATION]
        return Heard(right_deg, above_deg, sum(told) / len(told), self._came[Axis.AZIMUTH], came_up)

    def _receiver_hears(self) -> None:
        """Raises _Ended where it has given no strength for long, or none at all."""
        if self._good_s is None:
            self._good_s = self._now_s
        if self._now_s - self._good_s > SILENT_S:
            problem = self._strength.problem if self._strength else ""
            raise _Ended(problem or f"the receiver has given no strength for {SILENT_S:.0f} s")

    def _beside(self) -> Beside:
        """Where the target seems to be from the boom, by the model in force."""
        status, seen = self._status, self._seen
        axes = status.azimuth.angle_deg or 0.0, status.elevation.angle_deg or 0.0
        return SkyPoint(*axes, seen.azimuth_deg, seen.elevation_deg).miss(self._facts.model)

    def _point(self, found: Middle) -> SkyPoint:
        """Where the axes stand when the target, where it is now, is in the middle of the beam."""
        target = self._seen.azimuth_deg, self._seen.elevation_deg
        azimuth_deg, elevation_deg = boom_direction(target, (found.right_deg, found.above_deg))
        if self._facts.model.over_the_top(self._status.elevation.angle_deg or 0.0):
            azimuth_deg, elevation_deg = azimuth_deg + 180.0, 180.0 - elevation_deg
        axis_azimuth_deg, axis_elevation_deg = self._facts.model.axis_angles(azimuth_deg, elevation_deg)
        stands_deg = self._status.azimuth.angle_deg or 0.0
        turns = round((stands_deg - axis_azimuth_deg) / 360.0)
        return SkyPoint(axis_azimuth_deg + 360.0 * turns, axis_elevation_deg, *target)


def _place(found: Middle) -> str:
    sideways, upright = miss_text((found.right_deg, found.above_deg)).split(", ")
    return f"when the target is {sideways} of the boom and {upright} it"


def _told(found: Middle, beam_deg: float) -> list[str]:
    wide, high = found.beam_deg
    lines = [
        f"  Loudest {_place(found)}: ±{found.right_doubt_deg:.2f}° and ±{found.above_doubt_deg:.2f}°;",
        f"  {found.rise_db:.1f} dB above the edge, fading {found.noise_db:.1f} dB, beam {wide:.0f}° by {high:.0f}°.",
    ]
    play = [f"{abs(deg):.1f}° in {axis}" for deg, axis in zip(found.play_deg, ("azimuth", "elevation"), strict=True)]
    if max(map(abs, found.play_deg)) > 3 * found.doubt_deg:
        lines.append(f"  The gears seem to have play: {' and '.join(play)}, on the sky (backlash_deg).")
    if not 0.6 < wide / beam_deg < 1.6:
        lines.append(f"  [station] beam_deg = {wide:.0f} would fit better than {beam_deg:g}.")
    return lines
