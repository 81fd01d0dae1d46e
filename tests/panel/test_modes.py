"""The front panel as its builder describes it: what each switch does in each mode and never does, and what is lit."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rotator.exchange.faults import Missing
from rotator.exchange.orders import Aim, Jog, Mode, Nudge, Release, SetMode, Stop
from rotator.exchange.status import AxisStatus
from rotator.panel.panel import LAMPS, Panel, PanelSettings
from tests.panel.person import (
    AUTO,
    AZ,
    BITS,
    CCW,
    CENTRE,
    CW,
    CW_AND_UP,
    DOWN,
    EL,
    JOG,
    LOOK_S,
    MANUAL,
    MINUS,
    PARK,
    PLUS,
    STILL,
    UP,
    Person,
    about,
    at_the_panel,
    presses,
)
from tests.tables import every_row

# --- the mode switch


@pytest.mark.parametrize(("bits", "mode"), BITS.items())
def test_at_the_start_the_mode_is_set_after_a_second(bits: tuple[bool, bool], mode: Mode) -> None:
    person = Person()
    assert person.waits(1.0, mode_bits=bits) == []
    assert person.sees() == [SetMode(mode)]


def test_a_mode_must_be_still_for_a_second_and_is_lit_meanwhile() -> None:
    person = at_the_panel(AUTO)
    assert person.lit() == {"auto"}
    assert person.waits(0.9, mode_bits=PARK) == []
    assert person.lit() == {"auto", "park", "switch"}
    assert person.waits(0.2) == [Release(), SetMode(Mode.PARK)]
    assert person.lit() == {"park"}


def test_a_mode_switch_that_bounces_tells_nothing() -> None:
    person = at_the_panel(AUTO)
    for _ in range(100):
        assert person.sees(mode_bits=PARK) == person.sees(mode_bits=MANUAL) == []


def test_a_mode_switch_that_cannot_be_read_for_a_while_has_not_been_turned() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(3.0, mode_bits=None) == person.waits(3.0, mode_bits=AUTO) == []


def test_without_a_mode_switch_no_mode_is_set_and_the_jog_switches_nudge() -> None:
    person = Person(Panel(PanelSettings(mode_switch=False)))
    assert person.waits(3.0, mode_bits=None) == []
    assert person.waits(0.2, jog=CW) == [Nudge(AZ, 5.0)]
    assert person.lit() == {"switch"}


# --- AUTO


def test_in_auto_a_press_is_one_index_however_long_it_is_held() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(5.0, jog=CW) == [Nudge(AZ, 5.0)]
    assert person.lit() == {"auto", "switch"}
    assert person.waits(0.2, jog=CENTRE) == []
    assert person.lit() == {"auto"}
    assert person.waits(0.2, jog=CW) == [Nudge(AZ, 10.0)]


def test_every_switch_nudges_its_axis_its_way() -> None:
    person = at_the_panel(AUTO, PanelSettings(nudge_deg={AZ: 5.0, EL: 10.0}))
    for share, nudge in ((UP, Nudge(EL, 10.0)), (DOWN, Nudge(EL, 0.0)), (DOWN, Nudge(EL, -10.0)), (CCW, Nudge(AZ, -5))):
        assert person.waits(0.2, jog=share) == [nudge]
        assert person.waits(0.2, jog=CENTRE) == []


def test_nudges_end_at_minus_seven_and_plus_eight() -> None:
    person = at_the_panel(AUTO)
    assert presses(person, CW, 12)[-1:] == [Nudge(AZ, 40.0)]
    assert person.waits(0.2, jog=CW) == []
    assert "switch" not in person.lit()  # not acknowledged
    assert len(presses(person, CCW, 20)) == 15
    assert presses(person, CW, 1) == [Nudge(AZ, -30.0)]


def test_a_change_of_mode_forgets_the_nudges() -> None:
    person = at_the_panel(AUTO)
    presses(person, CW, 3)
    person.waits(1.5, mode_bits=PARK)
    person.waits(1.5, mode_bits=AUTO)
    assert presses(person, CW, 1) == [Nudge(AZ, 5.0)]


def test_a_single_odd_reading_does_nothing() -> None:
    person = at_the_panel(AUTO)
    assert person.sees(jog=CW) == person.waits(0.5, jog=CENTRE) == []
    person.waits(0.2, jog=UP)
    assert person.sees(jog=CENTRE) == person.waits(0.5, jog=UP) == []  # held all the time


def test_knobs_do_nothing_in_auto() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(3.0, azimuth_knob=0.5) == []
    assert person.act.meters == {AZ: 0.25, EL: 0.25}


# --- MANUAL


def test_in_manual_the_knobs_show_on_the_meters_and_send_the_rotors_a_second_after_they_stop() -> None:
    person = at_the_panel(MANUAL)
    assert person.act.meters == {AZ: 0.25, EL: 0.25}
    for turned in range(10):
        assert person.sees(azimuth_knob=turned / 20, elevation_knob=turned / 10) == []
    assert person.act.meters == {AZ: 0.45, EL: 0.9}
    assert person.waits(0.95) == []
    assert person.sees() == [Aim(about(162.0), about(162.0), place=True)]
    assert person.act.meters == {AZ: 0.25, EL: 0.25}
    assert person.waits(5.0) == []


def test_a_knob_that_was_not_turned_leaves_its_axis_where_it_is() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(2.0, elevation_knob=0.5) == [Aim(None, about(90.0), place=True)]


def test_both_knobs_must_have_stopped() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(0.8, azimuth_knob=0.5) == []
    assert person.waits(0.95, elevation_knob=0.5) == []
    assert person.waits(0.1) == [Aim(about(180.0), about(90.0), place=True)]


def test_jitter_of_one_count_is_ignored() -> None:
    person = at_the_panel(MANUAL)
    for _ in range(50):
        assert person.sees(azimuth_knob=1 / 255) == person.sees(azimuth_knob=0.0) == []
    assert person.waits(3.0, azimuth_knob=0.0) == []
    assert person.waits(2.0, azimuth_knob=2 / 255) == [Aim(about(360 * 2 / 255), None, place=True)]


def test_a_knob_turned_before_the_mode_was_set_orders_nothing() -> None:
    person = at_the_panel(PARK)
    person.sees(azimuth_knob=0.7, mode_bits=MANUAL)
    assert person.waits(0.5, azimuth_knob=0.9) == []
    assert person.waits(5.0) == [Release(), SetMode(Mode.MANUAL)]


def test_a_knob_that_is_read_again_was_not_turned() -> None:
    person = at_the_panel(MANUAL)
    assert person.waits(1.0, azimuth_knob=None) == person.waits(3.0, azimuth_knob=0.6) == []


def test_jog_switches_do_nothing_in_manual() -> None:
    assert at_the_panel(MANUAL).waits(2.0, jog=CW) == []


# --- PARK


def test_in_park_knobs_only_show_and_nothing_moves() -> None:
    person = at_the_panel(PARK)
    assert person.waits(3.0, azimuth_knob=0.8, jog=UP) == []
    assert person.act.meters == {AZ: 0.8, EL: 0.0}


# --- JOG


def test_in_jog_it_drives_while_held_and_stops_when_let_go() -> None:
    person = at_the_panel(JOG)
    assert person.waits(0.5, jog=CCW) == [Jog(AZ, MINUS, 0.3)] * 9  # renewed with every step
    assert person.lit() == {"jog", "switch"}
    assert person.waits(1.0, jog=CENTRE) == [Stop((AZ,))]


@every_row("jog", [CW_AND_UP, UP, None, 0.0, 1.0])
def test_any_other_reading_stops_it_until_all_switches_are_released(jog: float | None) -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    assert person.waits(1.0, jog=jog) == [Stop((AZ,))]
    assert person.waits(1.0, jog=CW) == []
    assert person.waits(0.2, jog=CENTRE) == []
    assert person.waits(0.1, jog=CW) == [Jog(AZ, PLUS, 0.3)]


def test_a_switch_held_since_before_the_mode_was_set_must_be_released_first() -> None:
    person = at_the_panel(PARK)
    assert person.waits(5.0, jog=CW, mode_bits=JOG) == [Release(), SetMode(Mode.JOG)]


def test_turning_the_mode_switch_ends_a_jog_at_once() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=DOWN)
    assert person.sees(mode_bits=AUTO) == [Stop((EL,))]
    assert person.waits(2.0) == [Release(), SetMode(Mode.AUTO)]


def test_an_axis_without_calibration_gets_two_seconds_a_press() -> None:
    person = at_the_panel(JOG)
    person.status = replace(STILL, azimuth=replace(STILL.azimuth, missing=(Missing.HOMING,)))
    *jogs, last = person.waits(5.0, jog=CW)
    assert set(jogs) == {Jog(AZ, PLUS, 0.3)}
    assert 1.95 <= len(jogs) * LOOK_S <= 2.05
    assert last == Stop((AZ,))


def test_lamps_of_motors_data_and_pulses() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(STILL, azimuth=replace(STILL.azimuth, drive=MINUS, moving=True))
    person.sees(data=True, pulses=frozenset({EL}))
    assert person.lit() == {"auto", "motor", "data", "elevation_pulse"}
    person.waits(0.2, data=False)
    assert person.lit() == {"auto", "motor", "elevation_pulse"}
    assert set(person.act.lamps) == set(LAMPS)


def test_meters_show_where_the_axes_stand_and_zero_where_the_angle_is_unknown() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(
        STILL,
        azimuth=AxisStatus(0.0, 450.0, angle_deg=455.0),
        elevation=AxisStatus(0.0, 180.0),
    )
    person.sees()
    assert person.act.meters == {AZ: 1.0, EL: 0.0}
