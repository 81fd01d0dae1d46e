"""The checks of lines, axes and counts of every kind of rotor: on simulated chips, and on the files of a Pi."""

from __future__ import annotations

import pytest

from hw.ports import Axis
from rotator.store.counts import CountsFile
from tests.doctor.conftest import STATION_OF, Pi, hold

SWITCHES = """
[panel]
mode_msb = 10
mode_lsb = 9
stop = 19
[limits]
azimuth_low = 18
"""


# --- lines


def test_inputs_are_looked_at_as_well(pi: Pi) -> None:
    pi.kind("relay-pulse", SWITCHES + "[pulses.azimuth]\nhome_deg = -3\n")
    hold(pi, "onewire@0", 16)
    taken, free = pi.found("GPIO lines")
    assert taken.found == "GPIO 16, pulses.azimuth.contact, is held by onewire@0"
    assert free.found == "GPIO 22, 23, 24, 25, 20, 10, 9, 19, 18 free"


def test_digital_pots_on_lines_and_on_the_kernels_spi(pi: Pi) -> None:
    pi.kind("digipot", "[digipot]\nenable = 16\n")
    assert pi.only("GPIO lines").found == "GPIO 8, 7, 11, 10, 16 free"
    pi.kind("digipot", '[digipot]\nspi = "kernel"\nenable = 16\n')
    hold(pi, "spi0 CS0", 8)
    assert pi.only("GPIO lines").found == "GPIO 16 free"


def test_two_moteus_take_no_line_and_no_bus(pi: Pi) -> None:
    pi.kind("moteus")
    assert not any(pi.looks_at(name) for name in ("GPIO chip", "GPIO lines", "I2C bus", "I2C devices", "pots"))
    assert pi.only("groups").found == "pi is in dialout"


def test_groups_are_those_that_are_needed(pi: Pi) -> None:
    pi.kind("digipot", '[digipot]\nspi = "kernel"\nenable = 16\n')
    assert pi.only("groups").found == "pi is in gpio, spi"
    pi.kind("servo")
    assert pi.only("groups").found == "pi is in i2c"


# --- lines at the start


def test_the_relay_of_control_boxes_is_off_at_the_start_when_low(pi: Pi) -> None:
    pi.kind("digipot", "[digipot]\nenable = 16\n")
    assert pi.only("boot pins").mark == "!"
    pi.write("/boot/firmware/config.txt", "gpio=16=op,dl\n")
    assert pi.only("boot pins").found == "GPIO 16 driven low, off, a few seconds after power-on"
    pi.write("/boot/firmware/config.txt", "gpio=16=op,dh\n")
    assert pi.only("boot pins").found == "config.txt drives GPIO 16 high at the start, which switches digipot.enable on"


def test_the_enable_input_of_a_servo_board_is_off_at_the_start_when_high(pi: Pi) -> None:
    # OE has a pull-up of its own: the Pi's pull does not matter
    pi.kind("servo", "[servo]\nenable = 26\n")
    assert pi.only("boot pins").mark == "!"
    pi.write("/boot/firmware/config.txt", "gpio=26=op,dh\n")
    assert pi.only("boot pins").found == "GPIO 26 driven high, off, a few seconds after power-on"
    assert not pi.looks_at("released lines")


def test_a_servo_board_without_an_enable_line_has_nothing_to_be_off(pi: Pi) -> None:
    pi.kind("servo")
    assert not pi.looks_at("boot pins")


# --- axes


@pytest.mark.parametrize(
    ("kind", "how"),
    [
        ("relay-pulse", "counted"),
        ("moteus", "told by its controller"),
        ("servo", "modelled"),
        ("digipot", "modelled"),
    ],
)
def test_an_axis_that_needs_no_calibration(pi: Pi, kind: str, how: str) -> None:
    pi.kind(kind)
    azimuth, elevation = pi.found("axes")
    assert (azimuth.mark, azimuth.found) == ("✓", f"azimuth: 0° to 180°, {how}, direction checked")
    pi.station("", base=STATION_OF.format(kind).replace("direction_checked = true\n[state]", "[state]"))
    elevation = pi.found("axes")[1]
    assert elevation.found.endswith("it lacks direction check")
    assert "calibration" not in elevation.advice


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


def test_a_file_that_is_not_the_boxs(pi: Pi) -> None:
    pi.kind("relay-pulse")
    pi.write("/var/lib/rotator/counts.json", "{}")
    assert "cannot be believed: its format is not 'rotator counts 1'" in pi.only("counts").found


def test_pots_keep_no_counts(pi: Pi) -> None:
    assert not pi.looks_at("counts")
