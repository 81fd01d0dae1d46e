"""The boom with its compass, for a walk: sent to a place, let stand, looked at; and what a person does meanwhile.

Pure: the antenna moves by orders, and the compass is what has been sighted last. Knows nothing of what is asked, nor
what north is made of.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from hw.ports import Axis
from rotator.calibrating.answers import Answer, Halt, Press
from rotator.calibrating.bearing import Learnt, Look, Sighting
from rotator.calibrating.degrees import BEGIN_S, PLACED_S
from rotator.calibrating.walk import Refused, Steps, Walk
from rotator.control.sky.angles import turn_deg
from rotator.faults import FaultKind
from rotator.orders import Aim, Confirm, Jog, Stop
from rotator.status import AxisStatus, Status

FULL_TURN_DEG = 360.0
PLACE_EVERY_DEG = 45.0
LEAST_PLACES = 3
LOOKS = 40
"""Four seconds and more, longer than a boom takes to swing."""
STANDS_S, STANDS_WITHIN_DEG = 3.0, 1.0
"""So long within so much: it stands, and has swung to rest."""
PAUSE_S = 1.0
"""Between the steps in which it is turned about."""
STALE_S, SILENT_S = 1.0, 3.0
"""An older sighting is none. A compass may be busy with itself now and then, but not for so long."""
NEAR_DEG = 15.0
"""It has come to its place."""
PATIENCE_S = 600.0
"""A motor that has to cool stands for minutes and goes on by itself."""
RAISED_DEG = 60.0
"""How far up it is turned while the compass learns."""
KEYS = "r and l turn it clockwise and back, u and d up and down; s stops it; y, n, numbers and Enter answer; q leaves."


@dataclass(frozen=True, slots=True)
class Scale:
    """What the file says of north."""

    offset_deg: float
    """`azimuth.offset_deg` as it is."""
    shift_deg: float
    """Added to the rotor's own scale to have what the box reports: that offset, and what `[mount] north` adds."""
    declination_deg: float | None
    """What is to be added to what the compass says; 0 where the scale is magnetic; None: nobody has said."""
    compass_offset_deg: float = 0.0
    keeps: bool = True
    """There is a file for what the compass has learnt."""


@dataclass(frozen=True, slots=True)
class Knows:
    """The compass has just come to know its errors."""


