"""The checks of the I2C bus, its devices and the pots: on simulated chips, healthy and damaged."""

from __future__ import annotations

import os
from dataclasses import replace

from hw.buses.i2c import open_bus
from tests.doctor.conftest import Forbidden, Pi, hold

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


def test_a_pot_on_5_v(pi: Pi) -> None:
    pi.station("[adc]\nsupply_v = 5.0\n[sim.azimuth]\nstart_deg = 440\n")
    pi.config = pi.config.model_copy(update={"adc": pi.config.adc.model_copy(update={"supply_v": 3.3})})
    azimuth, _ = pi.found("pots")
    assert azimuth.ok is False
    assert "pots-on-5-v" in azimuth.advice


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


def test_after_the_look_its_lines_are_free_again(pi: Pi) -> None:
    pi.station(MCP3208)
    pi.found("pots")
    assert all("free" in finding.found for finding in pi.found("GPIO lines"))
