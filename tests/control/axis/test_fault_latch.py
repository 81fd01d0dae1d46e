"""Which fault an axis keeps, and who may end it: after some tries in vain a link may not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import Axis
from rotator.control.axis.fault_latch import TRIES, FaultLatch
from rotator.exchange.faults import LATE, Fault, FaultKind

STANDS = Fault(FaultKind.STANDS_STILL, Axis.AZIMUTH, "0.0° in 1 s")
JUMPS = Fault(FaultKind.POT_JUMPS, Axis.AZIMUTH, "3 jumps")
WELDED = Fault(FaultKind.RELAY_WELDED, Axis.AZIMUTH, "still turning", cut=True)
ALSO_WELDED = Fault(FaultKind.TURNS_BY_ITSELF, Axis.AZIMUTH, "it turns", cut=True)
SILENT = Fault(FaultKind.CONTROLLER_SILENT, Axis.AZIMUTH, "no answer", passing=True)


def test_the_first_fault_stays_when_its_cause_is_gone() -> None:
    latch = FaultLatch()
    assert latch.note(STANDS, 0.0, cause=None, tries=0), "new"
    assert not latch.note(STANDS, 0.0, cause=None, tries=0), "known"
    assert not latch.note(JUMPS, 0.0, cause=JUMPS, tries=0)
    assert not latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is STANDS


def test_a_fault_that_needs_the_supply_cut_replaces_another() -> None:
    latch = FaultLatch()
    latch.fail(STANDS, 0.0, tries=0)
    assert latch.fail(WELDED, 0.0, tries=0)
    assert latch.fault is WELDED
    assert not latch.fail(ALSO_WELDED, 0.0, tries=0), "the first of these stays"
    assert not latch.fail(STANDS, 0.0, tries=0)
    assert latch.fault is WELDED


def test_acknowledged_it_ends_unless_its_cause_is_still_there() -> None:
    latch = FaultLatch()
    latch.note(JUMPS, 0.0, cause=JUMPS, tries=0)
    latch.acknowledge(0.0, by_person=False)
    assert latch.fault is JUMPS
    latch.note(None, 0.0, cause=None, tries=0)
    latch.acknowledge(0.0, by_person=False)
    assert latch.fault is None


def test_what_is_there_now_takes_the_place_of_what_is_acknowledged() -> None:
    latch = FaultLatch()
    latch.note(STANDS, 0.0, cause=None, tries=0)
    latch.note(JUMPS, 0.0, cause=JUMPS, tries=0)
    assert latch.fault is STANDS
    latch.acknowledge(0.0, by_person=False)
    assert latch.fault is JUMPS


def test_a_passing_fault_ends_with_its_cause() -> None:
    latch = FaultLatch()
    assert latch.note(SILENT, 0.0, cause=SILENT, tries=0)
    assert not latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is None
    latch.note(SILENT, 0.0, cause=SILENT, tries=0)
    latch.note(STANDS, 0.0, cause=None, tries=0)
    assert latch.fault is STANDS, "another one takes its place"
    latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is STANDS


# --- tried again and again


def tried(latch: FaultLatch, now_s: float, tries: int = 1) -> bool:
    """Once more in vain, and acknowledged by a link. Returns whether it counts."""
    latch.note(STANDS, now_s, cause=None, tries=tries)
    latch.note(None, now_s, cause=None, tries=0)
    return latch.acknowledge(now_s, by_person=False)


def test_a_link_acknowledges_two_tries_and_not_the_third() -> None:
    latch = FaultLatch()
    assert [tried(latch, 10.0 * count) for count in range(TRIES)] == [True, True, False]
    assert latch.fault is not None
    assert latch.fault.measured == (
        "0.0° in 1 s; tried 3 times in 10 minutes: within that time only `resume` acknowledges it"
    )


def test_the_first_of_them_may_be_ten_minutes_ago() -> None:
    latch = FaultLatch()
    tried(latch, 0.0)
    tried(latch, 300.0)
    assert tried(latch, 600.0)


def test_time_lets_a_link_acknowledge_it_again() -> None:
    latch = FaultLatch()
    for count in range(TRIES):
        tried(latch, 10.0 * count)
    assert not latch.acknowledge(599.9, by_person=False)
    assert latch.acknowledge(600.0, by_person=False)
    assert latch.fault is None


def test_a_person_acknowledges_it_and_the_tries_begin_anew() -> None:
    latch = FaultLatch()
    for count in range(TRIES):
        tried(latch, 10.0 * count)
    assert latch.acknowledge(40.0, by_person=True)
    assert latch.fault is None
    assert tried(latch, 50.0)


def test_short_runs_in_vain_count_each() -> None:
    assert not tried(FaultLatch(), 5.0, tries=TRIES)


def test_a_fault_that_struck_at_rest_is_no_try() -> None:
    latch = FaultLatch()
    assert all(tried(latch, 10.0 * count, tries=0) for count in range(2 * TRIES))


def test_what_passes_by_itself_is_no_try() -> None:
    latch = FaultLatch()
    for count in range(2 * TRIES):
        latch.note(SILENT, 10.0 * count, cause=SILENT, tries=1)
        latch.note(None, 10.0 * count + 1.0, cause=None, tries=0)
    assert tried(latch, 100.0)


def test_a_fault_names_the_sensor_of_its_axis_also_when_it_comes_back() -> None:
    latch = FaultLatch("encoder")
    jumps = Fault(FaultKind.POT_JUMPS, Axis.AZIMUTH, "by 40°")
    latch.note(jumps, 1.0, cause=jumps, tries=0)
    assert "azimuth: encoder jumps: by 40°" in str(latch.fault)
    latch.acknowledge(2.0, by_person=True)
    assert "azimuth: encoder jumps: by 40°" in str(latch.fault)


# --- tried by an earlier run of the program


def test_what_an_earlier_run_tried_counts_for_its_whole_time_anew() -> None:
    latch = FaultLatch(before=STANDS, tries=2)
    assert (latch.fault, latch.kind, latch.tries(5000.0)) == (None, STANDS.kind, 2)
    latch.note(None, 5000.0, cause=None, tries=0)
    assert (latch.tries(5599.9), latch.tries(5600.0)) == (2, 0)
    assert not tried(latch, 5599.9)


def test_tried_three_times_it_begins_with_its_fault_which_a_link_does_not_end() -> None:
    latch = FaultLatch("limit switches", before=STANDS, tries=TRIES)
    assert latch.fault is not None
    assert (latch.fault.kind, latch.fault.sensor) == (STANDS.kind, "limit switches")
    assert latch.fault.measured.startswith("before the program began again; tried 3 times")
    assert not latch.acknowledge(5000.0, by_person=False)
    assert not latch.acknowledge(5599.9, by_person=False)
    assert latch.acknowledge(5600.0, by_person=False)


def test_a_person_ends_what_an_earlier_run_left() -> None:
    latch = FaultLatch(before=STANDS, tries=TRIES)
    assert latch.acknowledge(5000.0, by_person=True)
    assert (latch.fault, latch.tries(5000.0)) == (None, 0)


def test_an_earlier_fault_without_tries_is_forgotten() -> None:
    latch = FaultLatch(before=STANDS)
    assert (latch.fault, latch.kind, latch.tries(0.0)) == (None, None, 0)


def test_the_next_run_knows_the_kind_of_the_latest_fault_that_stopped_the_motor() -> None:
    latch = FaultLatch()
    for fault, tries, kind in (
        (JUMPS, 0, None),
        (STANDS, 1, STANDS.kind),
        (SILENT, 1, STANDS.kind),
        (JUMPS, 1, JUMPS.kind),
    ):
        latch.note(fault, 10.0, cause=None, tries=tries)
        assert latch.kind is kind
        latch.note(None, 10.0, cause=None, tries=0)
        latch.acknowledge(10.0, by_person=True)


# --- a lateness passes by itself

LATENESS = [
    Fault(FaultKind.CONTROL_LATE, Axis.AZIMUTH, "nothing for 0.7 s", "0.55 s"),
    Fault(FaultKind.SENSOR_LATE, Axis.AZIMUTH, "0.4 s old", "0.2 s"),
]


def looks(
    latch: FaultLatch, from_s: float, seconds: float, *, found: Fault | None = None, in_order: bool = True
) -> None:
    for count in range(round(20 * seconds)):
        latch.note(found, from_s + 0.05 * count, cause=found, tries=0, in_order=in_order)


@pytest.mark.parametrize("late", LATENESS, ids=str)
def test_a_lateness_ends_when_all_was_seen_in_order_for_a_second(late: Fault) -> None:
    latch = FaultLatch()
    latch.fail(late, 10.0, tries=1)
    looks(latch, 10.0, 0.9)
    assert latch.fault == late
    looks(latch, 10.9, 0.3)
    assert latch.fault is None


@pytest.mark.parametrize("late", LATENESS, ids=str)
def test_it_stays_while_anything_is_wrong_or_suspected(late: Fault) -> None:
    latch = FaultLatch()
    latch.fail(late, 10.0, tries=1)
    looks(latch, 10.0, 60.0, in_order=False)
    looks(latch, 70.0, 60.0, found=JUMPS)
    assert latch.fault == late


def test_pauses_in_which_nothing_was_seen_do_not_end_it() -> None:
    latch = FaultLatch()
    latch.fail(LATENESS[0], 10.0, tries=1)
    for now_s in (11.0, 20.0, 40.0, 80.0):
        latch.note(None, now_s, cause=None, tries=0, in_order=True)
    assert latch.fault is LATENESS[0]


def test_each_further_lateness_takes_a_second_more_and_never_needs_a_person() -> None:
    latch = FaultLatch()
    now_s = 10.0
    for wait_s in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 10, 10):
        latch.fail(LATENESS[0], now_s, tries=1)
        looks(latch, now_s, wait_s - 0.2)
        assert latch.fault is not None
        looks(latch, now_s + wait_s - 0.2, 0.5)
        assert latch.fault is None
        now_s += wait_s + 1.0
    assert not latch.needs_person(now_s)


def test_one_that_hides_whether_the_motor_stopped_stays() -> None:
    latch = FaultLatch()
    unseen = replace(LATENESS[1], cut=True)
    latch.fail(unseen, 10.0, tries=1)
    looks(latch, 10.0, 60.0)
    assert latch.fault == unseen


@pytest.mark.parametrize("kind", [kind for kind in FaultKind if kind not in LATE], ids=str)
def test_no_other_fault_ends_by_itself(kind: FaultKind) -> None:
    latch = FaultLatch()
    fault = Fault(kind, Axis.AZIMUTH, "")
    latch.fail(fault, 10.0, tries=1)
    looks(latch, 10.0, 60.0)
    assert latch.fault == fault
