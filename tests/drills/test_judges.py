"""Each judge sees its own wrong world, made by hand, and keeps quiet in the right one beside it."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.front_panel import STILL_S
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
            over_top=lambda: self.elevation.shaft_deg > 90.0,
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


def test_a_right_move_is_no_violation() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(16.0, coil=1) == []
    mast.order("rotctld", "stop")
    assert mast.run(0.2, coil=1) == []
    assert mast.run(60.0) == []


def test_both_directions_fed() -> None:
    mast = Mast()
    mast.azimuth.shorted_s = 0.001
    assert mast.run(STEP_S) == [accusations.BOTH_FED]


def test_against_a_stop_once_for_two_seconds_in_all() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False  # the current in a motor that stands has a judge of its own
    mast.order("rotctld", "jog", "cw")
    assert mast.run(1.5, coil=1) == []
    mast.run(5.0)
    assert mast.run(1.5, coil=1) == [accusations.BEYOND]


def test_a_contact_that_opens_a_moment_after_its_coil_does_not_end_the_sum_at_a_stop() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False
    mast.order("rotctld", "jog", "cw")
    mast.run(1.5, coil=1)
    mast.run(STEP_S, coil=0, power=1)
    mast.run(5.0)
    assert mast.run(1.5, coil=1) == [accusations.BEYOND]


def test_a_press_of_an_axis_that_was_never_set_up_turns_it_two_seconds_in_all_also_when_it_begins_late() -> None:
    mast = Mast(lacking="azimuth")
    mast.order("console", "jog", "cw", 5.0)
    mast.run(3.0)
    assert mast.run(2.3, coil=1) == []
    assert mast.run(0.5, coil=1) == [accusations.AFTER_STOP]


def test_the_panels_jog_switch_is_let_go() -> None:
    mast = Mast()
    mast.order("panel", "mode", "jog")
    mast.run(2.0)
    mast.order("panel", "jog", "cw", 1.0)
    assert mast.run(1.3, coil=1) == []
    assert mast.run(0.5, coil=1) == [accusations.AFTER_STOP]


def test_the_stop_button_stays_in_force_when_it_is_let_go() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.order("panel", "stop", "press")
    mast.run(1.0)
    mast.order("panel", "stop", "release")
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_a_turn_of_the_mode_switch_releases_a_stop() -> None:
    mast = Mast()
    mast.order("console", "stop")
    mast.order("panel", "mode", "manual")
    mast.run(2.0)
    mast.order("panel", "knob", "azimuth", 0.5)
    assert mast.run(2.0, coil=1) == []


def test_a_turn_of_the_mode_switch_while_the_stop_button_is_pressed_releases_nothing() -> None:
    mast = Mast()
    mast.order("panel", "stop", "press")
    mast.order("panel", "mode", "manual")
    mast.run(2.0)
    mast.order("panel", "stop", "release")
    mast.order("panel", "knob", "azimuth", 0.5)
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_a_new_mode_ends_the_orders_before_it_and_none_after_it() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.order("panel", "mode", "manual")
    mast.run(1.2, coil=1)
    mast.order("panel", "knob", "elevation", 0.5)
    assert mast.run(0.2) == []
    assert not mast.orders.holds("azimuth")
    assert mast.orders.holds("elevation")


def test_a_knob_turned_just_before_a_mode_counts_may_be_seen_in_that_mode() -> None:
    for before_s, found in ((0.1, []), (0.5, [accusations.AFTER_STOP])):
        mast = Mast()
        mast.order("panel", "mode", "manual")
        mast.run(STILL_S - before_s)
        mast.order("panel", "knob", "azimuth", 0.5)
        mast.run(0.6 + before_s)
        assert mast.run(1.0, coil=1) == found


def test_an_order_for_azimuth_may_turn_both_axes_round_a_sector() -> None:
    mast = Mast()
    mast.order("rotctld", "aim-azimuth", 200.0)
    assert not mast.orders.holds("elevation")
    mast.orders.goes_round = True
    mast.order("rotctld", "aim-azimuth", 200.0)
    assert mast.orders.holds("elevation")


def test_against_a_stop_again_after_a_person() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False
    mast.order("rotctld", "jog", "cw")
    mast.run(1.5, coil=1)
    mast.order("rotctld", "stop")
    mast.run(1.0)
    mast.order("rotctld", "jog", "cw")
    assert mast.run(1.5, coil=1) == []


@pytest.mark.parametrize("ends", ["stop", "program"])
def test_against_its_stop_again_and_again_though_no_person_has_let_it_go(ends: str) -> None:
    mast = Mast(at_deg=361.0)
    found: list[str] = []
    for _ in range(8):
        mast.order("rotctld", "jog", "cw")
        found += mast.run(1.0, coil=1)
        if ends == "stop":
            mast.order("gs232b", "stop")
        else:
            mast.orders.forget_all(mast.now_s)
        mast.run(1.0)
    assert accusations.BEYOND in found


def test_a_person_lets_it_go_against_its_stop_again() -> None:
    mast = Mast(at_deg=361.0)
    for _ in range(8):
        mast.order("rotctld", "jog", "cw")
        assert mast.run(1.0, coil=1) == []
        mast.order("console", "resume")
        assert mast.run(1.0) == []


def test_a_restart_of_the_program_is_no_new_beginning_of_tries() -> None:
    mast = Mast()
    found: list[str] = []
    for _ in range(4):
        mast.order("rotctld", "aim", 300.0, 0.0)
        found += mast.run(1.0, coil=1, dps=0.0)
        mast.orders.forget_all(mast.now_s)
        mast.run(5.0)
    assert found == [accusations.STANDING_CURRENT]


def test_beyond_its_limits_before_the_stop() -> None:
    mast = Mast(at_deg=361.0)
    mast.azimuth.stop_high_deg = 400.0
    mast.order("rotctld", "jog", "cw")
    assert mast.run(4.0, coil=1) == [accusations.BEYOND]


@pytest.mark.parametrize("who", ["rotctld", "console"])
def test_driven_after_a_stop(who: str) -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(1.0, coil=1)
    mast.order(who, "stop")
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_no_order_counts_while_a_person_holds_it() -> None:
    mast = Mast()
    mast.order("console", "stop")
    mast.order("rotctld", "aim", 200.0, 0.0)
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


def test_away_from_the_target() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(2.0, coil=-1)
    assert mast.run(2.5, coil=-1) == [accusations.AWAY]


def test_towards_the_other_turn_of_the_target_is_not_away() -> None:
    mast = Mast(top_deg=450.0)
    mast.order("rotctld", "aim", 20.0, 0.0)
    assert mast.run(10.0, coil=1) == []


@pytest.mark.parametrize(("wavered", "found"), [(0, [accusations.AWAY]), (1, [])])
def test_to_the_end_of_the_range_where_a_target_beyond_it_is_waited_for(wavered: int, found: list[str]) -> None:
    mast = Mast(at_deg=300.0)
    for azimuth_deg in (350.0, 20.0) * (1 + wavered):
        mast.order("rotctld", "aim", azimuth_deg, 0.0)
    assert mast.run(4.0, coil=1) == found


def test_another_target_is_not_waited_for() -> None:
    mast = Mast(at_deg=300.0)
    for azimuth_deg in (350.0, 20.0, 350.0, 200.0):
        mast.order("rotctld", "aim", azimuth_deg, 0.0)
    assert mast.run(4.0, coil=1) == [accusations.AWAY]


def test_driven_before_any_order() -> None:
    assert Mast().run(0.6, coil=1) == [accusations.NO_ORDER]


def test_the_wind_turns_what_it_likes() -> None:
    assert Mast().run(60.0, dps=2.0) == []


def test_current_in_a_motor_that_stands() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(2.0, coil=1, dps=0.0) == []
    assert mast.run(0.3, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_an_order_after_a_stop_is_another_try_though_the_current_never_ends() -> None:
    mast = Mast()
    for _ in range(3):
        mast.order("rotctld", "aim", 200.0, 0.0)
        assert mast.run(1.9, coil=1, dps=0.0) == []
        mast.order("rotctld", "stop")
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(0.6, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


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


def test_what_links_ordered_ends_when_no_stop_could_arrive_but_not_a_storm_park() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.orders.links_lost(mast.now_s)
    assert not mast.orders.holds("azimuth")
    mast.order("console", "storm")
    mast.orders.links_lost(mast.now_s)
    assert mast.orders.holds("azimuth")


def test_a_relay_that_welds_at_a_stop_in_a_calibration_is_left_to_the_person_who_watches() -> None:
    for at_deg, found in ((362.0, []), (300.0, [accusations.BOTH_FED])):
        mast = Mast(at_deg=at_deg, lacking="azimuth", master=True)
        mast.azimuth.welded, mast.azimuth.shorted_s = True, 0.001
        assert mast.run(STEP_S) == found


def test_presses_of_an_axis_that_was_never_set_up_count_each_for_itself() -> None:
    mast = Mast(lacking="azimuth")
    for _ in range(9):
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(1.9, coil=1, dps=0.0) == []
        mast.run(1.0)
    mast.order("console", "jog", "cw", 2.0)
    assert mast.run(2.3, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_a_person_who_sets_an_axis_up_may_press_it_into_its_stop_again_and_again() -> None:
    mast = Mast(at_deg=361.0, lacking="azimuth")
    mast.case.feels = False
    for _ in range(5):
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1) == []
        mast.run(1.0)


def test_limit_switches_show_the_ends_of_an_axis_that_was_never_set_up() -> None:
    mast = Mast(at_deg=361.0, lacking="azimuth")
    mast.case.feels, mast.case.shown_ends = False, (1,)
    mast.order("console", "jog", "cw", 2.0)
    mast.run(2.0, coil=1)
    mast.run(1.0)
    mast.order("console", "jog", "cw", 2.0)
    assert mast.run(1.0, coil=1) == [accusations.BEYOND]


def test_a_limit_switch_shows_nothing_of_an_axis_that_stands_elsewhere() -> None:
    """Its motor is stalled in mid-range, or it presses on the other stop: each press of a person counts for itself."""
    for at_deg, ends in ((200.0, (1, -1)), (361.0, (-1,))):
        mast = Mast(at_deg=at_deg, lacking="azimuth")
        mast.case.shown_ends = ends
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1, dps=0.0) == []
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1, dps=0.0) == []


def test_opposite_relays_that_meet_at_a_stop_are_excused_only_by_a_weld() -> None:
    for welded, found in ((True, []), (False, [accusations.BOTH_FED])):
        mast = Mast(at_deg=362.0, lacking="azimuth")
        mast.azimuth.welded, mast.azimuth.shorted_s = welded, 0.1
        assert mast.run(STEP_S) == found


def test_a_welded_motor_has_its_time_again_when_its_supply_comes_back() -> None:
    mast = Mast(master=True)
    for _ in range(3):
        assert mast.run(1.9, coil=0, power=1) == []
        mast.run(10.0)
    assert mast.run(2.5, coil=0, power=1) == [accusations.AFTER_STOP]


def test_one_coordinate_alone_moves_both_axes_only_over_the_top() -> None:
    for stands_deg, found in ((150.0, []), (60.0, [accusations.NO_ORDER])):
        mast = Mast()
        mast.elevation.shaft_deg = stands_deg
        mast.order("easycomm2", "aim-elevation", 26.0)
        assert mast.run(3.0, coil=1) == found


def test_a_target_that_wavers_across_the_end_is_waited_for_there_after_its_first_swing() -> None:
    for before_deg, found in (((), [accusations.AWAY]), ((346.0, 5.0), []), ((200.0, 5.0), [accusations.AWAY])):
        mast = Mast(at_deg=60.0)
        for azimuth_deg in (5.0, *before_deg, 346.0):
            mast.order("rotctld", "aim", azimuth_deg, 0.0)
        assert mast.run(4.0, coil=-1) == found


def test_an_idle_park_begins_after_any_order() -> None:
    mast = Mast(idle=True)
    mast.order("rotctld", "jog", "cw")
    mast.order("rotctld", "leave")
    assert mast.run(4.0, coil=-1) == []


@pytest.mark.parametrize(("before", "holds"), [("storm", True), ("home", True), ("aim", False)])
def test_a_person_who_gives_an_angle_ends_an_aim_but_neither_a_storm_park_nor_a_homing(
    before: str, holds: bool
) -> None:
    mast = Mast()
    match before:
        case "aim":
            mast.order("console", before, 200.0, 0.0)
        case "home":
            mast.order("console", before, "azimuth")
        case _:
            mast.order("console", before)
    mast.order("console", "confirm", "azimuth", 0.0)
    assert mast.orders.holds("azimuth") is holds


def test_a_target_that_moves_across_the_end_is_followed_to_that_end_and_one_that_jumps_is_not() -> None:
    for steps_deg, found in (([340.0, 345.0, 350.0, 355.0, 2.0], []), ([300.0, 20.0, 20.0], [accusations.AWAY])):
        mast = Mast(at_deg=200.0)
        for azimuth_deg in steps_deg:
            mast.order("rotctld", "aim", azimuth_deg, 0.0)
            assert mast.run(1.0, coil=1) == []
        assert mast.run(3.0, coil=1) == found


@pytest.mark.parametrize(("ran_on_s", "excused"), [(0.5, True), (1.0, False)])
def test_what_holds_a_welded_axis_within_its_coast_cannot_be_told_from_a_coast(ran_on_s: float, excused: bool) -> None:
    mast = Mast()
    mast.case.misplaced = True
    mast.azimuth.welded = True
    mast.order("gs232b", "aim", 300.0, 0.0)
    mast.run(2.0, coil=1)
    mast.order("gs232b", "stop")
    mast.run(ran_on_s, coil=0, power=1)
    mast.azimuth.stop_high_deg = mast.azimuth.shaft_deg
    mast.run(2.0, coil=0, power=1, dps=0.0)
    mast.order("gs232b", "aim", 10.0, 0.0)
    mast.run(STEP_S, coil=-1, power=1, dps=0.0)
    mast.azimuth.shorted_s = 0.02
    assert (accusations.BOTH_FED in mast.run(STEP_S, coil=-1, power=0)) is not excused
