"""What a motor was tried for in vain: how often, where it stood, and who may have it tried again."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.attempts import Attempts
from rotator.control.axis.readings import NORMAL, Window
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import NO_TRIES, Motor, Tries
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
LIMITS = Range(0.0, 450.0)
END = Fault(FaultKind.END_STOP, Axis.AZIMUTH, "stands at 448.0°")
STANDS = Fault(FaultKind.STANDS_STILL, Axis.AZIMUTH, "0.00°/s")
WRONG = Fault(FaultKind.WRONG_WAY, Axis.AZIMUTH, "-6.0°/s")
JUMPS = Fault(FaultKind.POT_JUMPS, Axis.AZIMUTH, "3 jumps")


def gate(before: Tries = NO_TRIES) -> RelayGate:
    motor = Motor(6.0, 1.0)
    settings = SwitchedSettings(
        Axis.AZIMUTH, LIMITS, 4.0, motor, Window(0.02, 0.98), None, (), tries=before, look=False
    )
    return RelayGate(settings, dict.fromkeys((PLUS, MINUS), motor), lease_s=0.25, placed=True)


class Tried:
    """An axis that stands at the angle that a test sets, with 20 readings a second."""

    def __init__(self, at_deg: float = 448.0, before: Tries = NO_TRIES) -> None:
        self._gate = gate(before)
        self.attempts = Attempts(Axis.AZIMUTH, LIMITS, self._gate, before=before)
        self._switch = Switch(self._note_relays)
        self.at_deg, self.now_s = at_deg, 100.0
        self.look(1.0)

    def _note_relays(self, relays: RelayState) -> None:
        self._gate.note_relays(relays)
        self.attempts.note_relays(relays)

    @property
    def in_vain(self) -> bool:
        return self._gate.watch.runs.in_vain

    def look(self, seconds: float) -> Fault | None:
        """The first fault that its runs show."""
        told = None
        for count in range(round(seconds / 0.05)):
            self.now_s += 0.05
            self.attempts.see(self.at_deg)
            found = self._gate.watch.see(self.now_s, self.at_deg + 0.1 * (-1) ** count, NORMAL)
            self.attempts.note(found, self.now_s, cause=None)
            told = told or found
        return told

    def drive(self, way: Direction) -> None:
        self._switch.to(self.now_s, way)

    def run_into(self, fault: Fault, way: Direction = PLUS) -> None:
        """Drive it until this fault ends the run."""
        self.drive(way)
        self.look(0.2)
        self.attempts.note(fault, self.now_s, cause=None)
        self.drive(OFF)

    def acknowledged(self, *, by_person: bool = False) -> bool:
        return self.attempts.acknowledge(self.now_s, by_person=by_person)


def test_the_stop_is_where_the_axis_stood_when_the_fault_struck_not_where_a_hand_turns_it_later() -> None:
    tried = Tried(at_deg=448.0)
    tried.run_into(END)
    assert tried.attempts.limits == Range(0.0, 446.0)
    tried.at_deg = 300.0
    tried.look(1.0)
    tried.attempts.note(END, tried.now_s, cause=None)
    assert tried.attempts.limits == Range(0.0, 446.0)
    assert len(tried.attempts.notices) == 1


def test_the_stop_is_on_the_side_to_which_it_was_driven_though_the_relay_is_off_already() -> None:
    tried = Tried(at_deg=3.0)
    tried.drive(MINUS)
    tried.look(0.2)
    tried.drive(OFF)
    tried.attempts.fail(END)
    assert tried.attempts.limits == Range(5.0, 450.0)


@pytest.mark.parametrize("fault", [WRONG, JUMPS])
def test_a_fault_of_another_kind_meets_no_stop(fault: Fault) -> None:
    tried = Tried()
    for _ in range(2):
        tried.run_into(fault)
        tried.acknowledged()
    assert tried.attempts.limits == LIMITS


def test_a_fault_at_rest_before_any_run_meets_no_stop() -> None:
    tried = Tried()
    tried.attempts.note(END, tried.now_s, cause=None)
    assert tried.attempts.limits == LIMITS


@pytest.mark.parametrize(("fault", "tries"), [(END, 1), (STANDS, 1), (WRONG, 1), (JUMPS, 0)])
def test_a_fault_of_the_motor_that_is_found_with_the_relay_off_counts_as_one_try(fault: Fault, tries: int) -> None:
    tried = Tried()
    tried.attempts.note(fault, tried.now_s, cause=None)
    assert tried.attempts.tries(tried.now_s).faults == tries


def test_a_fault_may_come_before_the_first_reading_of_the_axis() -> None:
    attempts = Attempts(Axis.AZIMUTH, LIMITS, gate())
    assert attempts.fail(JUMPS)
    assert attempts.acknowledge(0.0, by_person=False)
    assert attempts.fault is None


def test_a_link_keeps_the_stop_and_a_person_s_release_forgets_it() -> None:
    tried = Tried()
    tried.run_into(END)
    assert tried.acknowledged()
    assert (tried.attempts.fault, tried.attempts.limits) == (None, Range(0.0, 446.0))
    assert tried.acknowledged(by_person=True)
    assert (tried.attempts.notices, tried.attempts.limits) == ((), LIMITS)


def test_short_presses_in_vain_are_a_fault_and_each_of_them_is_a_try() -> None:
    tried = Tried(at_deg=200.0)
    pressed = 0
    while tried.attempts.fault is None:
        tried.drive(PLUS)
        tried.look(0.4)
        tried.drive(OFF)
        tried.look(1.0)
        pressed += 1
    assert tried.attempts.fault.kind is FaultKind.STANDS_STILL
    assert pressed > 3
    assert not tried.acknowledged(), "so many presses are as many tries"


@pytest.mark.parametrize("by_person", [False, True])
def test_after_a_link_s_acknowledgement_one_press_in_vain_is_a_fault_and_after_a_person_s_release_not(
    by_person: bool,
) -> None:
    tried = Tried(at_deg=200.0)
    tried.drive(PLUS)
    for _ in range(20):
        tried.at_deg += 0.3
        tried.look(0.05)
    tried.drive(OFF)
    tried.look(2.0)
    tried.run_into(STANDS)
    tried.look(1.0)
    assert tried.acknowledged(by_person=by_person)
    tried.look(1.0)
    tried.drive(PLUS)
    told = tried.look(0.5)
    tried.drive(OFF)
    told = told or tried.look(2.0)
    assert (told is None) is by_person


# --- over the end of the program


def test_the_next_run_goes_on_from_the_tries_of_this_one() -> None:
    tried = Tried()
    for _ in range(2):
        tried.run_into(END)
        tried.acknowledged()
    left = tried.attempts.tries(tried.now_s)
    assert left == Tries(2, END.kind, (448.0, None), (448.0, None))
    next_run = Tried(before=left)
    assert next_run.attempts.fault is None
    assert next_run.attempts.limits == Range(0.0, 446.0)
    next_run.run_into(JUMPS, MINUS)
    assert not next_run.acknowledged()
    assert next_run.acknowledged(by_person=True)
    assert next_run.attempts.tries(next_run.now_s) == NO_TRIES


def test_a_run_is_in_vain_until_it_is_seen_to_move_the_axis_or_a_fault_counts_it() -> None:
    def in_vain() -> bool:
        return tried.in_vain and tried.attempts.fault is None

    tried = Tried(at_deg=100.0)
    assert not in_vain()
    tried.drive(PLUS)
    tried.look(0.3)
    assert in_vain()
    tried.drive(OFF)
    tried.look(1.0)
    assert in_vain()
    tried.drive(PLUS)
    tried.at_deg = 101.0
    tried.look(0.3)
    assert not in_vain()
    tried.drive(OFF)
    tried.look(1.0)
    tried.drive(PLUS)
    tried.look(0.5)
    assert in_vain()
    tried.attempts.note(STANDS, tried.now_s, cause=None)
    assert not in_vain()
