"""Walks a person through finding north with the compass on the boom: it learns its errors, then tells at some places.

Knows what to ask, where to send the antenna and what to make of the compass. Pure: no clock, no terminal, no chip, no
file; the antenna moves by orders, and only after the person has said yes. The walk is one path from top to bottom.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace

from rotator.calibrating.answers import Enter, No, Number, Yes
from rotator.calibrating.bearing import (
    LEAST_MAGNETOMETER,
    North,
    NorthRefused,
    agree,
    find_north,
)
from rotator.calibrating.boom import FULL_TURN_DEG, KEYS, LEAST_PLACES, PAUSE_S, Boom, Knows, Scale
from rotator.calibrating.degrees import PLACED_S
from rotator.calibrating.walk import Refused, Steps
from rotator.control.sky.angles import turn_deg

RAISED_EVERY = 2
"""Turned about, it is raised at one place of so many."""
BEYOND = 3.0
"""It may be off by so many times what is said."""


@dataclass(frozen=True, slots=True)
class Found:
    """`azimuth.offset_deg`, to be saved."""

    offset_deg: float
    uncertainty_deg: float


@dataclass(frozen=True, slots=True)
class Placed:
    """The azimuth knows where it stands; there is nothing to be saved."""

    angle_deg: float


class NorthGuide(Boom):
    """`see` every new sighting of the compass before a step."""

    def __init__(self, scale: Scale) -> None:
        super().__init__(scale)
        self.result: Found | Placed | None = None
        self.keep = False
        """What the compass has learnt is to be kept, now that the antenna stands; whoever does it sets it to False."""
        self._kept = False

    # --- the walk

    def _walk(self) -> Steps:
        self._say(
            "Finding north with the compass on the boom. The antenna turns only after you have said so; all the same",
            "be ready to cut its supply. Space or s stops it. Ctrl-C or q leaves at any moment, nothing saved.",
            f"  {KEYS}",
        )
        if self._scale.declination_deg is None:
            raise Refused(
                "Refused: a compass tells magnetic north, and nobody has said how far that is from true north here: "
                "write mount.declination_deg (east of true north; west is minus). Nothing is saved."
            )
        yield from self._hear()
        by_compass = yield from self._know_where_it_stands()
        yield from self._learn(may_sweep=not by_compass)
        yield from self._keep_what_it_learnt()
        if by_compass:
            yield from self._place_by_compass()
        else:
            yield from self._find()

    def _hear(self) -> Steps:
        """Compass and azimuth have had time to answer, or will not."""
        yield
        began_s = self._now_s
        while self._compass is None or self._compass.problem:
            yield
        while not (self._known or self._unplaced) and self._now_s - began_s < PLACED_S:
            yield

    def _know_where_it_stands(self) -> Generator[None, None, bool]:
        """Whether the compass is to tell where the azimuth stands, rather than where north is."""
        if self._unplaced:
            self._say(
                "",
                "The azimuth does not know where it stands. Which is known: the offset or the angle?",
                f"   y: azimuth.offset_deg = {self._scale.offset_deg:g} is right; the compass then tells the angle.",
                "   Or type the angle on the rotor's own scale as your eye sees it; the compass then tells the offset.",
            )
            while self._unplaced:
                match (yield from self._ask("y, or the angle:", may_turn=False)):
                    case Yes():
                        return True
                    case Number(angle_deg) if self._is_angle(angle_deg):
                        yield from self._confirm(angle_deg)
                    case No():
                        raise Refused("Left: nothing is saved.")
                    case _:
                        self._say("y, or a number of degrees and Enter, please.")
        axis = self._azimuth
        if axis.fault is not None:
            raise Refused(f"Refused: {axis.fault}. Nothing is saved.")
        if axis.uncalibrated or axis.angle_deg is None:
            missing = axis.uncalibrated or "an angle"
            raise Refused(f"Refused: the azimuth has to be set up first, it lacks {missing}. Nothing is saved.")
        return False

    # --- the compass learns

    def _learn(self, *, may_sweep: bool) -> Steps:
        """Turned about, a compass finds its own errors."""
        self._say("", f"The compass's calibration: {self._learnt}.")
        if self._learnt.magnetometer == 3:
            return
        self._say(
            "   It learns its errors by being turned: slowly, all the way round, and up and down, until the",
            "   magnetometer says 3. 2 will do, then press Enter.",
        )
        offer = "y: the box turns it through its range, raised and level by turns; " if may_sweep else ""
        by_hand = "r l u d: you do; " if may_sweep else "turn it by hand; "
        self._learning = True
        while self._learnt.magnetometer < 3:
            match (yield from self._ask(f"{offer}{by_hand}Enter goes on.")):
                case Knows():
                    break
                case Yes() if may_sweep:
                    yield from self._sweep()
                case Enter() if self._learnt.magnetometer >= LEAST_MAGNETOMETER:
                    break
                case Enter():
                    self._say(f"   Not yet: {self._learnt}.")
                case _:
                    self._say("   Turn it about; Enter when the magnetometer says 2 or 3; q leaves.")
        self._learning = False

    def _sweep(self) -> Steps:
        """There and back in steps, level and raised by turns."""
        places = self._places()
        for at, place_deg in enumerate([*places, *reversed(places)]):
            raised = at % RAISED_EVERY == 1
            if self._learnt.magnetometer == 3 or not (yield from self._go(place_deg, PAUSE_S, raised=raised)):
                return

    def _keep_what_it_learnt(self) -> Steps:
        if self._kept or not self._scale.keeps:
            return
        if not self._learnt.complete:
            self._say(
                "   Not kept: only what is 3 in every part is worth keeping, so after its next power-on the compass "
                "learns anew."
            )
            return
        self.prompt = "Asking the compass for what it has learnt."
        self.keep = self._kept = True
        while self.keep:
            yield

    # --- north

    def _find(self) -> Steps:
        places = self._places()
        shown = ", ".join(f"{place_deg - self._scale.shift_deg:.0f}" for place_deg in places)
        self._say(
            "",
            f"It goes to {len(places)} places and stands at each for some seconds: {shown}° on the rotor's scale.",
            "   Watch the antenna and its cables.",
        )
        if not (yield from self._agrees("Begin? y or n:")):
            raise Refused("Left: nothing is saved.")
        told: list[North] = []
        for place_deg in places:
            north = yield from self._visit(place_deg)
            if north is not None:
                told.append(north)
        if len(told) < LEAST_PLACES:
            raise Refused(f"Refused: {len(told)} places are too few, {LEAST_PLACES} it takes. Nothing is saved.")
        try:
            north = agree(told)
        except NorthRefused as reason:
            raise Refused(f"Refused: {reason}. Nothing is saved.") from None
        yield from self._keep_what_it_learnt()
        yield from self._propose(north, len(told))

    def _visit(self, place_deg: float) -> Generator[None, None, North | None]:
        """What the compass says there; None: the person leaves this place out."""
        assert self._scale.declination_deg is not None
        while True:
            if (yield from self._go(place_deg)):
                looks = yield from self._look()
                where = f"{looks[-1].azimuth_deg:.1f}°" if looks else "there"
                try:
                    north = find_north(looks, self._scale.declination_deg, self._scale.compass_offset_deg)
                except NorthRefused as reason:
                    self._say(f"  At {where}: {reason}.")
                else:
                    self._say(f"  At {where}: offset {north.offset_deg:+.1f}°.")
                    return north
            if not (yield from self._agrees("Try this place again? y, or n to leave it out:")):
                return None

    def _propose(self, north: North, places: int) -> Steps:
        offset_deg = round(north.offset_deg, 1) + 0.0
        away_deg = abs(turn_deg(self._scale.offset_deg, offset_deg))
        declination_deg = self._scale.declination_deg
        self._say(
            "",
            f"North: azimuth.offset_deg = {offset_deg:g}, give or take {north.uncertainty_deg:.1f}° ({places} places).",
            f"   In the file now: {self._scale.offset_deg:g}.",
            f"   Magnetic declination included: {declination_deg:+g}°."
            if declination_deg
            else "   From magnetic north: the box adds mount.declination_deg by itself, where there is any.",
        )
        if self._span_deg < FULL_TURN_DEG:
            self._say("   The rotor does not go all the way round, so what steel bends averages out in part only.")
        if away_deg <= north.uncertainty_deg:
            self._say("   They differ by less than a compass can tell: the one in the file may be the better one.")
        if (yield from self._agrees("Save it? y or n:")):
            self.result = Found(offset_deg, north.uncertainty_deg)
        else:
            self._say("Nothing is saved.")

    # --- the azimuth, by the compass

    def _place_by_compass(self) -> Steps:
        """The offset is known, so the compass tells where the azimuth stands."""
        scale = self._scale
        assert scale.declination_deg is not None
        self._say("", "Let the antenna stand.")
        looks = [replace(look, azimuth_deg=0.0) for look in (yield from self._look(anywhere=True))]
        try:
            north = find_north(looks, scale.declination_deg, scale.compass_offset_deg)
        except NorthRefused as reason:
            raise Refused(f"Refused: {reason}. Nothing is saved.") from None
        least_deg, most_deg = self._azimuth.min_deg - scale.shift_deg, self._azimuth.max_deg - scale.shift_deg
        # Near an end the compass cannot tell that end from the place a turn further.
        play_deg = BEYOND * north.uncertainty_deg
        first_deg = least_deg - play_deg
        first_deg += (north.offset_deg - scale.offset_deg - first_deg) % FULL_TURN_DEG
        angles = (first_deg + FULL_TURN_DEG * at for at in range(3))
        turns = [angle_deg for angle_deg in angles if angle_deg <= most_deg + play_deg]
        if not turns:
            raise Refused(
                f"Refused: by the compass it stands at {first_deg:.1f}° on the rotor's scale, outside of "
                f"{least_deg:g} to {most_deg:g}. Nothing is saved."
            )
        self._say(
            f"By the compass the azimuth stands at {' or '.join(f'{angle:.1f}°' for angle in turns)} on the rotor's "
            f"own scale, give or take {north.uncertainty_deg:.1f}°.",
            "   That must be within half a turn of the motor; its encoder tells the rest. Does your eye agree?",
        )
        angle_deg = turns[0]
        if len(turns) > 1:
            said_deg = yield from self._number("Which of them?", None)
            if said_deg is None:
                raise Refused("Left: nothing is changed.")
            angle_deg = min(turns, key=lambda turn: abs(turn - said_deg))
        if not (yield from self._agrees(f"Does it stand at {angle_deg:.1f}°? y or n:")):
            raise Refused("Left: nothing is changed.")
        yield from self._confirm(angle_deg)
        if self._azimuth.angle_deg is not None:
            self.result = Placed(angle_deg)
