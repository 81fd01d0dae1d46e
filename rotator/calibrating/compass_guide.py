"""The part of a guide that works with the compass on the boom: turn to a place, wait for rest, sample the heading.

Pure: the antenna moves by orders, and the compass is the latest reading given to `see`. Does not know the order of the
questions, nor how north follows from samples: `north_guide` and `bearing` do.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import Axis, CompassCalibration
from rotator.calibrating.bearing import UNCALIBRATED, CompassReading, HeadingSample
from rotator.calibrating.entries import Entry, StopNow
from rotator.calibrating.facts import NorthFacts
from rotator.calibrating.guide import CONFIRM_S, SteeringGuide, Steps, position_unknown, refused
from rotator.control.sky.angles import FULL_TURN_DEG, turn_deg
from rotator.exchange.orders import Aim, Confirm, Stop
from rotator.exchange.status import Status

PLACE_EVERY_DEG = 45.0
LEAST_PLACES = 3
SAMPLES = 40
"""They take four seconds or more, longer than a boom swings."""
REST_S, REST_WITHIN_DEG = 3.0, 1.0
"""The antenna stands when it has not moved by more than this for this long: then the boom no longer swings."""
PAUSE_S = 1.0
"""Between the steps of a sweep."""
STALE_S, SILENT_S = 1.0, 3.0
"""An older reading does not count. A compass may be busy for a moment, but not for longer than SILENT_S."""
NEAR_DEG = 15.0
"""The antenna has arrived when it is this near to its place."""
PATIENCE_S = 600.0
"""A motor that has to cool stands for minutes and then goes on by itself."""
RAISED_DEG = 60.0
"""How far above level the antenna is raised while the compass learns."""
KEYS = "r, l turn it clockwise and back, u, d up and down; s stops it; y, n, numbers, Enter answer; ? helps; q leaves."


@dataclass(frozen=True, slots=True)
class CompassReady:
    """The event that the compass has just found its errors."""


class CompassGuide(SteeringGuide):
    """Give every new reading of the compass to `see` before a step."""

    def __init__(self, facts: NorthFacts) -> None:
        super().__init__(KEYS)
        self._facts = facts
        self._compass: CompassReading | None = None
        self._answered_s: float | None = None
        """When the compass last gave a usable reading."""
        self._shown = UNCALIBRATED
        self._learning = False
        """Show changes of the compass's calibration, and make its end an event."""

    def see(self, reading: CompassReading) -> None:
        self._compass = reading

    # --- moving and sampling

    def _places(self) -> list[float]:
        """Azimuths as the box reports them, evenly over one turn or over the range, from the nearer end on."""
        span_deg = min(self._span_deg, FULL_TURN_DEG)
        count = max(LEAST_PLACES, round(span_deg / PLACE_EVERY_DEG))
        least_deg = self._axis.min_deg + (self._span_deg - span_deg) / 2.0
        places = [least_deg + (number + 0.5) * span_deg / count for number in range(count)]
        now_deg = places[0] if self._axis.angle_deg is None else self._axis.angle_deg
        return places if abs(now_deg - places[0]) <= abs(now_deg - places[-1]) else places[::-1]

    def _go(self, azimuth_deg: float, rest_s: float = REST_S, *, raised: bool = False) -> Generator[None, None, bool]:
        """Turn there and wait until it has stood for `rest_s`. False: the operator stopped it. Raises Abandoned."""
        # The stop makes this a new target instead of the next point of a path. Elevation only where it can be aimed.
        self._orders += [Stop(), Aim(azimuth_deg, self._elevation_deg(raised=raised))]
        self.prompt = f"It turns to {azimuth_deg - self._facts.shift_deg:.0f}°; s stops it."
        still_s = self._now_s
        stood_deg = self._angles_deg
        yield
        while True:
            if isinstance(self._entry, StopNow):
                self._halt()
                self._say("Stopped.")
                return False
            if self._axis.fault is not None:
                raise refused(self._axis.fault)
            now_deg = self._angles_deg
            if any(abs(now - before) > REST_WITHIN_DEG for now, before in zip(now_deg, stood_deg, strict=True)):
                stood_deg, still_s = now_deg, self._now_s
            elif self._now_s - still_s >= rest_s and self._is_at(azimuth_deg):
                self._halt()
                return True
            elif self._now_s - still_s > PATIENCE_S:
                raise refused("the azimuth does not go where it is sent")
            yield

    def _sample(self, *, angle_unknown: bool = False) -> Generator[None, None, list[HeadingSample]]:
        """Samples of the compass while the antenna stands. `angle_unknown`: they count as taken at azimuth 0."""
        self.prompt = "Reading the compass; hands off."
        samples: list[HeadingSample] = []
        seen = self._compass
        while len(samples) < SAMPLES:
            yield
            if isinstance(self._entry, StopNow):
                return []
            compass, angle_deg = self._compass, self._axis.angle_deg
            if compass is None or compass is seen or compass.problem:
                continue
            seen = compass
            if angle_unknown:
                own_deg = 0.0
            elif angle_deg is not None:
                own_deg = angle_deg - self._facts.shift_deg
            else:
                raise refused("the azimuth has no angle")
            magnetometer = compass.calibration.magnetometer
            samples.append(HeadingSample(compass.heading_deg, own_deg, magnetometer, compass.tilt_deg))
        return samples

    def _elevation_deg(self, *, raised: bool) -> float | None:
        axis = self._status.elevation
        if axis.uncalibrated or axis.fault or axis.angle_deg is None:
            return None
        level_deg = min(max(0.0, axis.min_deg), axis.max_deg)
        return min(level_deg + RAISED_DEG, axis.max_deg) if raised else level_deg

    def _is_at(self, azimuth_deg: float) -> bool:
        now_deg = self._axis.angle_deg
        return now_deg is not None and abs(turn_deg(now_deg, azimuth_deg)) <= NEAR_DEG

    def _confirm(self, angle_deg: float) -> Steps:
        """Tell the controller its angle on the rotor's own scale."""
        self._orders.append(Confirm(Axis.AZIMUTH, angle_deg + self._facts.shift_deg))
        began_s = self._now_s
        while (position_unknown(self._axis) or self._axis.angle_deg is None) and self._now_s - began_s < CONFIRM_S:
            yield
        if self._axis.angle_deg is None:
            self._say("The controller did not accept this angle.")
        else:
            self._say(f"It stands at {self._axis.angle_deg - self._facts.shift_deg:.1f}° on the rotor's own scale.")

    # --- presses, and the compass's calibration

    def _take(self, status: Status, entry: Entry | None) -> None:
        super()._take(status, entry)
        self._event = None
        compass = self._compass
        usable = compass is not None and not compass.problem and status.at_s - compass.at_s < STALE_S
        self._answered_s = status.at_s if usable or self._answered_s is None else self._answered_s
        if status.at_s - self._answered_s > SILENT_S:
            why = compass.problem if compass and compass.problem else "it does not answer"
            raise refused(f"no compass: {why}")
        if compass is not None and usable and self._learning and compass.calibration != self._shown:
            self._shown = compass.calibration
            self._say(f"  compass: {compass.calibration}")
            if compass.calibration.magnetometer == 3:
                self._event = CompassReady()

    @property
    def _angles_deg(self) -> tuple[float, float]:
        """Azimuth and elevation; 0 for an angle that is not known."""
        return self._status.azimuth.angle_deg or 0.0, self._status.elevation.angle_deg or 0.0

    @property
    def _calibration(self) -> CompassCalibration:
        return self._compass.calibration if self._compass else UNCALIBRATED

    @property
    def _span_deg(self) -> float:
        return self._axis.max_deg - self._axis.min_deg
