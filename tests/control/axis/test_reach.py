"""How far a switched axis may pass before a command can end that: bounds that the simulated motor never leaves."""

from __future__ import annotations

import random

import pytest

from firmware_sim.parts.motor import MotorSpec, SimMotor
from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.motion import Motion
from rotator.control.axis.reach import (
    FASTER_THAN_FILE,
    RELAY_OPENS_S,
    START_S,
    UNSEEN_LAG_S,
    Bounds,
    Reach,
    bounds,
    lost,
)
from rotator.control.axis.readings import Reading, Window
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.control.sky.mount import Range
from rotator.control.sky.sectors import UNKNOWN
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Motor

MINUS, OFF, PLUS = Direction
STEP_S = 0.05
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
DESCRIBED = Motor(6.0, 1.2)


class Reached:
    """A real motor, its model, its readings and its relays."""

    def __init__(self, speed_dps: float = 6.0, lag_s: float = 0.2, *, counted: bool = False) -> None:
        self.motor = SimMotor(MotorSpec(speed_dps, lag_s, 0.015, 0.5, -500.0, 900.0), 200.0, 100.0)
        homing = HomingSettings(5.0 / 6.0, 75.0, 0.5, 0.0) if counted else None
        self._reach = Reach(
            SwitchedSettings(Axis.AZIMUTH, Range(0.0, 450.0), 4.0, DESCRIBED, Window(-1e9, 1e9), None, homing=homing)
        )
        self.motion = Motion({PLUS: DESCRIBED, MINUS: DESCRIBED})
        self.motion.coasted_s = {PLUS: 0.2, MINUS: 0.2}
        self._sensing = Sensing(Axis.AZIMUTH, Window(-1e9, 1e9), Calibration(((0.0, 0.0), (450.0, 450.0))))
        self.relay_state = RelayState()
        self.now_s = 100.0
        self.look(1.0)

    def look(self, seconds: float) -> None:
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            self.motor.advance(self.now_s)
            self._sensing.take(Reading(self.now_s, self.motor.shaft_deg), self.now_s)
            self.motion.see(self.now_s, self.motor.shaft_deg)

    def relays(self, way: Direction) -> None:
        self.motor.coils(plus=way is PLUS, minus=way is MINUS, now_s=self.now_s)
        self.motion.note_drive(self.now_s, way, self.motion.rest_deg(self.now_s))
        self.relay_state = self.relay_state.changed(self.now_s, way)

    def swept(self, way: Direction | None = None, for_s: float = 0.25, later_s: float = 0.0) -> Range:
        run = None if way is None else Run(way, self.now_s + later_s + for_s)
        return self._reach.swept(self.now_s + later_s, self._sensing, self.motion, self.relay_state, run)

    @property
    def stopping_room_deg(self) -> float:
        return self._reach.stopping_room_deg(self.motion)

    def would_rest_deg(self, way: Direction, for_s: float) -> float:
        """Where the real motor rests after it was on for so long more."""
        self.motor.coils(plus=way is PLUS, minus=way is MINUS, now_s=self.now_s)
        self.motor.advance(self.now_s + for_s)
        self.motor.coils(plus=False, minus=False, now_s=self.now_s + for_s)
        self.motor.advance(self.now_s + for_s + 20.0)
        return self.motor.shaft_deg


def test_a_motor_is_bounded_by_what_the_file_says_and_by_what_it_has_shown() -> None:
    assert bounds(Motor(6.0, 1.5), Motor(6.0, 1.5), 0.0) == Bounds(9.0, 0.25)
    assert bounds(Motor(6.0, 1.5), Motor(10.0, 5.0), 0.0) == Bounds(12.0, 0.5)
    assert bounds(Motor(6.0, 3.0), Motor(2.0, 0.1), 0.0) == Bounds(9.0, 0.5)
    assert Bounds(9.0, 0.2).coast_deg == pytest.approx(9.0 * 0.23)
    assert Bounds(9.0, 0.2).stopping_room_deg == pytest.approx(9.0 * 0.38)


@pytest.mark.parametrize("share", [0.3, 1.0, FASTER_THAN_FILE])
@pytest.mark.parametrize("seed", range(6))
def test_from_any_begin_to_any_end_of_a_run_the_real_motor_rests_within_its_bounds(seed: int, share: float) -> None:
    """The motor is up to half as fast again as the file says, and reversed and tapped at random."""
    draw = random.Random(seed)
    reached = Reached(6.0 * share)
    for _ in range(12):
        reached.relays(draw.choice((PLUS, MINUS)))
        reached.look(draw.choice((0.1, 0.3, 1.0, 3.0)))
        if draw.random() < 0.5:
            reached.relays(OFF)
            reached.look(draw.choice((0.05, 0.2, 1.0)))
    way, for_s = draw.choice((PLUS, MINUS, OFF)), draw.uniform(0.05, 0.4)
    swept = reached.swept(way, for_s)
    assert swept.holds(reached.motor.shaft_deg)
    assert swept.holds(reached.would_rest_deg(way, for_s))


