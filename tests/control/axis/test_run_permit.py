"""What forbids a switched motor its run: a limit, a limit switch, a relay in doubt, heat, a late cycle."""

from __future__ import annotations

import dataclasses

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import NORMAL, Window
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.run_permit import LAPSED_S, RunPermit, at_ends
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Motor, Trust

MINUS, OFF, PLUS = Direction
LEASE_S = 0.25
MOTOR = Motor(6.0, 0.9)
SETTINGS = SwitchedSettings(
    Axis.AZIMUTH, Range(0.0, 450.0), 4.0, MOTOR, Window(0.02, 0.98), Calibration(((0.05, 0.0), (0.95, 450.0)))
)
RUN = Run(PLUS, 10.25)


def permit(settings: SwitchedSettings = SETTINGS) -> tuple[RunPermit, RelayGate]:
    gate = RelayGate(settings, {PLUS: MOTOR, MINUS: MOTOR}, lease_s=LEASE_S, placed=True)
    return RunPermit(settings, gate, lease_s=LEASE_S), gate


@pytest.mark.parametrize(
    ("angle_deg", "ends"),
    [(-1.0, (MINUS,)), (0.0, (MINUS,)), (0.1, ()), (449.9, ()), (450.0, (PLUS,)), (451.0, (PLUS,))],
)
def test_an_axis_is_at_its_limit_there_and_beyond(angle_deg: float, ends: tuple[Direction, ...]) -> None:
    assert at_ends(angle_deg, Range(0.0, 450.0)) == ends


def test_at_a_limit_it_runs_back_alone() -> None:
    a_permit, _ = permit()
    assert a_permit.permitted(RUN, 10.0, 0.05, ends=(PLUS,), switches=()) is None
    assert a_permit.permitted(RUN, 10.0, 0.05, ends=(MINUS,), switches=()) is RUN


def test_an_open_limit_switch_is_a_fault_of_a_run_towards_it() -> None:
    a_permit, _ = permit()
    fault = a_permit.permitted(RUN, 10.0, 0.05, ends=(), switches={PLUS})
    assert isinstance(fault, Fault)
    assert fault.kind is FaultKind.LIMIT_SWITCH
    assert a_permit.permitted(RUN, 10.0, 0.05, ends=(), switches={MINUS}) is RUN


def test_a_relay_in_doubt_is_a_fault_of_a_run_against_it() -> None:
    a_permit, _ = permit(dataclasses.replace(SETTINGS, trusts=(Trust.OPEN, Trust.DOUBTED)))
    fault = a_permit.permitted(RUN, 10.0, 0.05, ends=(), switches=())
    assert isinstance(fault, Fault)
    assert fault.kind is FaultKind.RELAY_UNSEEN


@pytest.mark.parametrize(("past_s", "closed", "lapsed"), [(0.26, True, True), (0.24, True, False), (5.0, False, False)])
def test_after_a_cycle_so_late_that_its_lease_ended_the_run_it_rests_for_a_second(
    past_s: float, closed: bool, lapsed: bool
) -> None:
    a_permit, _ = permit()
    a_permit.note_relays(9.0, RelayState().changed(9.0, PLUS if closed else OFF))
    first = a_permit.permitted(RUN, 10.0, past_s, ends=(), switches=())
    assert (first is None) is lapsed
    then_s = 10.0 + LAPSED_S
    assert (a_permit.permitted(RUN, then_s - 0.01, 0.05, ends=(), switches=()) is None) is lapsed
    assert a_permit.permitted(RUN, then_s, 0.05, ends=(), switches=()) is RUN


def test_a_hot_motor_rests() -> None:
    a_permit, _ = permit(dataclasses.replace(SETTINGS, longest_run_s=5.0, rest_s=10.0))
    relays = RelayState().changed(0.0, PLUS)
    for second in range(7):
        assert (a_permit.cooling, a_permit.notice is None) == (second > 5, second <= 5)
        a_permit.note_relays(float(second), relays)
    assert a_permit.notice is not None
    assert a_permit.notice.text == "motor hot: it has run for 5 s and has to rest"
    assert a_permit.permitted(RUN, 10.0, 0.05, ends=(), switches=()) is None


def test_a_run_that_is_forbidden_does_not_wait_for_its_relay() -> None:
    a_permit, gate = permit(dataclasses.replace(SETTINGS, look=True))
    a_permit.permitted(RUN, 10.0, 0.05, ends=(), switches=())
    assert gate.waiting, "nothing has been seen of the axis yet"
    for run, ends in ((RUN, (PLUS,)), (Run(OFF, 10.0), ())):
        a_permit.permitted(run, 10.1, 0.05, ends=ends, switches=())
        assert not gate.waiting
        a_permit.permitted(RUN, 10.2, 0.05, ends=(), switches=())
        assert gate.waiting
    for step in range(60):
        gate.watch.see(10.3 + 0.05 * step, 200.0, NORMAL)
    assert a_permit.permitted(RUN, 14.0, 0.05, ends=(), switches=()) is RUN
