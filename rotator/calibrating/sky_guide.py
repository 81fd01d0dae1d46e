"""Guides the operator at Sun, Moon or a satellite: steer until it is centred, say so, and see how the mount stands.

Knows what to ask, what to refuse, and when a point counts. Pure: no clock, no terminal, no file; where the target is
comes with `see`. The antenna moves by the operator's presses, and by an order to point there once the operator agrees.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass

from rotator.calibrating.entries import Entry, Press, StopNow, Word
from rotator.calibrating.facts import SkyFacts
from rotator.calibrating.guide import CONFIRM_S, NOTHING_SAVED, ORDER_TAKEN_S, Abandoned, SteeringGuide, Steps, refused
from rotator.calibrating.results import MountFound
from rotator.calibrating.sky_table import Residuals, found_text, miss_text, pictures, table, terms_text
from rotator.control.sky.model_fit import NoFit, SkyPoint, fitted
from rotator.control.sky.pointing_model import PERFECT
from rotator.exchange.orders import Aim, Stop
from rotator.exchange.status import Status

KEYS = "r l u d steer a little, R L U D further; s stops; Enter takes a point, b takes it back; f ends; q leaves."
ACCEPTS = "y turns to the target; r l u d steer; Enter: it is centred; b takes the last point back; f: no more."
FINE_S = 0.15
"""How long one key press turns here: a beam is centred by small steps."""
READINGS = 20
"""Of the axes, for one point: the noise of a pot falls to a quarter."""
FARTHEST_DEG = 25.0
"""A boom further from its target than this is at something else, or its rotor is not set up."""
STANDS_S = 1.0
PATIENCE_S = 180.0


@dataclass(frozen=True, slots=True)
class Sighting:
    """Where the target is at this moment."""

    azimuth_deg: float
    elevation_deg: float
    moment: str
    """The time by the box's clock, as text."""
    finder: str = ""
    """Where the target seems to be along a simulated boom, which no eye can see; empty for a real one."""