def test_at_rest_it_stays_where_it_is() -> None:
    swept = Reached().swept()
    assert (swept.min_deg, swept.max_deg) == (pytest.approx(200.0), pytest.approx(200.0))
    assert Reached().swept(OFF) == swept


@BOTH_WAYS
def test_from_rest_it_may_go_as_far_as_the_run_lasts_and_coast(way: Direction) -> None:
    swept = Reached().swept(way, for_s=0.25)
    far_deg = 9.0 * 0.25 + 9.0 * (0.2 + RELAY_OPENS_S)
    assert (swept.max_deg - 200.0, 200.0 - swept.min_deg)[::way] == pytest.approx((far_deg, 0.0))


@BOTH_WAYS
def test_a_run_that_goes_on_has_its_coast_once(way: Direction) -> None:
    reached = Reached()
    reached.relays(way)
    reached.look(2.0)
    at_deg = reached.motor.shaft_deg
    ahead_deg = [
        (swept.max_deg - at_deg, at_deg - swept.min_deg)[::way][0]
        for swept in (reached.swept(), reached.swept(way, for_s=0.25))
    ]
    assert ahead_deg == pytest.approx([9.0 * 0.23, 9.0 * 0.23 + 9.0 * 0.25], abs=0.05)


@BOTH_WAYS
def test_after_a_run_its_coast_dies_away(way: Direction) -> None:
    reached = Reached()
    reached.relays(way)
    reached.look(2.0)
    reached.relays(OFF)
    widths_deg = []
    for _ in range(60):
        reached.look(STEP_S)
        swept = reached.swept()
        widths_deg.append(swept.max_deg - swept.min_deg)
    assert widths_deg[0] > 1.5
    assert widths_deg[-1] < 0.05


@BOTH_WAYS
def test_an_old_reading_of_a_motor_that_runs_is_as_far_behind_as_it_is_old(way: Direction) -> None:
    reached = Reached()
    reached.relays(way)
    reached.look(2.0)
    spans = [reached.swept(later_s=later_s) for later_s in (0.0, 0.2)]
    ends_deg = [(span.max_deg, -span.min_deg)[::way][0] for span in spans]
    assert ends_deg[1] - ends_deg[0] == pytest.approx((6.0 + 9.0) * 0.2, abs=0.1), "its model has gone on as well"


def test_without_a_reading_for_0_3_s_it_may_be_anywhere() -> None:
    assert Reached().swept(later_s=0.25) != UNKNOWN
    assert Reached().swept(later_s=0.35) == UNKNOWN


def test_a_count_may_be_off_by_a_pulse() -> None:
    swept = Reached(counted=True).swept()
    assert (swept.min_deg, swept.max_deg) == (pytest.approx(195.0), pytest.approx(205.0))
    assert Reached(counted=True).stopping_room_deg - Reached().stopping_room_deg == pytest.approx(5.0)


@BOTH_WAYS
def test_a_coast_that_was_never_seen_may_be_as_long_as_the_box_bears(way: Direction) -> None:
    reached = Reached()
    del reached.motion.coasted_s[way]
    assert reached.stopping_room_deg == pytest.approx(9.0 * (START_S + UNSEEN_LAG_S + RELAY_OPENS_S))
    reached.motion.coasted_s[way] = 0.4
    assert reached.stopping_room_deg == pytest.approx(9.0 * (START_S + 0.4 + RELAY_OPENS_S))


def test_its_room_is_that_of_its_faster_direction() -> None:
    reached = Reached()
    assert reached.stopping_room_deg == pytest.approx(9.0 * (START_S + 0.2 + RELAY_OPENS_S))
    reached.motion.motors[MINUS] = Motor(10.0, 2.0)
    assert reached.stopping_room_deg == pytest.approx(12.0 * (START_S + 0.2 + RELAY_OPENS_S))


@pytest.mark.parametrize(
    ("kind", "is_lost"),
    [
        (FaultKind.LIMIT_SWITCH, False),
        (FaultKind.RELAY_WELDED, False),
        (FaultKind.TURNS_BY_ITSELF, False),
        (FaultKind.CONTROL_LATE, False),
        (FaultKind.POT_OPEN, True),
        (FaultKind.STANDS_STILL, True),
        (FaultKind.WRONG_WAY, True),
        (FaultKind.COUNT_LOST, True),
    ],
)
def test_which_faults_leave_the_angle_in_doubt(kind: FaultKind, is_lost: bool) -> None:
    assert lost(Fault(kind, Axis.AZIMUTH, "")) is is_lost
    assert not lost(None)
