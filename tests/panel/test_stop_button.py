"""The stop button of the front panel: it stops at once, latches, and nothing but the mode switch releases it there."""

from __future__ import annotations

from dataclasses import replace

from rotator.exchange.orders import Mode, Release, SetMode, Stop
from tests.panel.person import AUTO, AZ, CENTRE, CW, JOG, LATCHED, MANUAL, PARK, PLUS, STILL, Person, at_the_panel


def test_it_stops_at_once_and_nothing_else_is_ordered_while_it_is_open() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    assert person.sees(stop_open=True) == [Stop(latch=True)]
    person.status = LATCHED
    assert person.waits(2.0) == person.waits(2.0, jog=CENTRE) == person.waits(2.0, mode_bits=MANUAL) == []
    assert "stop" in person.lit()


def test_it_stops_again_whenever_it_opens() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(0.2, stop_open=False) == []
    assert person.sees(stop_open=True) == [Stop(latch=True)]


def test_closing_it_releases_nothing() -> None:
    person = at_the_panel(JOG)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(1.0, stop_open=False) == person.waits(1.0, jog=CW) == []
    assert "stop" in person.lit()


def test_it_counts_as_closed_after_50_ms() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    for _ in range(20):  # it bounces: all that is one opening
        assert person.sees(stop_open=False) == person.sees(stop_open=True) == []


def test_who_releases_it_elsewhere_while_it_is_open_is_stopped_again() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.sees() == []
    person.status = STILL
    assert person.sees() == [Stop(latch=True)]
    person.status = replace(LATCHED, azimuth=replace(STILL.azimuth, drive=PLUS))  # a storm park is latched, and moves
    assert person.sees() == [Stop(latch=True)]


def test_turning_the_mode_switch_releases() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    person.waits(0.2, stop_open=False)
    assert person.waits(1.5, mode_bits=PARK) == [Release(), SetMode(Mode.PARK)]


def test_a_mode_switch_turned_while_it_was_open_releases_nothing() -> None:
    person = at_the_panel(AUTO)
    person.sees(stop_open=True)
    person.status = LATCHED
    assert person.waits(2.0, mode_bits=PARK) == []
    assert person.waits(2.0, stop_open=False) == [SetMode(Mode.PARK)]
    assert person.waits(0.5, stop_open=True, mode_bits=JOG) == [Stop(latch=True)]
    assert person.waits(2.0, stop_open=False) == [SetMode(Mode.JOG)]  # begun while it was open


def test_open_at_power_up_it_stops() -> None:
    assert Person().sees(stop_open=True) == [Stop(latch=True)]


def test_a_jog_ends_when_the_box_is_stopped_elsewhere_and_does_not_begin_again_by_itself() -> None:
    person = at_the_panel(JOG)
    person.waits(0.5, jog=CW)
    person.status = LATCHED
    assert person.sees() == [Stop((AZ,))]
    person.status = STILL
    assert person.waits(2.0) == []
