"""Which fault an axis keeps: the first one, unless a later one asks for the supply to be cut."""

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
    assert not latch.note(None, cause=None)
    assert not latch.fail(None)
    assert latch.fault is None


def test_the_first_fault_stays_when_its_cause_is_gone() -> None:
    latch = FaultLatch()
    assert latch.note(STANDS, cause=None), "new"
    assert not latch.note(STANDS, cause=None), "known"
    assert not latch.note(JUMPS, cause=JUMPS)
    assert not latch.note(None, cause=None)
    assert latch.fault is STANDS


def test_a_fault_that_needs_the_supply_cut_replaces_another() -> None:
    latch = FaultLatch()
    latch.fail(STANDS)
    assert latch.fail(WELDED)
    assert latch.fault is WELDED
    assert not latch.fail(ALSO_WELDED), "the first of these stays"
    assert not latch.fail(STANDS)
    assert latch.fault is WELDED


def test_acknowledged_it_ends_unless_its_cause_is_still_there() -> None:
    latch = FaultLatch()
    latch.note(JUMPS, cause=JUMPS)
    latch.acknowledge()
    assert latch.fault is JUMPS
    latch.note(None, cause=None)
    latch.acknowledge()
    assert latch.fault is None


def test_what_is_there_now_takes_the_place_of_what_is_acknowledged() -> None:
    latch = FaultLatch()
    latch.note(STANDS, cause=None)
    latch.note(JUMPS, cause=JUMPS)
    assert latch.fault is STANDS
    latch.acknowledge()
    assert latch.fault is JUMPS


def test_a_passing_fault_ends_with_its_cause() -> None:
    latch = FaultLatch()
    assert latch.note(SILENT, cause=SILENT)
    assert not latch.note(None, cause=None)
    assert latch.fault is None
    latch.note(SILENT, cause=SILENT)
    latch.note(STANDS, cause=None)
    assert latch.fault is STANDS, "another one takes its place"
    latch.note(None, cause=None)
    assert latch.fault is STANDS
