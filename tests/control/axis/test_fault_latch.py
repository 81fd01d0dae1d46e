"""Which fault an axis keeps: the first one, unless a later one asks for the supply to be cut; and who may end it."""

from __future__ import annotations

from hw.ports import Axis
from rotator.control.axis.fault_latch import FaultLatch
from rotator.faults import Fault, FaultKind

STANDS = Fault(FaultKind.STANDS_STILL, Axis.AZIMUTH, "0.0° in 1 s")
JUMPS = Fault(FaultKind.POT_JUMPS, Axis.AZIMUTH, "3 jumps")
WELDED = Fault(FaultKind.RELAY_WELDED, Axis.AZIMUTH, "still turning", cut=True)
ALSO_WELDED = Fault(FaultKind.TURNS_BY_ITSELF, Axis.AZIMUTH, "it turns", cut=True)
SILENT = Fault(FaultKind.CONTROLLER_SILENT, Axis.AZIMUTH, "no answer", passing=True)


def test_nothing_wrong_is_no_fault() -> None:
    latch = FaultLatch()
    assert not latch.note(None, 0.0, cause=None, tries=0)
    assert not latch.fail(None, 0.0, tries=0)
    assert latch.fault is None


def test_the_first_fault_stays_when_its_cause_is_gone() -> None:
    latch = FaultLatch()
    assert latch.note(STANDS, 0.0, cause=None, tries=1), "new"
    assert not latch.note(STANDS, 0.0, cause=None, tries=1), "known"
    assert not latch.note(JUMPS, 0.0, cause=JUMPS, tries=1)
    assert not latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is STANDS


def test_a_fault_that_needs_the_supply_cut_replaces_another() -> None:
    latch = FaultLatch()
    latch.fail(STANDS, 0.0, tries=1)
    assert latch.fail(WELDED, 0.0, tries=1)
    assert latch.fault is WELDED
    assert not latch.fail(ALSO_WELDED, 0.0, tries=1), "the first of these stays"
    assert not latch.fail(STANDS, 0.0, tries=1)
    assert latch.fault is WELDED


def test_acknowledged_it_ends_unless_its_cause_is_still_there() -> None:
    latch = FaultLatch()
    latch.note(JUMPS, 0.0, cause=JUMPS, tries=1)
    latch.acknowledge(1.0, by_person=False)
    assert latch.fault is JUMPS
    latch.note(None, 0.0, cause=None, tries=0)
    latch.acknowledge(1.0, by_person=False)
    assert latch.fault is None


def test_acknowledged_before_anything_was_seen_there_is_no_fault() -> None:
    latch = FaultLatch()
    latch.fail(STANDS, 0.0, tries=1)
    latch.acknowledge(1.0, by_person=False)
    assert latch.fault is None


def test_what_is_there_now_takes_the_place_of_what_is_acknowledged() -> None:
    latch = FaultLatch()
    latch.note(STANDS, 0.0, cause=None, tries=1)
    latch.note(JUMPS, 0.0, cause=JUMPS, tries=1)
    assert latch.fault is STANDS
    latch.acknowledge(1.0, by_person=False)
    assert latch.fault is JUMPS


def test_a_passing_fault_ends_with_its_cause() -> None:
    latch = FaultLatch()
    assert latch.note(SILENT, 0.0, cause=SILENT, tries=1)
    assert not latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is None
    latch.note(SILENT, 0.0, cause=SILENT, tries=1)
    latch.note(STANDS, 0.0, cause=None, tries=1)
    assert latch.fault is STANDS, "another one takes its place"
    latch.note(None, 0.0, cause=None, tries=0)
    assert latch.fault is STANDS


def test_a_program_may_acknowledge_two_tries_in_ten_minutes_and_not_the_third() -> None:
    latch = FaultLatch()
    for at_s in (0.0, 100.0):
        latch.note(STANDS, at_s, cause=None, tries=1)
        assert latch.acknowledge(at_s, by_person=False)
    latch.note(STANDS, 200.0, cause=None, tries=1)
    assert not latch.acknowledge(599.9, by_person=False)
    assert latch.fault is not None
    assert "tried 3 times in 10 minutes" in latch.fault.measured
    assert latch.acknowledge(600.0, by_person=False)


def test_a_person_acknowledges_at_any_time_and_the_tries_count_anew() -> None:
    latch = FaultLatch()
    latch.note(STANDS, 0.0, cause=None, tries=3)
    assert latch.acknowledge(1.0, by_person=True)
    latch.note(STANDS, 2.0, cause=None, tries=2)
    assert latch.acknowledge(3.0, by_person=False)


def test_a_fault_that_passes_by_itself_is_no_try() -> None:
    latch = FaultLatch()
    for at_s in range(10):
        latch.note(SILENT, at_s, cause=SILENT, tries=1)
        latch.note(None, at_s, cause=None, tries=1)
    assert not latch.needs_person(10.0)
