"""The check of the saved counts: the file as the box leaves it."""

from __future__ import annotations

from hw.ports import Axis
from rotator.store.counts import CountsFile
from tests.doctor.conftest import Pi, hold

# --- lines at the start


# --- counts: the file as the box leaves it


def counts_file(pi: Pi) -> CountsFile:
    cams = pi.config.pulses.cams(Axis)
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


def test_a_running_box_may_be_moving(pi: Pi) -> None:
    pi.kind("relay-pulse")
    file = counts_file(pi)
    file.home(Axis.AZIMUTH, 123.0)
    file.start(Axis.AZIMUTH)
    hold(pi, "rotator-azimuth", 16)
    azimuth, elevation = pi.found("counts")
    assert (azimuth.mark, elevation.ok) == ("–", False)
