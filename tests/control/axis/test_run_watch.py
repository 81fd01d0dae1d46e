"""How long a motor may run: from end to end and a third more, and less where its contact does not change."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_faults import WAYS
from rotator.control.axis.run_watch import RunWatch
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import ALL_OPEN, Motor
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
PERIOD_S, COAST_S = 5.0 / 6.0, 0.5
LONGEST_S = 1.3 * 60.0 + 5.0
"""360° at 6°/s."""


@pytest.fixture
def motors() -> dict[Direction, Motor]:
    return {PLUS: Motor(6.0, 0.6), MINUS: Motor(6.0, 0.6)}


@pytest.fixture
def watch(motors: dict[Direction, Motor]) -> RunWatch:
    limits = Range(0.0, 360.0)
    return RunWatch(Axis.AZIMUTH, limits, motors, PERIOD_S, COAST_S, master=False, trusts=ALL_OPEN, look=False)


def first_fault(watch: RunWatch, from_s: float, seconds: float) -> tuple[float, Fault] | None:
    """The readings of a run that goes on and on."""
    for cycle in range(round(seconds / 0.05)):
        at_s = from_s + cycle * 0.05
        fault = watch.see(at_s, 6.0 * (at_s - from_s), Condition(changes=round(at_s / PERIOD_S)))
        if fault:
            return at_s - from_s, fault
    return None


def test_a_run_from_end_to_end_is_no_fault(watch: RunWatch) -> None:
    switch = Switch(watch.note_relays)
    switch.to(100.0, PLUS)
    assert first_fault(watch, 100.0, LONGEST_S - 0.1) is None


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["clockwise", "counter-clockwise"])
def test_a_run_that_does_not_end_is_a_fault_with_its_direction_and_its_limit(watch: RunWatch, way: Direction) -> None:
    switch = Switch(watch.note_relays)
    switch.to(100.0, way)
    told = first_fault(watch, 100.0, 100.0)
    assert told is not None
    after_s, fault = told
    assert after_s == pytest.approx(LONGEST_S, abs=0.1)
    assert str(fault) == (
        f"azimuth: motor on longer than the travel takes: its motor ran {WAYS[Axis.AZIMUTH, way]} for 83 s without a "
        "pause, limit 83 s. Look for a slow motor, or a pot that slips on its shaft "
        "(rotator help motor-on-longer-than-the-travel-takes)"
    )


def test_a_stop_or_a_reversal_begins_anew(watch: RunWatch) -> None:
    switch = Switch(watch.note_relays)
    switch.to(0.0, PLUS)
    assert first_fault(watch, 0.0, 80.0) is None
    switch.to(80.0, MINUS)
    assert first_fault(watch, 80.0, 80.0) is None
    switch.to(160.0, OFF)
    switch.to(161.0, MINUS)
    assert first_fault(watch, 161.0, 80.0) is None


def test_a_motor_that_has_shown_to_be_slow_has_longer(watch: RunWatch, motors: dict[Direction, Motor]) -> None:
    motors[PLUS] = Motor(3.0, 0.3)
    switch = Switch(watch.note_relays)
    switch.to(0.0, PLUS)
    assert first_fault(watch, 0.0, LONGEST_S + 60.0) is None
    switch.to(200.0, MINUS)
    assert first_fault(watch, 200.0, 100.0) is not None, "the other way it is as fast as ever"


class Presses:
    """A motor that is pressed on for a moment, again and again; the contact changes when the test says so."""

    def __init__(self, watch: RunWatch) -> None:
        self._watch = watch
        self._switch = Switch(watch.note_relays)
        self._now_s = 0.0
        self.changes = 0

    def press(self, way: Direction, seconds: float) -> Fault | None:
        """The fault that ends this press. A pause follows."""
        self._switch.to(self._now_s, way)
        fault = next(filter(None, (self._see() for _ in range(round(seconds / 0.05)))), None)
        self._switch.to(self._now_s, OFF)
        for _ in range(20):
            assert self._see() is None
        return fault

    def _see(self) -> Fault | None:
        self._now_s += 0.05
        return self._watch.see(self._now_s, 0.0, Condition(changes=self.changes))


@pytest.mark.parametrize("press_s", [0.4, 1.0, 2.0])
def test_presses_without_a_change_of_the_contact_count_together(watch: RunWatch, press_s: float) -> None:
    presses, pressed_s, told = Presses(watch), 0.0, None
    while told is None:
        told = presses.press(MINUS, press_s)
        pressed_s += press_s
        watch.acknowledge()
        assert pressed_s < 6.0
    assert pressed_s >= 2.5
    assert told.name == "no pulses"
    assert presses.press(MINUS, press_s) is None, "the next try has its own time"


def test_an_axis_that_looks_for_its_stop_may_press_against_it(watch: RunWatch) -> None:
    presses = Presses(watch)
    for _ in range(10):
        assert presses.press(MINUS, 2.0) is None
        watch.homes(homing=True, failed=False)


# --- what the contact has shown of the relays when a run is over


class Driven:
    """An axis at 100° that is driven, and then stands for five seconds; its contact may change both ways."""

    def __init__(self, watch: RunWatch) -> None:
        self.watch = watch
        self._switch = Switch(watch.note_relays)
        self._now_s, self._angle_deg, self._changes = 100.0, 100.0, 0
        self.goes_on(4.0)

    def goes_on(self, seconds: float, way: Direction = OFF, *, pulses: bool = True, fault: Fault | None = None) -> None:
        self._switch.to(self._now_s, way)
        for _ in range(round(seconds / 0.05)):
            self._now_s += 0.05
            if way is not OFF and pulses:
                self._angle_deg += way * 0.3
                self._changes = round(abs(self._angle_deg - 100.0) / 5.0)
            condition = Condition(fault, changes=self._changes, ahead=frozenset((PLUS, MINUS)))
            self.watch.see(self._now_s, self._angle_deg, condition)


@pytest.mark.parametrize("kind", [None, FaultKind.NO_PULSES, FaultKind.LIMIT_SWITCH])
def test_after_pulses_that_the_rotor_has_missed_the_opposite_relay_stays_forbidden(
    watch: RunWatch, kind: FaultKind | None
) -> None:
    """The contact is not to be trusted any more: standing is not seen by it."""
    axis = Driven(watch)
    axis.goes_on(4.0, PLUS)
    fault = None if kind is None else Fault(kind, Axis.AZIMUTH, "by the rotor's own count")
    axis.goes_on(0.1, PLUS, fault=fault)
    axis.goes_on(5.0, fault=fault)
    assert watch.forbids(MINUS) is (kind is FaultKind.NO_PULSES)
    assert not watch.forbids(PLUS)
