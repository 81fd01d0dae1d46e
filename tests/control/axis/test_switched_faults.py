"""Which fault of a switched axis is kept: what the rotor reports, a lost count, missing pulses while it homes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import ANYTHING, NORMAL, Condition, Reading
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.switched_faults import SwitchedFaults
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Motor

MINUS, OFF, PLUS = Direction
AZ = Axis.AZIMUTH
LIMITS, MOTOR = Range(0.0, 450.0), Motor(6.0, 1.0)
DEGREES = Calibration(((0.0, 0.0), (450.0, 450.0)))
POT = SwitchedSettings(AZ, LIMITS, 4.0, MOTOR, ANYTHING, DEGREES)
COUNTS = replace(POT, source=AngleSource.COUNTED, homing=HomingSettings(1.0, 75.0, 0.5, 0.0))
NO_PULSES = Fault(FaultKind.NO_PULSES, AZ, "its motor ran, and the contact did not change")
TURNS = Fault(FaultKind.TURNS_BY_ITSELF, AZ, "it turns at 6.0°/s", cut=True)
BAD = Fault(FaultKind.POT_OPEN, AZ, "0.0 of its range")
STEP_S = 0.05


class Watched:
    """An axis at rest at 100°; a test says what else is read of it."""

    def __init__(self, settings: SwitchedSettings = COUNTS) -> None:
        self.gate = gate = RelayGate(
            settings, {PLUS: MOTOR, MINUS: MOTOR}, lease_s=0.25, placed=settings.calibration is not None
        )
        self.faults = SwitchedFaults(settings, gate)
        self._sensing = Sensing(AZ, ANYTHING, settings.calibration)
        self._relays = RelayState()
        self.now_s = 100.0

    def look(
        self, condition: Condition = NORMAL, unbelievable: Fault | None = None, *, homing: bool = False, looks: int = 1
    ) -> bool:
        """Whether a new fault is kept."""
        kept = False
        for _ in range(looks):
            self.now_s += STEP_S
            reading = Reading(self.now_s, 100.0, condition=condition)
            self._sensing.take(reading, self.now_s)
            kept |= self.faults.look(reading, self._sensing, unbelievable, self.now_s, homing=homing)
        return kept

    def drive(self, way: Direction) -> None:
        self._relays = self._relays.changed(self.now_s, way)
        self.faults.note_relays(self._relays)

    @property
    def kind(self) -> FaultKind | None:
        return self.faults.attempts.fault.kind if self.faults.attempts.fault else None


def lost(why: str) -> Condition:
    return Condition(lost=why)


# --- a count that is lost


def test_a_count_that_is_lost_at_the_start_is_no_fault() -> None:
    axis = Watched()
    assert not axis.look(lost("never homed"), looks=20)
    assert axis.kind is None


def test_a_count_that_gets_lost_is_a_fault_that_says_what_it_needs() -> None:
    axis = Watched()
    axis.look(looks=20)
    assert axis.look(lost("pulses at rest"))
    assert axis.kind is FaultKind.COUNT_LOST
    assert axis.faults.attempts.fault is not None
    assert axis.faults.attempts.fault.measured == "homing (pulses at rest)"
    assert axis.faults.acknowledge(axis.now_s, by_person=True)
    assert not axis.look(lost("pulses at rest"), looks=20), "it is said once"


def test_while_it_homes_a_lost_count_is_what_it_homes_for() -> None:
    axis = Watched()
    axis.look()
    assert not axis.look(lost("a new start"), homing=True, looks=5)
    assert axis.kind is None


# --- what the rotor reports


@pytest.mark.parametrize(
    ("reported", "homing", "kind"),
    [
        (NO_PULSES, False, FaultKind.NO_PULSES),
        (NO_PULSES, True, None),
        (TURNS, False, FaultKind.TURNS_BY_ITSELF),
        (TURNS, True, FaultKind.TURNS_BY_ITSELF),
    ],
)
def test_at_its_end_stop_missing_pulses_are_normal_and_a_motor_that_turns_by_itself_is_not(
    reported: Fault, homing: bool, kind: FaultKind | None
) -> None:
    axis = Watched()
    axis.look()
    assert axis.look(Condition(fault=reported), homing=homing) is (kind is not None)
    assert axis.kind is kind


def test_the_rotor_s_own_report_counts_before_what_is_seen_from_here() -> None:
    axis = Watched(POT)
    assert axis.look(Condition(fault=TURNS), BAD)
    assert axis.kind is FaultKind.TURNS_BY_ITSELF


@pytest.mark.parametrize(("latched", "ends"), [(True, True), (False, False)])
def test_a_fault_that_the_rotor_keeps_itself_ends_with_the_acknowledgement_that_it_is_sent(
    latched: bool, ends: bool
) -> None:
    axis = Watched()
    axis.look()
    axis.look(Condition(fault=NO_PULSES, latched=latched))
    axis.faults.acknowledge(axis.now_s, by_person=True)
    assert (axis.kind is None) is ends


def test_a_bad_sensor_is_a_fault_for_as_long_as_it_is_bad() -> None:
    axis = Watched(POT)
    axis.look()
    assert axis.look(unbelievable=BAD)
    axis.faults.acknowledge(axis.now_s, by_person=True)
    assert axis.kind is FaultKind.POT_OPEN
    axis.look()
    axis.faults.acknowledge(axis.now_s, by_person=True)
    assert axis.kind is None


# --- what the next run of the program has to know


def test_a_run_in_which_the_contact_has_not_changed_is_remembered() -> None:
    axis = Watched()
    axis.look()
    assert not axis.faults.tries(axis.now_s).driven
    axis.drive(PLUS)
    axis.look(looks=3)
    axis.drive(OFF)
    assert axis.faults.tries(axis.now_s).driven
    axis.look(Condition(changes=1))
    assert not axis.faults.tries(axis.now_s).driven, "it has turned"


def test_a_run_at_its_end_stop_is_not_remembered_nor_one_that_a_fault_has_counted() -> None:
    homing = Watched()
    homing.look()
    homing.drive(MINUS)
    homing.look(homing=True)
    assert not homing.faults.tries(homing.now_s).driven
    failed = Watched()
    failed.look()
    failed.drive(PLUS)
    failed.look(Condition(fault=NO_PULSES))
    assert failed.kind is FaultKind.NO_PULSES
    assert not failed.faults.tries(failed.now_s).driven


def test_on_a_pot_without_a_calibration_no_run_is_remembered_as_in_vain() -> None:
    axis = Watched(replace(POT, calibration=None))
    axis.look()
    axis.drive(PLUS)
    axis.look(looks=10)
    axis.drive(OFF)
    axis.look(looks=40)
    tries = axis.faults.tries(axis.now_s)
    assert (tries.driven, tries.pressed) == (False, False)


@pytest.mark.parametrize("by_person", [False, True])
def test_presses_in_vain_are_forgotten_when_a_person_acknowledges_and_a_link_does_not(by_person: bool) -> None:
    axis = Watched(replace(POT, calibration=None))
    axis.look(looks=10)
    for _ in range(3):
        assert not axis.gate.watch.runs.pressed
        axis.drive(PLUS)
        axis.look(looks=30)
        axis.drive(OFF)
        axis.look(looks=30)
    assert axis.gate.watch.runs.pressed
    assert axis.faults.tries(axis.now_s).pressed
    axis.faults.acknowledge(axis.now_s, by_person=by_person)
    assert axis.gate.watch.runs.pressed is not by_person
