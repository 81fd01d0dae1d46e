"""The front panel from power-up with its calibrate switch closed: knobs' full scales, then homing, axis by axis."""

from __future__ import annotations

from rotator.exchange.orders import Aim, Home, Jog, Mode, Release, SetMode
from rotator.panel.panel import Panel, PanelSettings
from tests.panel.person import AUTO, AZ, CW, EL, JOG, MANUAL, PARK, PLUS, Person, about, at_the_panel


def test_calibration_reads_the_knobs_and_homes_one_axis_a_step() -> None:
    person = Person()
    assert person.sees(calibrate=True, azimuth_knob=0.97, elevation_knob=0.93, mode_bits=MANUAL) == [
        SetMode(Mode.MANUAL)
    ]
    assert person.act.full_scales == {AZ: 0.97, EL: 0.93}
    assert person.act.meters == {AZ: 1.0, EL: 1.0}  # for the meters' trimmers
    assert any("mode switch" in note for note in person.act.notes)
    assert person.waits(3.0) == []
    assert person.act.full_scales is None
    assert person.waits(1.5, mode_bits=PARK) == [Release(), Home(AZ)]
    assert person.waits(60.0, pulses=frozenset({AZ})) == []
    assert {"azimuth_pulse", "switch"} <= person.lit()
    assert person.waits(1.5, mode_bits=AUTO) == [Release(), Home(EL)]
    assert person.waits(60.0) == []
    assert "switch" in person.lit(), "the calibration is not over"
    assert person.waits(1.5, mode_bits=JOG) == [Release(), SetMode(Mode.JOG)]
    assert person.lit() == {"azimuth_pulse", "jog"}, "it is"
    assert person.waits(0.1, jog=CW) == [Jog(AZ, PLUS, 0.3)]


def test_the_calibrate_switch_is_read_at_power_up_only() -> None:
    person = at_the_panel(AUTO)
    assert person.waits(2.0, calibrate=True) == []
    assert person.act.full_scales is None
    assert person.waits(2.0, mode_bits=PARK) == [Release(), SetMode(Mode.PARK)]


def test_a_knob_that_is_not_at_its_maximum_is_not_trusted() -> None:
    person = Person()
    person.sees(calibrate=True, azimuth_knob=0.1, elevation_knob=0.95)
    assert person.act.full_scales == {AZ: 1.0, EL: 0.95}
    assert any("azimuth knob reads 0.100: not its maximum" in note for note in person.act.notes)


def test_a_knob_is_read_when_it_can_be() -> None:
    person = Person()
    person.sees(calibrate=True, azimuth_knob=None, elevation_knob=None)
    assert person.act.full_scales is None
    person.sees(azimuth_knob=0.9)
    assert person.act.full_scales == {AZ: 0.9, EL: 1.0}


def test_while_calibrating_switches_and_knobs_move_nothing() -> None:
    person = Person()
    person.sees(calibrate=True)
    assert person.waits(3.0, jog=CW, azimuth_knob=0.5) == []


def test_a_full_scale_that_was_kept_makes_the_knob_s_end_the_axis_s_end() -> None:
    person = Person(Panel(PanelSettings(), {AZ: 0.8}))
    person.waits(2.0, mode_bits=MANUAL)
    assert person.waits(2.0, azimuth_knob=0.8) == [Aim(about(360.0), None, place=True)]
    assert person.waits(2.0, azimuth_knob=0.9) == []  # it cannot be further than at its end
