"""When a run waits for the opposite relay, what is done meanwhile, and what a person in attendance may do."""

from __future__ import annotations

import dataclasses

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import NORMAL, Condition, Window
from rotator.control.axis.relay_gate import WAITS, RelayGate
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Feed, Run
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Motor, Trust, Trusts
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
OPEN, UNSEEN, DOUBTED, WELDED = Trust
MOTOR = Motor(6.0, 0.9)
MOTORS = {PLUS: MOTOR, MINUS: MOTOR}
SETTINGS = SwitchedSettings(
    Axis.AZIMUTH, Range(0.0, 450.0), 4.0, MOTOR, Window(0.02, 0.98), Calibration(((0.05, 0.0), (0.95, 450.0)))
)
COUNTED = dataclasses.replace(SETTINGS, homing=HomingSettings(5.0 / 6.0, 75.0, 0.5, 0.0))
SILENT = Fault(FaultKind.SENSOR_SILENT, Axis.AZIMUTH, "no answer")


def gate(settings: SwitchedSettings = SETTINGS, **known: object) -> RelayGate:
    return RelayGate(dataclasses.replace(settings, **known), MOTORS, lease_s=0.25, placed=True)  # type: ignore[arg-type]


def stood(a_gate: RelayGate, from_s: float, seconds: float, condition: Condition = NORMAL) -> float:
    """It stands at 200°. Returns the moment after that."""
    for step in range(1, round(seconds / 0.05) + 1):
        a_gate.watch.see(from_s + 0.05 * step, 200.0, condition)
    return from_s + seconds


@pytest.mark.parametrize(
    ("master", "meanwhile"), [(False, Run(OFF, 10.0)), (True, Feed(10.25))], ids=["no master", "master"]
)
def test_a_run_that_waits_leaves_the_relays_open_and_feeds_a_master(master: bool, meanwhile: Run | Feed) -> None:
    """With its supply alone a welded relay shows itself."""
    a_gate = gate(master=master, look=True)
    run = Run(PLUS, 10.25)
    assert a_gate.passed(run, 10.0) == meanwhile
    assert a_gate.waiting
    now_s = stood(a_gate, 10.0, 2.0)
    assert a_gate.passed(run, now_s) is run
    assert not a_gate.waiting


def test_a_long_wait_is_noticed_after_four_seconds_and_ends_with_the_wish() -> None:
    a_gate = gate(look=True)
    a_gate.passed(Run(PLUS, 10.25), 10.0)
    a_gate.passed(Run(PLUS, 12.25), 12.0)
    assert a_gate.notices(13.9) == ()
    assert a_gate.notices(14.0) == (WAITS,)
    a_gate.rests()
    assert not a_gate.waiting
    assert a_gate.notices(100.0) == ()


@pytest.mark.parametrize("attended", [False, True])
@pytest.mark.parametrize(("trusts", "way"), [((DOUBTED, OPEN), MINUS), ((OPEN, DOUBTED), PLUS)])
def test_a_person_who_watches_passes_a_doubt_and_no_other_does(trusts: Trusts, way: Direction, attended: bool) -> None:
    a_gate = gate(trusts=trusts, attended=attended)
    stood(a_gate, 10.0, 1.0)
    run = Run(way, 11.3)
    assert (a_gate.passed(run, 11.0) is run) is attended
    assert (a_gate.accuse(way) is None) is attended
    assert a_gate.passed(Run(Direction(-way), 11.3), 11.0) == Run(Direction(-way), 11.3), "its own relay"
    assert len(a_gate.notices(11.0)) == int(attended)


def test_a_person_who_watches_passes_a_doubt_only_after_the_look_at_the_supply_alone() -> None:
    """After a restart: with the supply on for the other axis a welded relay turns this one already."""
    a_gate = gate(trusts=(DOUBTED, OPEN), attended=True, look=True, master=True)
    run = Run(MINUS, 11.3)
    assert isinstance(a_gate.passed(run, 10.0), Feed)
    assert a_gate.accuse(MINUS) is not None
    now_s = stood(a_gate, 10.0, 2.0)
    assert a_gate.passed(run, now_s) is run