class SkyGuide(SteeringGuide):
    """Give `see` the latest sighting before each step."""

    def __init__(self, facts: SkyFacts) -> None:
        super().__init__(KEYS, tap_s=FINE_S)
        self.result: MountFound | None = None
        self.residuals: Residuals | None = None
        """What was shown last of how far off the boom is at each point."""
        self._facts = facts
        self._seen = Sighting(0.0, 0.0, "")
        self.points: list[SkyPoint] = []
        self._moved = False

    def see(self, sighting: Sighting) -> None:
        self._seen = sighting

    def _take(self, status: Status, entry: Entry | None) -> None:
        super()._take(status, entry)
        if self._moved and not status.moving and self._seen.finder:
            self._say(f"  {self._seen.finder}")
        self._moved = status.moving

    def _path(self) -> Steps:
        self._explain()
        yield
        yield from self._await_axes()
        self._check_axes()
        if not (yield from self._agrees(f"It is {self._seen.moment} by this box's clock. To the second?")):
            raise Abandoned("Then set the clock first: a wrong time is a wrong direction. Nothing is saved.")
        self._check_up()
        if self._facts.points:
            yield from self._earlier()
        yield from self._collect()
        yield from self._propose()

    def _explain(self) -> None:
        name = self._facts.target
        self._say(
            f"How the mount really stands, by {name}. Steer the antenna until {name} is in the middle of its beam: by",
            "its signal, by its shadow, or along the boom. Be ready to cut its supply. Space or s stops it.",
            f"  {KEYS}",
            "  Never look along the boom at the Sun." if name == "the Sun" else "",
        )

    def _await_axes(self) -> Steps:
        """Wait until each axis has an angle, or the box knows why it has none."""
        began_s = self._now_s
        while self._now_s - began_s < CONFIRM_S and any(
            axis.angle_deg is None and axis.fault is None for axis in (self._status.azimuth, self._status.elevation)
        ):
            yield

    def _check_axes(self) -> None:
        for axis in (self._status.azimuth, self._status.elevation):
            if axis.fault is not None:
                raise refused(axis.fault)
        for name, axis in (("azimuth", self._status.azimuth), ("elevation", self._status.elevation)):
            if axis.uncalibrated or axis.angle_deg is None:
                lacks = axis.uncalibrated or "an angle"
                raise refused(f"set up the {name} first, it lacks {lacks}")

    def _check_up(self) -> None:
        name, seen = self._facts.target, self._seen
        if seen.elevation_deg < 0:
            raise Abandoned(
                f"{name[0].upper()}{name[1:]} is {-seen.elevation_deg:.0f}° below the horizon: begin again when it is "
                "up, or take another with --target. Nothing is saved."
            )

    def _earlier(self) -> Steps:
        count = len(self._facts.points)
        if (yield from self._agrees(f"The file has {count} point{'s' if count > 1 else ''}. Keep them?")):
            self.points += self._facts.points

    # --- points

    def _collect(self) -> Steps:
        self._say("", "One or two points tell the offsets, three a tilt, six and more all. Take them far apart.")
        while True:
            count = f"{len(self.points)} point{'' if len(self.points) == 1 else 's'}"
            prompt = f"{count}. y: {self._offer}; r l u d: steer; Enter: centred; f: no more."
            match (yield from self._ask(prompt, ACCEPTS, may_go_back=True)):
                case Word.YES:
                    yield from self._go()
                case Word.ENTER:
                    yield from self._take_point()
                case Word.BACK if self.points:
                    point = self.points.pop()
                    self._say(f"Taken back: the point at {point.azimuth_deg:.1f}°, {point.elevation_deg:.1f}°.")
                case Word.BACK:
                    self._say("There is no point to take back.")
                case Word.FINISH | Word.NO:
                    return
                case _:
                    self._say(self._accepts)

    @property
    def _offer(self) -> str:
        return f"turn to {self._facts.target}"

    def _go(self) -> Steps:
        """Turn to the target, and wait until the antenna stands."""
        self._check_up()
        self.prompt = f"It turns to {self._facts.target}; s stops it."
        if problem := (yield from self._turn(self._seen.azimuth_deg, self._seen.elevation_deg)):
            self._say(problem)

    def _turn(self, azimuth_deg: float, elevation_deg: float, stands_s: float = STANDS_S) -> Generator[None, None, str]:
        """Turn there, and wait until the antenna has stood for so long. Returns why it does not; empty: it does."""
        self._orders += [Stop(), Aim(azimuth_deg, elevation_deg, place=True)]
        began_s = still_s = self._now_s
        while self._now_s - still_s < stands_s or self._now_s - began_s < ORDER_TAKEN_S:
            yield
            # Looked at first after each step: in the last one, too, a stop ends more than this turn.
            if isinstance(self._entry, (Press, StopNow)):
                self._halt()
                return "Stopped."
            if self._now_s - began_s > PATIENCE_S:
                self._halt()
                return "It has not come to rest: stopped."
            self._check_axes()
            if self._status.moving:
                still_s = self._now_s
        self._orders.append(Stop())
        return ""

    def _take_point(self) -> Steps:
        """The axes as they stand, and the target where it was when the operator said so."""
        seen = self._seen
        if seen.elevation_deg < 0:
            self._say(f"Refused: {self._facts.target} is below the horizon.")
            return
        self._orders.append(Stop())
        self.prompt = "Reading; hands off."
        sums, count, read_s = [0.0, 0.0], 0, None
        while count < READINGS:
            yield
            if isinstance(self._entry, (Press, StopNow)) or self._status.moving:
                self._say("Refused: it moved while it was read. Let it stand.")
                return
            angles_deg = self._status.azimuth.angle_deg, self._status.elevation.angle_deg
            if self._now_s != read_s and angles_deg[0] is not None and angles_deg[1] is not None:
                read_s, count = self._now_s, count + 1
                sums = [sums[0] + angles_deg[0], sums[1] + angles_deg[1]]
            self._check_axes()
        self._add(SkyPoint(sums[0] / count, sums[1] / count, seen.azimuth_deg, seen.elevation_deg))

    def _add(self, point: SkyPoint) -> None:
        miss = point.miss(self._facts.model)
        if math.hypot(*miss) > FARTHEST_DEG:
            self._say(f"Refused: {self._facts.target} is {math.hypot(*miss):.0f}° from where the boom points.")
            return
        self.points.append(point)
        self._say(
            f"Point {len(self.points)}: the axes at {point.axis_azimuth_deg:.2f}°, {point.axis_elevation_deg:.2f}°; "
            f"{self._facts.target} at {point.azimuth_deg:.2f}°, {point.elevation_deg:.2f}°,",
            f"   {miss_text(miss)} of where the boom should point by the model in force.",
        )

    # --- the model

    def _propose(self) -> Steps:
        before = self._facts.model
        try:
            fit = fitted(self.points, before)
        except NoFit as reason:
            self._say(*table(self.points, before, None), f"{str(reason)[0].upper()}{str(reason)[1:]}. {NOTHING_SAVED}")
            return
        self.residuals = Residuals(tuple(self.points), before, fit.model)
        self._say(
            "",
            *table(self.points, before, fit.model),
            *pictures(self.residuals),
            "",
            f"  now   {terms_text(before)}" if before != PERFECT else "  now   none",
            f"  then  {terms_text(fit.model)}",
            f"It points {fit.before_deg:.2f}° off now, and {fit.rms_deg:.2f}° with the new terms (rms)."
            f"{found_text(fit)}",
        )
        if (yield from self._agrees("Save it?")):
            self.result = MountFound(fit.model, self._facts.own_scale(tuple(self.points)))
        else:
            self._say(NOTHING_SAVED)
