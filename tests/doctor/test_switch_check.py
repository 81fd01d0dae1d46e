"""The check of stop button, mode switch and limit switches: on simulated lines."""

from __future__ import annotations

import pytest

from tests.doctor.conftest import Pi, hold

PANEL = """
[panel]
mode_msb = 10
mode_lsb = 9
calibrate = 11
stop = 19
[limits]
azimuth_low = 18
azimuth_high = 8
"""


@pytest.fixture
def panel(pi: Pi) -> Pi:
    pi.station(PANEL)
    return pi


def test_switches_as_they_should_be(panel: Pi) -> None:
    assert [(finding.mark, finding.found) for finding in panel.found("switches")] == [
        ("✓", "the stop button is closed: nothing is stopped"),
        ("✓", "the mode switch is on AUTO: programs move the antenna"),
        ("✓", "limit switches: 2 closed, none reached"),
    ]


@pytest.mark.parametrize(("position", "name"), list(enumerate(("MANUAL", "PARK", "AUTO", "JOG"))))
def test_where_the_mode_switch_stands(panel: Pi, position: int, name: str) -> None:
    panel.world.panel.turn_mode(position)
    assert panel.found("switches")[1].found.startswith(f"the mode switch is on {name}: ")


def test_a_stop_button_that_is_pressed_or_whose_wire_is_broken(panel: Pi) -> None:
    panel.world.panel.press_stop()
    finding = panel.found("switches")[0]
    assert finding.ok is False
    assert "GPIO 19" in finding.found


def test_a_calibrate_switch_that_was_left_closed(panel: Pi) -> None:
    panel.world.panel.set_calibrate(closed=True)
    assert panel.found("switches")[2].mark == "!"


def test_limit_switches_that_are_open(panel: Pi) -> None:
    panel.world.inject("azimuth-low-switch-open")
    finding = panel.found("switches")[-1]
    assert (finding.mark, finding.found[:31]) == ("!", "limits.azimuth_low (GPIO 18) is")
    panel.world.inject("azimuth-high-switch-open")
    finding = panel.found("switches")[-1]
    assert finding.ok is False
    assert "both limit switches of the azimuth" in finding.found


def test_switches_of_a_running_box_are_not_taken(panel: Pi) -> None:
    hold(panel, "rotator-panel", 19)
    assert panel.only("switches").mark == "–"


def test_switches_that_another_program_holds_are_told_by_the_lines(panel: Pi) -> None:
    hold(panel, "onewire@0", 19)
    assert panel.only("switches").mark == "–"
    assert "panel.stop, is held by onewire@0" in panel.found("GPIO lines")[0].found


def test_what_was_taken_for_a_look_is_let_go(panel: Pi) -> None:
    panel.found("switches")
    assert panel.only("GPIO lines").found.endswith("free")