@pytest.mark.parametrize("trusts", [(WELDED, OPEN), (OPEN, WELDED)])
def test_a_welded_relay_passes_neither(trusts: Trusts) -> None:
    a_gate = gate(trusts=trusts, attended=True)
    stood(a_gate, 10.0, 1.0)
    way = MINUS if trusts[0] is WELDED else PLUS
    assert a_gate.accuse(way) is not None
    assert a_gate.passed(Run(way, 11.3), 11.0) == Run(OFF, 11.0)


def test_a_person_who_watches_does_not_pass_an_axis_whose_contact_changes_by_itself() -> None:
    a_gate = gate(COUNTED, trusts=(DOUBTED, OPEN), attended=True)
    now_s = stood(a_gate, 10.0, 5.0)
    assert a_gate.passed(Run(MINUS, now_s + 0.25), now_s) == Run(MINUS, now_s + 0.25)
    for changes in range(1, 5):
        now_s = stood(a_gate, now_s, 0.2, Condition(changes=changes))
    assert a_gate.passed(Run(MINUS, now_s + 0.25), now_s) == Run(OFF, now_s)
    assert a_gate.accuse(MINUS) is not None


# --- new readings


@pytest.mark.parametrize("settings", [SETTINGS, COUNTED], ids=["measured", "counted"])
def test_when_the_readings_mean_other_places_what_is_known_of_the_relays_stays(settings: SwitchedSettings) -> None:
    a_gate = gate(settings, trusts=(DOUBTED, OPEN), look=True)
    a_gate.watch.rescale(MOTORS, placed=True)
    assert a_gate.watch.trusts == (DOUBTED, OPEN)
    assert a_gate.passed(Run(PLUS, 10.3), 10.0) == Run(OFF, 10.0), "it has still to be seen standing"
    seen = gate(settings, look=True)
    now_s = stood(seen, 10.0, 5.0)
    seen.watch.rescale(MOTORS, placed=True)
    assert seen.passed(Run(PLUS, now_s + 0.3), now_s) == Run(PLUS, now_s + 0.3)


# --- a sensor that cannot be believed


def ran(way: Direction, off_after_s: float, *, master: bool = True) -> tuple[RelayGate, Switch, float]:
    """A run whose relay opened so long ago, and has not been seen to."""
    a_gate = gate(master=master)
    switch, now_s = Switch(a_gate.note_relays), stood(a_gate, 10.0, 2.0)
    switch.to(now_s, way)
    now_s += 1.0
    switch.to(now_s, OFF)
    return a_gate, switch, now_s + off_after_s


@pytest.mark.parametrize(("way", "name"), [(PLUS, "clockwise"), (MINUS, "counter-clockwise")])
@pytest.mark.parametrize(
    ("master", "act_now", "who"), [(True, "", "The box has"), (False, "CUT MOTOR POWER!", "by hand NOW")]
)
def test_a_sensor_that_hides_whether_the_motor_has_stopped_asks_for_its_supply_to_go(
    way: Direction, name: str, master: bool, act_now: str, who: str
) -> None:
    """The wire of the pot breaks, and the relay may have welded: with a master the box cuts, without one a person."""
    a_gate, _, now_s = ran(way, 1.1, master=master)
    fault = a_gate.blind(SILENT, now_s)
    assert fault is not None
    assert (fault.kind, fault.cut, fault.act_now) == (SILENT.kind, True, act_now)
    assert fault.measured.startswith("no answer, ")
    assert fault.measured.endswith(f" {name}")
    assert who in fault.advice


@pytest.mark.parametrize("master", [True, False])
def test_but_not_while_it_may_still_coast_or_is_driven_or_was_seen_to_stop(master: bool) -> None:
    a_gate, _, now_s = ran(PLUS, 0.9, master=master)
    assert a_gate.blind(SILENT, now_s) is SILENT
    assert a_gate.blind(None, now_s + 5.0) is None
    stood(a_gate, now_s, 3.0)
    assert a_gate.blind(SILENT, now_s + 5.0) is SILENT
    a_gate, switch, now_s = ran(PLUS, 5.0, master=master)
    switch.to(now_s, PLUS)
    assert a_gate.blind(SILENT, now_s + 2.0) is SILENT
    assert gate(master=master).blind(SILENT, 100.0) is SILENT, "it has not been driven"


# --- looking for its stop


def test_an_axis_that_measures_knows_no_homing() -> None:
    a_gate = gate()
    a_gate.watch.homes(homing=True, failed=False)
    assert a_gate.watch.trusts == (OPEN, OPEN)
