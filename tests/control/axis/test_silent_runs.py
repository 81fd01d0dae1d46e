"""A motor that runs, and whose contact does not change: in one run, in many short ones, and what makes them count anew.

The contact of this axis changes once a second at the motor's speed.
"""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.vain_runs import SILENT_PERIODS, TURNS_AFTER_S, SilentRuns
from rotator.exchange.faults import Fault, FaultKind

MINUS, OFF, PLUS = Direction
PERIOD_S, READ_S = 1.0, 0.05


class Contact:
    """Drives the motor for a time, and reads the contact twenty times a second."""

    def __init__(self) -> None:
        self.runs = SilentRuns(Axis.ELEVATION)
        self.now_s = 1000.0
        self.changes = 7
        self._relays = RelayState()
        self.see(0.1)

    def see(self, seconds: float) -> Fault | None:
        """The first fault of that while."""
        faults = []
        for _ in range(round(seconds / READ_S)):
            self.now_s += READ_S
            faults.append(self.runs.see(self.now_s, self.changes, PERIOD_S))
        return next((fault for fault in faults if fault is not None), None)

    def run(self, way: Direction, seconds: float) -> Fault | None:
        self._relays = self._relays.changed(self.now_s, way)
        self.runs.note_relays(self._relays)
        return self.see(seconds)


@pytest.fixture
def contact() -> Contact:
    return Contact()


@pytest.mark.parametrize(("seconds", "found"), [(3.1, False), (3.3, True)])
def test_three_periods_of_running_without_a_change_are_a_fault(contact: Contact, seconds: float, found: bool) -> None:
    """The motor needs 0.15 s before it turns at its speed."""
    assert (SILENT_PERIODS, TURNS_AFTER_S) == (3.0, 0.15)
    fault = contact.run(PLUS, seconds)
    assert (fault is not None) is found
    if fault is not None:
        assert (fault.kind, fault.axis) == (FaultKind.NO_PULSES, Axis.ELEVATION)
        assert fault.measured == "its motor ran up for 3.0 s in all, and the contact did not change"


def test_at_rest_no_change_is_needed(contact: Contact) -> None:
    assert contact.see(60.0) is None
    assert contact.run(PLUS, 2.0) is None
    assert contact.run(OFF, 60.0) is None


def test_short_runs_one_way_count_together_and_rests_between_them_do_not(contact: Contact) -> None:
    """Each of them counts 1 s, for 0.15 s of it the motor was starting."""
    for _ in range(3):
        assert contact.run(PLUS, 1.15) is None
        assert contact.run(OFF, 5.0) is None
    assert contact.run(PLUS, 0.1) is None
    assert contact.see(0.2) is not None


def test_presses_that_are_too_short_to_start_the_motor_never_count(contact: Contact) -> None:
    for _ in range(100):
        assert contact.run(PLUS, 0.15) is None
        assert contact.run(OFF, 0.5) is None


def test_a_change_of_the_contact_counts_anew_also_in_the_middle_of_a_run(contact: Contact) -> None:
    assert contact.run(PLUS, 2.9) is None
    contact.changes += 1
    assert contact.see(3.0) is None
    assert contact.see(0.15) is not None
    turning = Contact()
    turning.run(PLUS, 0.0)
    for _ in range(60):
        turning.changes += 1
        assert turning.see(PERIOD_S) is None


def test_a_run_the_other_way_counts_anew(contact: Contact) -> None:
    for way in (PLUS, MINUS, PLUS, MINUS):
        assert contact.run(way, 2.9) is None
        assert contact.run(OFF, 1.0) is None
    assert contact.run(MINUS, 0.5) is not None, "the same way again"


def test_a_reversal_without_a_rest_counts_anew_too(contact: Contact) -> None:
    assert contact.run(PLUS, 2.9) is None
    assert contact.run(MINUS, 3.1) is None
    assert contact.see(0.2) is not None


def test_while_a_person_watches_it_at_its_stop_earlier_runs_do_not_count(contact: Contact) -> None:
    assert contact.run(PLUS, 2.9) is None
    assert contact.run(OFF, 1.0) is None
    contact.runs.forget()
    assert contact.run(PLUS, 3.1) is None


def test_after_the_fault_it_counts_anew(contact: Contact) -> None:
    assert contact.run(PLUS, 3.2) is not None
    assert contact.see(2.9) is None
    assert contact.see(0.3) is not None
