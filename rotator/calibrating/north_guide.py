"""Guides the operator to north with the compass on the boom: it learns its errors, then is read at several places.

Knows what to ask, where to turn the antenna, and what the compass's readings lead to. Pure: no clock, no terminal, no
chip, no file. The antenna moves by orders, and only after the operator has agreed. One path from top to bottom.
"""

from __future__ import annotations

from collections.abc import Generator

from rotator.calibrating.bearing import (
    LEAST_MAGNETOMETER,
    North,
    NorthUncertain,
    agree,
    find_north,
    possible_angles_deg,
)
from rotator.calibrating.compass_guide import KEYS, LEAST_PLACES, PAUSE_S, CompassGuide, CompassReady
from rotator.calibrating.entries import NUMBER_FORM, Number, Word
from rotator.calibrating.facts import NorthFacts
from rotator.calibrating.guide import LEFT, NOTHING_SAVED, Abandoned, Steps, position_unknown, refused
from rotator.calibrating.results import AngleConfirmed, NorthFound
from rotator.control.sky.angles import FULL_TURN_DEG, turn_deg

RAISED_EVERY = 2
"""In a sweep the antenna is raised at every second place."""


class NorthGuide(CompassGuide):
    def __init__(self, facts: NorthFacts) -> None:
        super().__init__(facts)
        self.result: NorthFound | AngleConfirmed | None = None
        self.save_wanted = False
        """The antenna stands, and the rig must save the compass's corrections. The rig clears this afterwards."""
        self._saved = False

    def _path(self) -> Steps:
        self._say(
            "Finding north with the compass on the boom. The antenna turns only after you have agreed.",
            "  Be ready to cut its supply. Space or s stops it; q or Ctrl-C leaves, and nothing is saved.",
            f"  {KEYS}",
        )
        if self._facts.declination_deg is None:
            raise Abandoned(
                "Refused: a compass shows magnetic north, and the file does not say how far that is from true north "
                "here: write mount.declination_deg (east of true north; west is minus). Nothing is saved."
            )
        yield from self._await_devices()
        angle_wanted = yield from self._find_position()
        yield from self._learn(may_sweep=not angle_wanted)
        yield from self._save_corrections()
        if angle_wanted:
            yield from self._angle_by_compass()
        else:
            yield from self._find()

    def _await_devices(self) -> Steps:
        """Give the compass and the azimuth time to answer."""
        yield
        while self._compass is None or self._compass.problem:
            yield
        yield from self._await_axis()

    def _find_position(self) -> Generator[None, None, bool]:
        """Returns whether the compass is to give the azimuth's angle instead of north. Raises Abandoned."""
        if position_unknown(self._axis):
            self._say(
                "",
                "The azimuth does not know where it stands. Which is known: the offset or the angle?",
                f"   y: azimuth.offset_deg = {self._facts.offset_deg:g} is right; the compass then gives the angle.",
                "   Or type the angle on the rotor's own scale as your eye sees it; the compass then gives the offset.",
            )
            while position_unknown(self._axis):
                accepts = f"y: the offset is right; n leaves. Else the angle: {NUMBER_FORM}"
                match (yield from self._ask("y, or the angle:", accepts, may_turn=False)):
                    case Word.YES:
                        return True
                    case Number(angle_deg):
                        if self._is_angle(angle_deg):
                            yield from self._confirm(angle_deg)
                    case Word.NO:
                        raise Abandoned(LEFT)
                    case _:
                        self._say(self._accepts)
        axis = self._axis
        if axis.fault is not None:
            raise refused(axis.fault)
        if axis.uncalibrated or axis.angle_deg is None:
            missing = axis.uncalibrated or "an angle"
            raise refused(f"the azimuth has to be set up first, it lacks {missing}")
        return False

    # --- the compass learns

    def _learn(self, *, may_sweep: bool) -> Steps:
        """A compass finds its own errors while it is turned about."""
        self._say("", f"The compass's calibration: {self._calibration}.")
        if self._calibration.magnetometer == 3:
            return
        self._say(
            "   It learns its errors by being turned: slowly, all the way round, and up and down.",
            "   When the magnetometer says 3, it goes on; 2 will do, then press Enter.",
        )
        offer = "y: the box turns it through its range, raised and level by turns; " if may_sweep else ""
        by_hand = "r l u d: you do; " if may_sweep else "turn it by hand; "
        self._learning = True
        while self._calibration.magnetometer < 3:
            accepts = "Turn it about; Enter when the magnetometer says 2 or 3; q leaves."
            match (yield from self._ask(f"{offer}{by_hand}Enter goes on.", accepts)):
                case CompassReady():
                    break
                case Word.YES if may_sweep:
                    yield from self._sweep()
                case Word.ENTER if self._calibration.magnetometer >= LEAST_MAGNETOMETER:
                    break
                case Word.ENTER:
                    self._say(f"   Not yet: {self._calibration}.")
                case _:
                    self._say(self._accepts)
        self._learning = False

    def _sweep(self) -> Steps:
        """Through the range and back in steps, alternately level and raised."""
        places = self._places()
        for number, place_deg in enumerate([*places, *reversed(places)]):
            raised = number % RAISED_EVERY == 1
            if self._calibration.magnetometer == 3 or not (yield from self._go(place_deg, PAUSE_S, raised=raised)):
                return

    def _save_corrections(self) -> Steps:
        if self._saved or not self._facts.has_file:
            return
        if not self._calibration.complete:
            self._say(
                "   Not kept: only what is 3 in every part is worth keeping, so after its next power-on the compass "
                "learns anew."
            )
            return
        self.prompt = "Asking the compass for what it has learnt."
        self.save_wanted = self._saved = True
        while self.save_wanted:
            yield

    # --- north

    def _find(self) -> Steps:
        places = self._places()
        shown = ", ".join(f"{place_deg - self._facts.shift_deg:.0f}" for place_deg in places)
        self._say(
            "",
            f"It goes to {len(places)} places and stands at each for some seconds: {shown}° on the rotor's scale.",
            "   Watch the antenna and its cables.",
        )
        if not (yield from self._agrees("Begin?")):
            raise Abandoned(LEFT)
        found: list[North] = []
        for place_deg in places:
            north = yield from self._visit(place_deg)
            if north is not None:
                found.append(north)
        if len(found) < LEAST_PLACES:
            raise refused(f"{len(found)} places are too few, {LEAST_PLACES} are needed")
        try:
            north = agree(found)
        except NorthUncertain as reason:
            raise refused(reason) from None
        yield from self._save_corrections()
        yield from self._propose(north, len(found))

    def _visit(self, place_deg: float) -> Generator[None, None, North | None]:
        """North by the compass at this place. None: the operator leaves this place out."""
        assert self._facts.declination_deg is not None
        while True:
            if (yield from self._go(place_deg)):
                samples = yield from self._sample()
                where = f"{samples[-1].azimuth_deg:.1f}°" if samples else "this place"
                try:
                    north = find_north(samples, self._facts.declination_deg, self._facts.compass_offset_deg)
                except NorthUncertain as reason:
                    self._say(f"  At {where}: {reason}.")
                else:
                    self._say(f"  At {where}: offset {north.offset_deg:+.1f}°.")
                    return north
            again = "Try this place again?"
            if not (yield from self._agrees(again, prompt=f"{again} y, or n to leave it out:")):
                return None

    def _propose(self, north: North, places: int) -> Steps:
        offset_deg = round(north.offset_deg, 1) + 0.0
        away_deg = abs(turn_deg(self._facts.offset_deg, offset_deg))
        declination_deg = self._facts.declination_deg
        self._say(
            "",
            f"North: azimuth.offset_deg = {offset_deg:g}, give or take {north.uncertainty_deg:.1f}° ({places} places).",
            f"   In the file now: {self._facts.offset_deg:g}.",
            f"   Magnetic declination included: {declination_deg:+g}°."
            if declination_deg
            else "   From magnetic north: the box adds mount.declination_deg by itself, where there is any.",
        )
        if self._span_deg < FULL_TURN_DEG:
            self._say(
                "   The rotor does not turn all the way round, so the error from steel averages out in part only."
            )
        if away_deg <= north.uncertainty_deg:
            self._say("   They differ by less than a compass can show: the one in the file may be the better one.")
        if (yield from self._agrees("Save it?")):
            self.result = NorthFound(offset_deg, north.uncertainty_deg)
        else:
            self._say(NOTHING_SAVED)

    # --- the azimuth's angle by the compass

    def _angle_by_compass(self) -> Steps:
        """The offset is known, so the compass gives the azimuth's angle."""
        facts = self._facts
        assert facts.declination_deg is not None
        self._say("", "Let the antenna stand.")
        samples = yield from self._sample(angle_unknown=True)
        try:
            bearing = find_north(samples, facts.declination_deg, facts.compass_offset_deg)
        except NorthUncertain as reason:
            raise refused(reason) from None
        least_deg, most_deg = self._axis.min_deg - facts.shift_deg, self._axis.max_deg - facts.shift_deg
        first_deg, angles = possible_angles_deg(bearing, facts.offset_deg, least_deg, most_deg)
        if not angles:
            raise refused(
                f"by the compass it stands at {first_deg:.1f}° on the rotor's scale, outside of "
                f"{least_deg:g} to {most_deg:g}"
            )
        self._say(
            f"By the compass the azimuth stands at {' or '.join(f'{angle:.1f}°' for angle in angles)} on the rotor's "
            f"own scale, give or take {bearing.uncertainty_deg:.1f}°.",
            "   That must be within half a turn of the motor; its encoder gives the rest. Does your eye agree?",
        )
        angle_deg = angles[0]
        if len(angles) > 1:
            chosen_deg = yield from self._number("Which of them?", None)
            if chosen_deg is None:
                raise Abandoned("Left: nothing is changed.")
            angle_deg = min(angles, key=lambda angle: abs(angle - chosen_deg))
        if not (yield from self._agrees(f"Does it stand at {angle_deg:.1f}°?")):
            raise Abandoned("Left: nothing is changed.")
        yield from self._confirm(angle_deg)
        if self._axis.angle_deg is not None:
            self.result = AngleConfirmed(angle_deg)
