"""The checks of the I2C bus, its devices and the pots: on simulated chips, healthy and damaged."""

from __future__ import annotations

import os
from dataclasses import replace

import pytest

from hw.buses.i2c import open_bus
from tests.doctor.conftest import STATION, Forbidden, Pi, hold

BACKPACK = '[lcd]\nkind = "pcf8574"\n'


# --- the bus


def test_a_bus_that_is_switched_off(pi: Pi) -> None:
    missing = next(number for number in range(200, 256) if not os.path.exists(f"/dev/i2c-{number}"))
    pi.station(f"[adc]\nbus = {missing}\n")
    pi.change(chips=replace(pi.machine.chips, open_bus=open_bus))
    finding = pi.only("I2C bus")
    assert finding.ok is False
    assert "sudo rotator setup pins" in finding.advice
    assert pi.only("I2C devices").mark == "–"


def test_a_display_on_the_other_usual_address(pi: Pi) -> None:
    pi.station(f"{BACKPACK}address = 0x3f\n")
    pi.config = pi.config.model_copy(update={"lcd": pi.config.lcd.model_copy(update={"address": 0x27})})
    adc, lcd = pi.found("I2C devices")
    assert adc.mark == "✓"
    assert (lcd.ok, lcd.found) == (False, "lcd: 0x27 does not answer, 0x3f does")
    assert lcd.advice == "lcd.address = 0x3f"


def test_a_converter_on_another_address(pi: Pi) -> None:
    pi.station("[adc]\naddress = 0x4a\n")
    pi.config = pi.config.model_copy(update={"adc": pi.config.adc.model_copy(update={"address": 0x48})})
    assert pi.only("I2C devices").advice == "adc.address = 0x4a"


def test_a_device_that_is_nowhere(pi: Pi) -> None:
    pi.world.inject("adc-gone")
    finding = pi.only("I2C devices")
    assert finding.ok is False
    assert "SDA and SCL" in finding.advice
    assert pi.only("pots").mark == "–"


def test_a_bus_that_hangs(pi: Pi) -> None:
    pi.world.bus.hang(hang_timeout_s=0.01)
    finding = pi.only("I2C devices")
    assert finding.ok is False
    assert "the bus hangs" in finding.found
    assert "Unplug" in finding.advice


def test_a_converter_that_never_ends_its_conversion(pi: Pi) -> None:
    pi.world.bus.detach(0x48)
    pi.world.bus.attach(0x48, Listener())
    finding = pi.only("pots")
    assert finding.ok is False
    assert "a conversion does not end" in finding.found
    assert "adc.address" in finding.advice


# --- the pots; the words are those of docs/troubleshooting.md


def test_pots_within_their_window(pi: Pi) -> None:
    azimuth, elevation = pi.found("pots")
    assert (azimuth.mark, azimuth.found) == ("✓", "azimuth: 0.230 of the supply, 0.76 V on A0")
    assert elevation.found.startswith("elevation: 0.275 of the supply")


@pytest.mark.parametrize(
    ("fault", "words", "advice"),
    [
        ("azimuth-pot-open", "azimuth: ", "Wiper or supply lead broken"),
        ("elevation-pot-shorted", "elevation: ", "wiper is shorted to the supply"),
        ("azimuth-pot-loose", "azimuth: unsteady", "loose wire"),
    ],
)
def test_a_damaged_pot(pi: Pi, fault: str, words: str, advice: str) -> None:
    pi.world.inject(fault)
    wrong = [finding for finding in pi.found("pots") if finding.ok is False]
    assert len(wrong) == 1
    assert wrong[0].found.startswith(words)
    assert advice in wrong[0].advice


def test_a_pot_on_5_v(pi: Pi) -> None:
    pi.station("[adc]\nsupply_v = 5.0\n[sim.azimuth]\nstart_deg = 440\n")
    pi.config = pi.config.model_copy(update={"adc": pi.config.adc.model_copy(update={"supply_v": 3.3})})
    azimuth, _ = pi.found("pots")
    assert azimuth.ok is False
    assert "pots-on-5-v" in azimuth.advice


def test_a_reading_just_outside_its_window(pi: Pi) -> None:
    narrow = STATION.replace("[elevation]", "lowest_reading = 0.3\n[elevation]")
    pi.station("", base=narrow)
    azimuth, _ = pi.found("pots")
    assert azimuth.ok is False
    assert "outside 0.3 to 0.98" in azimuth.found
    assert "azimuth.lowest_reading" in azimuth.advice


def test_a_reference_that_is_not_wired(pi: Pi) -> None:
    pi.station("[adc]\nreference_channel = 2\n")
    assert {finding.mark for finding in pi.found("pots")} == {"✓"}
    pi.config = pi.config.model_copy(update={"adc": pi.config.adc.model_copy(update={"reference_channel": 3})})
    finding = pi.only("pots")
    assert finding.ok is False
    assert "A3" in finding.advice


class Listener:
    """A chip that keeps what is written to it."""

    def __init__(self) -> None:
        self.written: list[bytes] = []

    def write(self, data: bytes) -> None:
        self.written.append(data)

    def read(self, count: int) -> bytes:
        return bytes(count)


def test_while_the_box_is_running_nothing_is_written_to_its_converter(pi: Pi) -> None:
    converter = Listener()
    pi.world.bus.detach(0x48)
    pi.world.bus.attach(0x48, converter)
    box = hold(pi, "rotator-relays", 22)
    assert pi.only("pots").mark == "–"
    assert "running" in pi.only("pots").found
    assert pi.only("I2C devices").mark == "✓"
    assert converter.written == []
    box.close()
    pi.found("pots")
    assert converter.written


def test_where_nobody_can_tell_whether_the_box_runs_no_pot_is_read(pi: Pi) -> None:
    converter = Listener()
    pi.world.bus.detach(0x48)
    pi.world.bus.attach(0x48, converter)
    pi.change(chips=replace(pi.machine.chips, gpio=Forbidden))
    assert pi.only("pots").mark == "–"
    assert converter.written == []


# --- an MCP3208 in place of the ADS1115


MCP3208 = '[adc]\nkind = "mcp3208"\n'


@pytest.mark.parametrize("more", ["", 'spi = "kernel"\n'], ids=["lines", "kernel"])
def test_pots_on_an_mcp3208(pi: Pi, more: str) -> None:
    pi.station(MCP3208 + more)
    azimuth, elevation = pi.found("pots")
    assert (azimuth.mark, azimuth.found) == ("✓", "azimuth: 0.230 of the supply, 0.76 V on CH0")
    assert elevation.found.startswith("elevation: 0.275 of the supply")
    assert not any(chip.key == "adc.address" for chip in pi.config.chips())
    assert pi.looks_at("SPI") is bool(more)


def test_an_mcp3208_that_is_not_there(pi: Pi) -> None:
    pi.station(MCP3208)
    pi.world.inject("adc-gone")
    finding = pi.only("pots")
    assert (finding.ok, finding.found) == (False, "the converter does not answer")
    assert "DOUT" in finding.advice


def test_after_the_look_its_lines_are_free_again(pi: Pi) -> None:
    pi.station(MCP3208)
    pi.found("pots")
    assert all("free" in finding.found for finding in pi.found("GPIO lines"))
