"""The check of the saved counts: the file as the box leaves it."""

from __future__ import annotations

from hw.ports import Axis
from rotator.store.counts import CountsFile
from tests.doctor.conftest import Pi, hold

# --- lines at the start


# --- counts: the file as the box leaves it


def counts_file(pi: Pi) -> CountsFile:
    cams = pi.config.kind.cams(Axis)
    return CountsFile(pi.machine.at("/var/lib/rotator/counts.json"), cams)


def test_axes_never_homed_at_rest_and_in_mid_move(pi: Pi) -> None:
    pi.kind("relay-pulse")
    assert [finding.ok for finding in pi.found("counts")] == [False, False]
    assert pi.found("counts")[0].advice.startswith("rotator home azimuth")
    file = counts_file(pi)
    file.home(Axis.AZIMUTH, 123.0)
    file.home(Axis.ELEVATION, 10.0)
    assert pi.found("counts")[0].found == "azimuth: 123.0° on the rotor's scale, when the box ended"
    file.start(Axis.ELEVATION)
    azimuth, elevation = pi.found("counts")
    assert (azimuth.mark, elevation.ok) == ("✓", False)
    assert "the program ended in mid-move" in elevation.found


def test_a_count_on_another_cam_is_lost(pi: Pi) -> None:
    pi.kind("relay-pulse")
    counts_file(pi).home(Axis.AZIMUTH, 123.0)
    pi.kind("relay-pulse", "[pulses.azimuth]\nspacing_deg = 10\n")
    assert "or its contact or pulses.azimuth has changed" in pi.found("counts")[0].found


def test_by_time_alone_an_axis_that_does_not_know_its_place_goes_to_its_stop_by_itself(pi: Pi) -> None:
    pi.kind("relay-timed")
    finding = pi.found("counts")[0]
    assert finding.mark == "!"
    assert finding.found == "azimuth: its place is not known: it goes to its end stop before the first target"
    counts_file(pi).home(Axis.AZIMUTH, 123.0)
    assert pi.found("counts")[0].found == "azimuth: 123.0° on the rotor's scale, when the box ended"


def test_a_running_box_may_be_moving(pi: Pi) -> None:
    pi.kind("relay-pulse")
    file = counts_file(pi)
    file.home(Axis.AZIMUTH, 123.0)
    file.start(Axis.AZIMUTH)
    hold(pi, "rotator-azimuth", 16)
    azimuth, elevation = pi.found("counts")
    assert (azimuth.mark, elevation.ok) == ("–", False)


def test_a_slew_drive_is_told_where_it_stands_or_finds_its_switch(pi: Pi) -> None:
    pi.kind("h-bridge")
    assert pi.found("counts")[0].advice.startswith("rotator confirm azimuth DEGREES")
    home = '[bridge.azimuth]\nhome = "index"\nindex = 10\n'
    pi.kind("h-bridge", home)
    azimuth, elevation = pi.found("counts")
    assert azimuth.advice.startswith("rotator home azimuth")
    assert elevation.advice.startswith("rotator confirm elevation DEGREES")
    counts_file(pi).home(Axis.AZIMUTH, 123.0)
    pi.kind("h-bridge", f"{home}home_deg = -1\n")
    assert "or its encoder or bridge.azimuth has changed" in pi.found("counts")[0].found