class Boom(Walk):
    """What the guide to north leans on. `see` every new sighting of the compass before a step."""

    def __init__(self, scale: Scale) -> None:
        super().__init__(KEYS, -360.0, 720.0)
        self._scale = scale
        self._compass: Sighting | None = None
        self._heard_s: float | None = None
        self._told = Learnt()
        self._learning = False
        """What the compass learns is told, and that it has learnt enough is an event."""
        self._pressed_s: float | None = None

    def see(self, sighting: Sighting) -> None:
        self._compass = sighting

    def ready(self, answer: Answer) -> bool:
        if isinstance(answer, Halt):
            return True
        pressed = self._pressed_s is not None and self._now_s - self._pressed_s < BEGIN_S
        return self._asking and not (pressed or self._status is None or self._status.moving)

    # --- moving and looking

    def _places(self) -> list[float]:
        """Spread evenly over one turn, or over what there is of one; from the nearer end; as the box reports."""
        span_deg = min(self._span_deg, FULL_TURN_DEG)
        count = max(LEAST_PLACES, round(span_deg / PLACE_EVERY_DEG))
        least_deg = self._azimuth.min_deg + (self._span_deg - span_deg) / 2.0
        places = [least_deg + (at + 0.5) * span_deg / count for at in range(count)]
        stands_deg = places[0] if self._azimuth.angle_deg is None else self._azimuth.angle_deg
        return places if abs(stands_deg - places[0]) <= abs(stands_deg - places[-1]) else places[::-1]

    def _go(
        self, azimuth_deg: float, stands_s: float = STANDS_S, *, raised: bool = False
    ) -> Generator[None, None, bool]:
        """Whether it got there and has stood for so long; False: the person has stopped it."""
        # A place of its own, not the next point of a path; and elevation where it can be sent anywhere.
        self._orders += [Stop(), Aim(azimuth_deg, self._elevation_deg(raised=raised))]
        self.prompt = f"It turns to {azimuth_deg - self._scale.shift_deg:.0f}°; s stops it."
        still_s = self._now_s
        stood = self._stands
        yield
        while True:
            if isinstance(self._answer, Halt):
                self._halt()
                self._say("Stopped.")
                return False
            if self._azimuth.fault is not None:
                raise Refused(f"Refused: {self._azimuth.fault}. Nothing is saved.")
            if any(abs(now - before) > STANDS_WITHIN_DEG for now, before in zip(self._stands, stood, strict=True)):
                stood, still_s = self._stands, self._now_s
            elif self._now_s - still_s >= stands_s and self._is_at(azimuth_deg):
                self._halt()
                return True
            elif self._now_s - still_s > PATIENCE_S:
                raise Refused("Refused: the azimuth does not go where it is sent. Nothing is saved.")
            yield

    def _look(self, *, anywhere: bool = False) -> Generator[None, None, list[Look]]:
        """What the compass says while the antenna stands; `anywhere`: where it stands nobody knows."""
        self.prompt = "Reading the compass; hands off."
        looks: list[Look] = []
        seen = self._compass
        while len(looks) < LOOKS and not isinstance(self._answer, Halt):
            yield
            compass, angle_deg = self._compass, self._azimuth.angle_deg
            if compass is None or compass is seen or compass.problem:
                continue
            seen = compass
            if angle_deg is None and not anywhere:
                raise Refused("Refused: the azimuth has no angle. Nothing is saved.")
            own_deg = 0.0 if angle_deg is None else angle_deg - self._scale.shift_deg
            looks.append(Look(compass.heading_deg, own_deg, compass.learnt.magnetometer, compass.tilt_deg))
        return looks

    def _elevation_deg(self, *, raised: bool) -> float | None:
        axis = self._status.elevation if self._status else None
        if axis is None or axis.uncalibrated or axis.fault or axis.angle_deg is None:
            return None
        level_deg = min(max(0.0, axis.min_deg), axis.max_deg)
        return min(level_deg + RAISED_DEG, axis.max_deg) if raised else level_deg

    def _is_at(self, azimuth_deg: float) -> bool:
        stands_deg = self._azimuth.angle_deg
        return stands_deg is not None and abs(turn_deg(stands_deg, azimuth_deg)) <= NEAR_DEG

    def _confirm(self, angle_deg: float) -> Steps:
        """On the rotor's own scale."""
        self._orders.append(Confirm(Axis.AZIMUTH, angle_deg + self._scale.shift_deg))
        began_s = self._now_s
        while (self._unplaced or self._azimuth.angle_deg is None) and self._now_s - began_s < PLACED_S:
            yield
        if self._azimuth.angle_deg is None:
            self._say("The controller does not take it.")
        else:
            self._say(f"It stands at {self._azimuth.angle_deg - self._scale.shift_deg:.1f}° on the rotor's own scale.")

    # --- what happens by the way

    def _take(self, status: Status, answer: Answer | None) -> None:
        super()._take(status, answer)
        self._event = None
        compass = self._compass
        heard = compass is not None and not compass.problem and status.at_s - compass.at_s < STALE_S
        self._heard_s = status.at_s if heard or self._heard_s is None else self._heard_s
        if status.at_s - self._heard_s > SILENT_S:
            why = compass.problem if compass and compass.problem else "it does not answer"
            raise Refused(f"Refused: no compass: {why}. Nothing is saved.")
        if compass is not None and heard and self._learning and compass.learnt != self._told:
            self._told = compass.learnt
            self._say(f"  compass: {compass.learnt}")
            if compass.learnt.magnetometer == 3:
                self._event = Knows()

    def _press(self, press: Press, *, may_turn: bool) -> None:
        if not may_turn:
            self._say("First answer, please; then it may turn again.")
        elif press.seconds > 0:
            self._pressed_s = self._now_s
            self._orders.append(Jog(press.axis, press.direction, press.seconds))

    @property
    def _azimuth(self) -> AxisStatus:
        assert self._status is not None, "a step has a status"
        return self._status.azimuth

    @property
    def _now_s(self) -> float:
        assert self._status is not None, "a step has a status"
        return self._status.at_s

    @property
    def _stands(self) -> tuple[float, float]:
        """Where both axes are, as far as they know."""
        assert self._status is not None, "a step has a status"
        return self._status.azimuth.angle_deg or 0.0, self._status.elevation.angle_deg or 0.0

    @property
    def _known(self) -> bool:
        return self._azimuth.raw is not None

    @property
    def _unplaced(self) -> bool:
        fault = self._azimuth.fault
        return fault is not None and fault.kind is FaultKind.POSITION_UNKNOWN

    @property
    def _learnt(self) -> Learnt:
        return self._compass.learnt if self._compass else Learnt()

    @property
    def _span_deg(self) -> float:
        return self._azimuth.max_deg - self._azimuth.min_deg
