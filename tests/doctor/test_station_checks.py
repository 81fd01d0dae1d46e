"""The checks of the GPIO chip and its lines, held and let go: on simulated chips, and on boot files of a Pi."""

from __future__ import annotations

from dataclasses import replace

import pytest

from firmware_sim.buses.gpio import SimGpio
from tests.doctor.conftest import Forbidden, Pi, hold

CONFIG_TXT = "/boot/firmware/config.txt"


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("GPIO chip", ["/dev/gpiochip0"]),
        ("GPIO lines", ["GPIO 22, 23, 24, 25, 17, 27, 5, 6, 12, 13 free"]),
        ("I2C bus", ["/dev/i2c-1"]),
        ("I2C devices", ["adc: 0x48 answers"]),
        ("released lines", ["the kernel lets a line go when its program dies"]),
        ("boot pins", ["GPIO 22, 23, 24, 25 driven low, off, a few seconds after power-on"]),
    ],
)
def test_a_healthy_station(pi: Pi, name: str, found: list[str]) -> None:
    findings = pi.found(name)
    assert [finding.found for finding in findings] == found
    assert {finding.mark for finding in findings} == {"✓"}


# --- the GPIO chip


def test_a_chip_that_is_not_yours(pi: Pi) -> None:
    pi.change(chips=replace(pi.machine.chips, gpio=Forbidden))
    assert "sudo usermod -aG gpio pi" in pi.only("GPIO chip").advice
    assert pi.only("GPIO lines").mark == "–"


def test_a_pc_has_no_header(pi: Pi) -> None:
    gpio = SimGpio(lambda: 0.0, {"/dev/gpiochip0": "INTC1055:00"})
    pi.change(chips=replace(pi.machine.chips, gpio=lambda: gpio, paths=gpio.paths()))
    finding = pi.only("GPIO chip")
    assert finding.ok is False
    assert "/dev/gpiochip0 (INTC1055:00)" in finding.found
    assert "relays.chip" in finding.advice


def test_a_chip_named_in_the_file_that_is_not_there(pi: Pi) -> None:
    pi.station('[relays]\nchip = "/dev/gpiochip4"\n')
    finding = pi.only("GPIO chip")
    assert finding.ok is False
    assert "Leave relays.chip out" in finding.advice


# --- the lines


def test_a_line_that_somebody_else_holds_is_told_with_its_owner(pi: Pi) -> None:
    hold(pi, "onewire@0", 23)
    taken, free = pi.found("GPIO lines")
    assert (taken.ok, taken.found) == (False, "GPIO 23, relays.azimuth_ccw, is held by onewire@0")
    assert "relays.azimuth_ccw" in taken.advice
    assert "23" not in free.found


def test_the_lines_of_the_running_box_are_no_fault(pi: Pi) -> None:
    hold(pi, "rotator-relays", 22)
    ours, free = pi.found("GPIO lines")
    assert (ours.mark, ours.found) == ("✓", "GPIO 22 held by the box: it is running")
    assert free.mark == "✓"


def test_master_and_heartbeat_are_looked_at_too(pi: Pi) -> None:
    pi.station("[relays]\nmaster = 16\nheartbeat = 26\n[lcd]\nkind = 'none'\n")
    assert pi.only("GPIO lines").found == "GPIO 22, 23, 24, 25, 16, 26 free"


# --- lines that nobody holds


def test_a_kernel_that_keeps_outputs(pi: Pi) -> None:
    pi.write("/sys/module/pinctrl_bcm2835/parameters/persist_gpio_outputs", "Y\n")
    assert pi.only("released lines").advice == "sudo reboot"
    pi.write(CONFIG_TXT, "[pi5]\ndtparam=strict_gpiod\n[all]\n#dtparam=strict_gpiod\n")
    finding = pi.only("released lines")
    assert finding.ok is False
    assert "sudo rotator setup pins" in finding.advice


def test_a_pi_5_has_another_driver(pi: Pi) -> None:
    pi.write("/proc/device-tree/model", "Raspberry Pi 5 Model B Rev 1.0\0")
    assert pi.only("released lines").mark == "!"
    pi.write("/sys/module/pinctrl_rp1/parameters/persist_gpio_outputs", "N\n")
    assert pi.only("released lines").mark == "✓"


def test_lines_off_at_the_start_by_their_pull_only(pi: Pi) -> None:
    pi.write(CONFIG_TXT, "dtparam=i2c_arm=on\n")
    finding = pi.only("boot pins")
    assert finding.mark == "!"
    assert "sudo rotator setup pins" in finding.advice


def test_lines_that_are_on_at_the_start_by_their_pull(pi: Pi) -> None:
    # GPIO 0 to 8 are pulled up at power-on
    pi.station("[relays]\nazimuth_cw = 4\n[lcd]\nkind = 'none'\n")
    risky, good = pi.found("boot pins")
    assert (risky.ok, good.mark) == (False, "✓")
    assert risky.found.startswith("GPIO 4: pulled high at the start")


def test_active_low_relays_on_pins_that_are_pulled_down(pi: Pi) -> None:
    pi.station('[relays]\nactive = "low"\n')
    driven = pi.found("boot pins")
    assert [finding.ok for finding in driven] == [False] * 4
    assert driven[0].found == "config.txt drives GPIO 22 low at the start, which switches relays.azimuth_cw on"
    pi.write(CONFIG_TXT, "gpio=22,23,24,25=op,dh\n")
    assert pi.only("boot pins").mark == "✓"


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("gpio=22,23=op,dl\r\ngpio=24-25=op,dl\r\n", "✓"),
        ("[pi4]\ngpio=22-25=op,dl\n", "✓"),
        ("[pi5]\ngpio=22-25=op,dl\n", "!"),
        ("[cm4]\n[all]\ngpio=22-25=op,dl\n", "✓"),
        ("gpio=22-25=op,dl\ngpio=22-25=ip,pd\n", "!"),
        ("gpio=22-25=op,dh\ngpio=22-25=dl\n", "✓"),
        ("gpio=nonsense=op,dl\n", "!"),
    ],
)
def test_config_txt_as_the_firmware_reads_it(pi: Pi, text: str, mark: str) -> None:
    pi.write(CONFIG_TXT, text)
    assert pi.only("boot pins").mark == mark


def test_the_place_of_config_txt_before_debian_12(pi: Pi) -> None:
    pi.remove(CONFIG_TXT)
    pi.write("/boot/config.txt", "gpio=22-25=op,dl\n")
    assert pi.only("boot pins").mark == "✓"


@pytest.mark.parametrize("name", ["released lines", "boot pins"])
def test_a_pc_has_no_boot_pins(pi: Pi, name: str) -> None:
    pi.remove("/proc/device-tree/model")
    assert (pi.only(name).mark, pi.only(name).found) == ("–", "not a Raspberry Pi")
