"""Whether the relay of an axis that counts has been seen to open: contact and relays by hand, at 20 Hz."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.axis.run_watch import RunWatch
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import ALL_OPEN, Motor, Trust
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
PERIOD_S, COAST_S = 5.0 / 6.0, 0.5
EITHER_WAY = frozenset((PLUS, MINUS))
CLOSED_S, OPEN_S = 1.0 / 6.0, 4.0 / 6.0
"""How long the contact is closed, and open, at 6°/s."""


class Shaft:
    """A watched axis, whose contact changes when the test says so."""

    def __init__(self, *, look: bool = False, master: bool = False) -> None:
        motor = Motor(6.0, 0.6)
        motors, limits = {PLUS: motor, MINUS: motor}, Range(0.0, 360.0)
        self.watch = RunWatch(
            Axis.AZIMUTH, limits, motors, PERIOD_S, COAST_S, master=master, trusts=ALL_OPEN, look=look
        )
        self.faults: list[Fault] = []
        self.switch = Switch(self.watch.note_relays)
        self.now_s = 100.0
        self._changes = 0
        self.supplied = True
        self.ahead = EITHER_WAY
        self.angle_deg = 100.0
        self.lost = ""

    def pass_by(self, seconds: float) -> None:
        end_s = self.now_s + seconds
        while self.now_s < end_s - 1e-9:
            self.now_s += 0.05
            if fault := self.watch.see(self.now_s, self.angle_deg, self._condition):
                self.faults.append(fault)

    @property
    def _condition(self) -> Condition:
        return Condition(changes=self._changes, ahead=self.ahead, supplied=self.supplied, lost=self.lost)

    def turn(self, changes: int) -> None:
        """So many changes of the contact, at full speed."""
        for count in range(changes):
            self.pass_by((CLOSED_S, OPEN_S)[count % 2])
            self._changes += 1
        self.pass_by(0.05)

    def jump(self, changes: int) -> None:
        """So many changes between two readings."""
        self._changes += changes
        self.pass_by(0.05)

    def turn_back(self, way: Direction) -> None:
        """One change, counted against that way."""
        self._changes += 1
        self.angle_deg -= 5.0 * way
        self.pass_by(0.05)

    def run(self, way: Direction, changes: int = 6) -> None:
        self.switch.to(self.now_s, way)
        self.turn(changes)
        self.switch.to(self.now_s, OFF)


def test_the_opposite_relay_waits_for_a_pause_longer_than_those_of_the_run() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.pass_by(COAST_S + PERIOD_S)
    assert shaft.watch.forbids(MINUS)
    assert not shaft.watch.forbids(PLUS)
    shaft.pass_by(0.5 * PERIOD_S + 0.2)
    assert not shaft.watch.forbids(MINUS)


def test_it_waits_for_ever_where_the_contact_goes_on_changing() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    for _ in range(20):
        shaft.turn(2)
        assert shaft.watch.forbids(MINUS)
    fault = shaft.watch.accuse(MINUS)
    assert fault is not None
    assert fault.name == "relay not seen to open"


def test_silence_shows_nothing_where_no_edge_comes_before_the_stop() -> None:
    shaft = Shaft()
    shaft.run(MINUS)
    shaft.ahead = frozenset((PLUS,))
    shaft.pass_by(60.0)
    assert shaft.watch.forbids(PLUS)
    assert shaft.watch.accuse(PLUS) is not None
    assert shaft.watch.accuse(MINUS) is None


def test_silence_without_a_supply_shows_nothing() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.supplied = False
    shaft.pass_by(60.0)
    assert shaft.watch.forbids(MINUS)
    shaft.supplied = True
    shaft.pass_by(0.8)
    assert shaft.watch.forbids(MINUS), "it has just come back: a welded relay would turn it soon"
    shaft.pass_by(2.2)
    assert not shaft.watch.forbids(MINUS)


def test_a_run_in_which_the_contact_never_changed_shows_nothing() -> None:
    shaft = Shaft()
    shaft.switch.to(shaft.now_s, PLUS)
    shaft.pass_by(4.0 * PERIOD_S)
    shaft.switch.to(shaft.now_s, OFF)
    shaft.pass_by(60.0)
    assert shaft.watch.accuse(MINUS) is not None
    shaft.run(PLUS)
    shaft.pass_by(3.0)
    assert shaft.watch.accuse(MINUS) is None, "a run of its own has shown it"


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_before_its_first_relay_the_contact_is_seen_to_be_silent(way: Direction) -> None:
    shaft = Shaft(look=True)
    shaft.pass_by(1.0)
    assert shaft.watch.forbids(way)
    shaft.pass_by(3.0)
    assert not shaft.watch.forbids(way)


# --- a doubt, and what ends it


def doubted(way: Direction = PLUS, *, master: bool = False) -> Shaft:
    """It ran into its stop and was held there: the relay of that run is in doubt."""
    shaft = Shaft(master=master)
    shaft.ahead = frozenset((Direction(-way),))
    shaft.run(way)
    shaft.pass_by(10.0)
    assert shaft.watch.accuse(Direction(-way)) is not None
    shaft.ahead = EITHER_WAY
    return shaft


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_standing_elsewhere_for_ever_ends_no_doubt_only_a_run_of_its_own_does(way: Direction) -> None:
    shaft = doubted(way)
    shaft.pass_by(60.0)
    assert shaft.watch.accuse(Direction(-way)) is not None
    shaft.run(way)
    assert shaft.watch.accuse(Direction(-way)) is not None, "not before it has been silent"
    shaft.pass_by(3.0)
    assert shaft.watch.trusts == (Trust.OPEN, Trust.OPEN)


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_a_tap_in_which_the_contact_did_not_change_ends_no_doubt(way: Direction) -> None:
    shaft = doubted(way)
    shaft.run(way, changes=0)
    shaft.pass_by(10.0)
    assert shaft.watch.accuse(Direction(-way)) is not None
    shaft.run(way, changes=1)
    shaft.pass_by(10.0)
    assert shaft.watch.accuse(Direction(-way)) is None


@pytest.mark.parametrize(("changes", "waits_s"), [(0, COAST_S + 0.2), (1, 3.5)])
def test_a_doubted_relay_whose_run_showed_nothing_is_given_up_after_its_coast(changes: int, waits_s: float) -> None:
    """Its contact sticks: a motor that still has current would turn on unseen until the supply is cut."""
    shaft = doubted(PLUS)
    shaft.run(PLUS, changes=changes)
    assert not shaft.watch.unsure
    shaft.pass_by(waits_s)
    assert shaft.watch.unsure is (changes == 0)


def test_a_doubted_relay_is_not_given_up_while_its_run_goes_on() -> None:
    shaft = doubted(PLUS)
    shaft.switch.to(shaft.now_s, PLUS)
    for _ in range(4):
        shaft.pass_by(0.5)
        assert not shaft.watch.unsure
    shaft.switch.to(shaft.now_s, OFF)
    shaft.pass_by(COAST_S + 0.2)
    assert shaft.watch.unsure


@pytest.mark.parametrize("changes", range(5))
@pytest.mark.parametrize("own_run", [True, False])
@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_two_changes_after_its_coast_are_enough_to_cut_a_doubted_relay_s_supply(
    way: Direction, changes: int, *, own_run: bool
) -> None:
    """It may be the last that its contact shows. Only a master can cut; without one the counter waits to be sure."""
    for master in (True, False):
        shaft = doubted(way, master=master)
        if own_run:
            shaft.run(way)
            shaft.pass_by(COAST_S + 0.2)
        shaft.turn(changes)
        assert [fault.cut for fault in shaft.faults[:1]] == [True] * (master and changes >= 2)
        assert all(fault.kind is FaultKind.TURNS_BY_ITSELF for fault in shaft.faults)


@pytest.mark.parametrize("changes", range(8))
def test_a_relay_that_was_not_in_doubt_is_left_to_the_counter(changes: int) -> None:
    """It knows whether the changes come as evenly as a motor makes them: wind may rock the antenna about an edge."""
    shaft = Shaft(master=True)
    shaft.run(PLUS)
    shaft.pass_by(COAST_S + 0.2)
    shaft.turn(changes)
    assert shaft.faults == []


def test_what_rocked_the_antenna_is_forgotten_once_its_contact_is_silent() -> None:
    shaft = doubted(master=True)
    for _ in range(3):
        shaft.turn(1)
        shaft.pass_by(5.0)
    assert shaft.faults == []


def test_a_run_the_other_way_says_nothing_of_the_relay_in_doubt() -> None:
    shaft = doubted(PLUS)
    shaft.run(MINUS)
    shaft.pass_by(10.0)
    assert shaft.watch.trusts == (Trust.DOUBTED, Trust.OPEN)


def test_taps_without_a_change_are_trusted_for_three_periods_in_all() -> None:
    shaft, trusts = Shaft(), []
    shaft.run(PLUS)
    for _ in range(12):
        shaft.pass_by(4.0)
        shaft.switch.to(shaft.now_s, PLUS)
        shaft.pass_by(0.3)
        shaft.switch.to(shaft.now_s, OFF)
        shaft.pass_by(4.0)
        trusts.append(shaft.watch.trusts[0])
    assert trusts[:7] == [Trust.OPEN] * 7
    assert trusts[-1] is Trust.DOUBTED


# --- the contact changes though no relay is closed


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_after_a_run_that_is_over_a_change_of_the_contact_accuses_its_relay(way: Direction) -> None:
    shaft = Shaft()
    shaft.run(way)
    shaft.pass_by(COAST_S)
    shaft.turn(4)
    assert shaft.watch.looks
    assert shaft.watch.accuse(Direction(-way)) is not None
    shaft.pass_by(60.0)
    assert not shaft.watch.looks
    assert shaft.watch.accuse(Direction(-way)) is not None, "silence alone does not end it"


def test_while_it_turns_by_itself_no_relay_closes_and_silence_ends_that() -> None:
    """A hand, or the wind: which way it turns the contact does not say."""
    shaft = Shaft()
    shaft.pass_by(5.0)
    shaft.turn(4)
    assert shaft.watch.looks
    assert shaft.watch.forbids(PLUS)
    assert shaft.watch.forbids(MINUS)
    shaft.pass_by(5.0)
    assert not shaft.watch.looks
    assert shaft.watch.trusts == (Trust.OPEN, Trust.OPEN)


def test_a_change_while_it_still_coasts_is_no_turning_by_itself() -> None:
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.turn(1)
    assert not shaft.watch.looks
    shaft.pass_by(4.0)
    assert shaft.watch.trusts == (Trust.OPEN, Trust.OPEN)


@pytest.mark.parametrize("lost", ["", "not homed"])
def test_one_late_change_is_a_coast_that_ended_just_beyond_an_edge_unless_the_count_is_lost(lost: str) -> None:
    """An axis may creep over its last edge a second after its relay opened."""
    shaft = Shaft()
    shaft.lost = lost
    shaft.run(PLUS)
    shaft.pass_by(COAST_S + 0.3)
    shaft.turn(1)
    assert shaft.watch.looks is bool(lost)
    assert shaft.watch.forbids(PLUS), "it may be the first change of a motor with current"
    shaft.pass_by(4.0)
    assert shaft.watch.trusts == ((Trust.DOUBTED if lost else Trust.OPEN), Trust.OPEN)


def test_changes_that_are_read_late_may_have_come_in_time() -> None:
    """The computer was busy for half a second, and the axis coasted over two edges then."""
    shaft = Shaft()
    shaft.run(PLUS)
    shaft.pass_by(0.5)
    shaft.now_s += 0.5
    shaft.jump(2)
    assert not shaft.watch.looks
    shaft.pass_by(4.0)
    assert shaft.watch.trusts == (Trust.OPEN, Trust.OPEN)


# --- where the stop may be


@pytest.mark.parametrize(("way", "near_deg"), [(PLUS, 357.0), (MINUS, 3.0)], ids=["plus", "minus"])
@pytest.mark.parametrize("near", [True, False])
def test_a_change_counted_back_after_a_run_may_have_been_one_ahead_so_no_stop_may_be_near(
    way: Direction, near_deg: float, near: bool
) -> None:
    """Two pulses are 10°: there the count is not sure that an edge lies ahead."""
    shaft = Shaft()
    shaft.angle_deg = near_deg if near else 180.0
    shaft.run(way)
    shaft.pass_by(0.2)
    shaft.turn_back(way)
    shaft.pass_by(5.0)
    assert shaft.watch.trusts[0 if way > 0 else 1] is (Trust.DOUBTED if near else Trust.OPEN)


def test_near_its_stop_with_an_edge_ahead_silence_shows_it_where_no_change_was_counted_back() -> None:
    shaft = Shaft()
    shaft.angle_deg = 352.0
    shaft.run(PLUS)
    shaft.pass_by(5.0)
    assert shaft.watch.trusts == (Trust.OPEN, Trust.OPEN)


@pytest.mark.parametrize(("held_s", "trust"), [(0.5, Trust.OPEN), (2.0, Trust.DOUBTED)])
def test_without_a_count_it_must_have_changed_as_lately_as_one_that_turns(held_s: float, trust: Trust) -> None:
    """It may have met its stop anywhere."""
    shaft = Shaft()
    shaft.lost = "power was cut"
    shaft.switch.to(shaft.now_s, PLUS)
    shaft.turn(6)
    shaft.pass_by(held_s)
    shaft.switch.to(shaft.now_s, OFF)
    shaft.pass_by(8.0)
    assert shaft.watch.trusts[0] is trust


# --- homing


def test_while_it_looks_for_its_stop_it_may_turn_back_there_and_afterwards_not() -> None:
    shaft = Shaft()
    shaft.ahead = frozenset((PLUS,))
    shaft.watch.homes(homing=True, failed=False)
    shaft.run(MINUS)
    shaft.watch.homes(homing=False, failed=False)
    shaft.pass_by(4.0)
    shaft.watch.homes(homing=False, failed=False)
    assert not shaft.watch.forbids(PLUS), "it was seen to stand there, and a person watches"
    shaft.watch.homes(homing=False, failed=False)
    shaft.run(MINUS)
    shaft.pass_by(4.0)
    assert shaft.watch.forbids(PLUS), "no person watches any more"


def test_homing_that_failed_leaves_the_relay_to_be_seen_like_any_other() -> None:
    shaft = Shaft()
    shaft.ahead = frozenset((PLUS,))
    shaft.watch.homes(homing=True, failed=False)
    shaft.run(MINUS)
    shaft.watch.homes(homing=False, failed=True)
    shaft.pass_by(8.0)
    assert shaft.watch.forbids(PLUS)
