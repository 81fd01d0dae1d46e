"""The judges of the drills, on a mast made by hand: the truth of two motors, and the orders to them. No box obeys."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.goals import Ranges
from benchmarks.drills.judges import Judges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Event
from benchmarks.drills.world import AxisTruth

STEP_S = 0.05


class Mast:
    """Two motors of 6°/s on relays, range 0° to 360°, stops 2° beyond; azimuth is moved by hand."""

    def __init__(
        self,
        *,
        master: bool = False,
        at_deg: float = 100.0,
        top_deg: float = 360.0,
        lacking: str = "",
        idle: bool = False,
    ) -> None:
        self.azimuth = AxisTruth("azimuth", 6.0, 0.5, -2.0, 362.0, shaft_deg=at_deg, relayed=True)
        self.elevation = AxisTruth("elevation", 6.0, 0.5, -2.0, 182.0, relayed=True)
        self.orders = Orders(
            (Ranges(0.0, top_deg, False), Ranges(0.0, 180.0, False)),
            (0.0, 0.0),
            lacking=lacking,
            parks_idle=idle,
        )
        self.case = AxisCase(0.0, 360.0, 4.0)
        self.judges = Judges((self.case, AxisCase(0.0, 180.0, 4.0)), self.orders, master=master)
        self.now_s = 0.0

    def order(self, who: str, what: str, *args: float | str) -> None:
        self.orders.note(Event(self.now_s, who, what, args))

    def run(self, seconds: float, *, coil: int = 0, power: int | None = None, dps: float | None = None) -> list[str]:
        """`coil`: what the box commands; `power`: what feeds the motor, `dps`: how it turns, where those differ."""
        truth = self.azimuth
        truth.coil, truth.power = coil, coil if power is None else power
        truth.speed_dps = 6.0 * truth.power if dps is None else dps
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            truth.shaft_deg = min(
                max(truth.shaft_deg + truth.speed_dps * STEP_S, truth.stop_low_deg), truth.stop_high_deg
            )
            self.orders.expire(self.now_s)
            self.judges.look(self.now_s, [truth, self.elevation])
        return [violation.judge for violation in self.judges.found]


@pytest.mark.parametrize("who", ["rotctld", "console"])
def test_driven_after_a_stop(who: str) -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(1.0, coil=1)
    mast.order(who, "stop")
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_driven_longer_than_the_last_lease() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.judges.unattended_s = mast.now_s
    assert mast.run(0.9, coil=1) == []
    assert mast.run(0.2, coil=1) == [accusations.AFTER_STOP]


def test_a_welded_relay_with_a_master_and_without() -> None:
    assert Mast(master=True).run(2.5, coil=0, power=1) == [accusations.AFTER_STOP]
    assert Mast(master=False).run(60.0, coil=0, power=1) == []


def test_a_right_move_is_no_violation() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(16.0, coil=1) == []
    mast.order("rotctld", "stop")
    assert mast.run(0.2, coil=1) == []
    assert mast.run(60.0) == []


def test_away_from_the_target() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(2.0, coil=-1)
    assert mast.run(2.5, coil=-1) == [accusations.AWAY]


def test_towards_the_other_turn_of_the_target_is_not_away() -> None:
    mast = Mast(top_deg=450.0)
    mast.order("rotctld", "aim", 20.0, 0.0)
    assert mast.run(10.0, coil=1) == []


def test_against_a_stop_once_for_two_seconds_in_all() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False  # the current in a motor that stands has a judge of its own
    mast.order("rotctld", "jog", "cw")
    assert mast.run(1.5, coil=1) == []
    mast.run(5.0)
    assert mast.run(1.5, coil=1) == [accusations.BEYOND]


def test_beyond_its_limits_before_the_stop() -> None:
    mast = Mast(at_deg=361.0)
    mast.azimuth.stop_high_deg = 400.0
    mast.order("rotctld", "jog", "cw")
    assert mast.run(4.0, coil=1) == [accusations.BEYOND]


def test_both_directions_fed() -> None:
    mast = Mast()
    mast.azimuth.shorted_s = 0.001
    assert mast.run(STEP_S) == [accusations.BOTH_FED]


def test_opposite_relays_that_meet_at_a_stop_are_excused_only_by_a_weld() -> None:
    for welded, found in ((True, []), (False, [accusations.BOTH_FED])):
        mast = Mast(at_deg=362.0, lacking="azimuth")
        mast.azimuth.welded, mast.azimuth.shorted_s = welded, 0.1
        assert mast.run(STEP_S) == found


def test_driven_before_any_order() -> None:
    assert Mast().run(0.6, coil=1) == [accusations.NO_ORDER]


def test_the_wind_turns_what_it_likes() -> None:
    assert Mast().run(60.0, dps=2.0) == []


def test_current_in_a_motor_that_stands() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(2.0, coil=1, dps=0.0) == []
    assert mast.run(0.3, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_four_tries_in_ten_minutes() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    for _ in range(3):
        assert mast.run(1.0, coil=1, dps=0.0) == []
        mast.run(60.0)
    assert mast.run(1.0, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_a_person_may_try_again() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    for _ in range(9):
        assert mast.run(1.0, coil=1, dps=0.0) == []
        mast.run(60.0)
        mast.order("console", "resume")
