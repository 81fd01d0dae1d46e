"""What each check of lines, axes and chips tells of a healthy station, and of one thing that is damaged on it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import NoReturn

import pytest

from firmware_sim.buses.gpio import SimGpio
from hw.buses.i2c import open_bus
from hw.ports import HardwareError
from tests.doctor.conftest import STATION, Forbidden, Pi, hold, runs
from tests.doctor.rows import (
    AS5045,
    AS5600,
    BACKPACK,
    CONFIG_TXT,
    LS7366R,
    MCP3208,
    MODEL,
    MOTEUS_PANEL,
    NO_LCD,
    PANEL,
    PERSIST,
    SWITCHES,
    Listener,
    Row,
    another_chip,
    board,
    named,
    of,
)

LINES = [
    Row("GPIO chip", "✓ /dev/gpiochip0 →"),
    Row("GPIO chip", "→ Leave relays.chip out", more='[relays]\nchip = "/dev/gpiochip4"\n'),
    Row("GPIO lines", "✓ GPIO 22, 23, 24, 25, 17, 27, 5, 6, 12, 13: free →"),
    Row("GPIO lines", "✗ GPIO 23, relays.azimuth_ccw, is held by onewire@0 → Stop that program, or remove the overlay "
        "from config.txt; or move relays.azimuth_ccw to a free pin.\n✓ GPIO 22, 24,", held=("onewire@0", 23)),
    Row("GPIO lines", "✓ GPIO 22 held by the box: it is running → \n✓ GPIO 23,", held=("rotator-relays", 22)),
    Row("GPIO lines", "✓ GPIO 22, 23, 24, 25, 16, 26: free", more=f"[relays]\nmaster = 16\nheartbeat = 26\n{NO_LCD}"),
    Row("GPIO lines", "✗ GPIO 16, pulses.azimuth.contact, is held by onewire@0 → Stop that program, or remove the "
        "overlay from config.txt; or move pulses.azimuth.contact to a free pin.\n"
        "✓ GPIO 22, 23, 24, 25, 20, 10, 9, 19, 18: free", base=of("relay-pulse"),
        more=f"{SWITCHES}[pulses.azimuth]\nhome_deg = -3\n", held=("onewire@0", 16)),
    Row("GPIO lines", "✓ GPIO 8, 7, 11, 10, 16: free", base=of("digipot"), more="[digipot]\nenable = 16\n"),
    Row("GPIO lines", "✓ GPIO 16: free", base=of("digipot"),
        more='[digipot]\nspi = "kernel"\nenable = 16\n', held=("spi0 CS0", 8)),
    Row("released lines", "✓ the kernel lets a line go when its program dies →"),
    Row("released lines", "✗ strict_gpiod is in config.txt, and not yet in effect → sudo reboot",
        files={PERSIST: "Y\n"}),
    Row("released lines", "✗ the kernel keeps a relay on when the program dies: no dtparam=strict_gpiod → sudo rotator",
        files={PERSIST: "Y\n", CONFIG_TXT: "[pi5]\ndtparam=strict_gpiod\n[all]\n#dtparam=strict_gpiod\n"}),
    Row("released lines", "! this kernel does not say", files={MODEL: "Raspberry Pi 5 Model B Rev 1.0\0"}),
    Row("released lines", "✓ the kernel lets", files={MODEL: "Raspberry Pi 5 Model B Rev 1.0\0",
        "/sys/module/pinctrl_rp1/parameters/persist_gpio_outputs": "N\n"}),
    Row("released lines", "– not a Raspberry Pi", files={MODEL: None}),
    Row("boot pins", "– not a Raspberry Pi", files={MODEL: None}),
    Row("boot pins", "✓ GPIO 22, 23, 24, 25 driven low, off, a few seconds after power-on →"),
    Row("boot pins", "! GPIO 22, 23, 24, 25: off at the start by a weak pull only → sudo rotator setup pins",
        files={CONFIG_TXT: "dtparam=i2c_arm=on\n"}),
    # GPIO 0 to 8 are pulled up at power-on
    Row("boot pins", "✗ GPIO 4: pulled high at the start, which closes the relay → sudo rotator setup pins, then "
        "reboot.\n✓ GPIO", more=f"[relays]\nazimuth_cw = 4\n{NO_LCD}"),
    Row("boot pins", "✗ config.txt drives GPIO 22 low at the start, which switches relays.azimuth_cw on",
        more='[relays]\nactive = "low"\n'),
    Row("boot pins", "✓ GPIO 22, 23, 24, 25 driven high, off", more='[relays]\nactive = "low"\n',
        files={CONFIG_TXT: "gpio=22,23,24,25=op,dh\n"}),
    Row("boot pins", "✓ GPIO 22,", files={CONFIG_TXT: "gpio=22,23=op,dl\r\ngpio=24-25=op,dl\r\n"}),
    Row("boot pins", "✓ GPIO 22,", files={CONFIG_TXT: "[pi4]\ngpio=22-25=op,dl\n"}),
    Row("boot pins", "! GPIO 22,", files={CONFIG_TXT: "[pi5]\ngpio=22-25=op,dl\n"}),
    Row("boot pins", "✓ GPIO 22,", files={CONFIG_TXT: "[cm4]\n[all]\ngpio=22-25=op,dl\n"}),
    Row("boot pins", "! GPIO 22,", files={CONFIG_TXT: "gpio=22-25=op,dl\ngpio=22-25=ip,pd\n"}),
    Row("boot pins", "✓ GPIO 22,", files={CONFIG_TXT: "gpio=22-25=op,dh\ngpio=22-25=dl\n"}),
    Row("boot pins", "! GPIO 22,", files={CONFIG_TXT: "gpio=nonsense=op,dl\n"}),
    Row("boot pins", "✓ GPIO 22,", files={CONFIG_TXT: None, "/boot/config.txt": "gpio=22-25=op,dl\n"}),
    # The relay of control boxes is off when low; a servo board's OE, which has a pull-up of its own, when high.
    Row("boot pins", "! GPIO 16:", base=of("digipot"), more="[digipot]\nenable = 16\n"),
    Row("boot pins", "✓ GPIO 16 driven low, off", base=of("digipot"), more="[digipot]\nenable = 16\n",
        files={CONFIG_TXT: "gpio=16=op,dl\n"}),
    Row("boot pins", "✗ config.txt drives GPIO 16 high at the start, which switches digipot.enable on",
        base=of("digipot"), more="[digipot]\nenable = 16\n", files={CONFIG_TXT: "gpio=16=op,dh\n"}),
    Row("boot pins", "! GPIO 26:", base=of("servo"), more="[servo]\nenable = 26\n"),
    Row("boot pins", "✓ GPIO 26 driven high, off", base=of("servo"), more="[servo]\nenable = 26\n",
        files={CONFIG_TXT: "gpio=26=op,dh\n"}),
]  # fmt: skip
AXES = [
    Row("axes", "✓ azimuth: 0° to 450°, calibrated, direction checked → \n✓ elevation"),
    Row("axes", "it lacks calibration → Run rotator calibrate elevation",
        base=STATION.replace("calibration = [[0.05, 0], [0.95, 180]]\n", "")),
    Row("axes", "\n✗ elevation is not set up, and obeys short presses only: it lacks limits →",
        base=STATION.replace("max_deg = 180\n", "")),
    Row("axes", "it lacks direction check →", base=STATION.replace("direction_checked = true\n[state]", "[state]")),
    Row("axes", "✓ azimuth: 0° to 180°, counted, direction checked", base=of("relay-pulse")),
    Row("axes", "✓ azimuth: 0° to 180°, told by its controller, direction checked", base=of("moteus")),
    Row("axes", "✓ azimuth: 0° to 180°, modelled, direction checked", base=of("servo")),
    Row("axes", "it lacks direction check → Run rotator calibrate elevation --config FILE; or write "
        "elevation.direction_checked yourself.",
        base=of("digipot").replace("direction_checked = true\n[state]", "[state]")),
    Row("counts", "cannot be believed: its format is not 'rotator counts 1'", base=of("relay-pulse"),
        files={"/var/lib/rotator/counts.json": "{}"}),
]  # fmt: skip
CHIPS = [
    Row("I2C bus", "✓ /dev/i2c-1 →"),
    Row("I2C devices", "✓ adc: 0x48 answers →"),
    Row("I2C devices", "✗ adc: 0x48 does not answer, nor does any other usual address → Check its power, SDA and SCL",
        broken="adc-gone"),
    Row("I2C devices", "✓ elevation.sensor: 0x68 answers → \n✓ servo: 0x40 answers → \n✓ panel.adc: 0x49 answers → \n"
        "✓ panel.outputs: 0x41 answers → \n✓ compass: 0x28 answers →", base=of("servo"),
        more='[elevation.sensor]\nkind = "mpu6050"\n[panel]\nazimuth_meter = 0\njog = 2\n'
        '[compass]\nkind = "bno055"\nbus = 1\n'),
    Row("pots", "✓ azimuth: 0.230 of the supply, 0.76 V on A0 → \n✓ elevation: 0.275 of the supply"),
    Row("pots", "– the converter does not answer", broken="adc-gone"),
    Row("pots", "of the supply, 0.00 V on A0, outside 0.02 to 0.98 → Wiper or supply lead broken",
        broken="azimuth-pot-open"),
    Row("pots", "→ The pot's ground lead is broken, or its wiper is shorted to the supply.",
        broken="elevation-pot-shorted"),
    Row("pots", "✗ azimuth: unsteady", broken="azimuth-pot-loose"),
    Row("pots", "outside 0.3 to 0.98 → If the antenna stands at an end: fit end resistors (rotator help wiring), or "
        "widen azimuth.lowest_reading", base=STATION.replace("[elevation]", "lowest_reading = 0.3\n[elevation]")),
    Row("pots", "✓ azimuth: 0.230 of the supply, 0.76 V on CH0", more=MCP3208),
    Row("pots", "✓ azimuth: 0.230 of the supply, 0.76 V on CH0", more=f'{MCP3208}spi = "kernel"\n'),
    Row("pots", "✗ the converter does not answer → ", more=MCP3208, broken="adc-gone"),
    Row("pots", "– the box is running", is_running=True),
    Row("sensors", "– the box is running", base=AS5600, is_running=True),
    Row("sensors", "✓ azimuth: AS5600 at 0x36, its magnet is good, 0.250 of a turn →", base=AS5600),
    Row("sensors", "✗ azimuth: AS5600 at 0x36: there is no magnet → Put one over the middle of the chip, 0.5 to 3 mm "
        "away.", base=AS5600, broken="azimuth-magnet-missing"),
    Row("sensors", "→ Here its reading jumps: put azimuth.sensor.zero_turn outside",
        base=AS5600.replace('"as5600"', '"as5600"\nzero_turn = 0.25')),
    Row("sensors", "– azimuth: AS5600 does not answer", base=AS5600, broken="azimuth-as5600-gone"),
    Row("sensors", "✓ azimuth: AS5045, its magnet is good, 0.250 of a turn →", base=AS5045),
    Row("sensors", "✗ azimuth: AS5045: the magnet is missing, too far, too near", base=AS5045,
        broken="azimuth-magnet-weak"),
    Row("sensors", "✗ azimuth: AS5045: does not answer → Look at its supply, and at the wires of select", base=AS5045,
        broken="azimuth-as5045-gone"),
    Row("sensors", "✓ azimuth: MT6701 at 0x06, it tells nothing of its magnet, 0.250 of a turn →",
        base=AS5600.replace('"as5600"', '"mt6701"')),
    Row("sensors", "✓ azimuth: LS7366R answers, its count is no place yet", base=of("h-bridge"), more=LS7366R),
    Row("sensors", "✗ azimuth: LS7366R (azimuth.select): does not answer", base=of("h-bridge"), more=LS7366R,
        broken="azimuth-counter-gone"),
    Row("SPI", "✗ /dev/spidev0.0 is not there → sudo rotator setup pins", base=AS5045),
    Row("I2C devices", "✗ azimuth.sensor: 0x36", base=AS5600, broken="azimuth-as5600-gone"),
    Row("sensors", "✓ elevation: MPU6050 at 0x68 feels 1 g, 4", base=of("servo"),
        more='[elevation.sensor]\nkind = "mpu6050"\n'),
    Row("sensors", "✓ elevation: ADXL345 at 0x53 feels 1 g, ", base=of("servo"),
        more='[elevation.sensor]\nkind = "adxl345"\n'),
    Row("sensors", "✓ azimuth: LSM303DLHC at 0x1e feels ", base=of("relay-timed"),
        more='[azimuth.sensor]\nkind = "lsm303-mag"\nradius_ut = [20, 20]\n[mount]\nnorth = "magnetic"\n'
        "declination_deg = 4\n"),
    Row("sensors", "°, not calibrated → Run rotator calibrate compass", base=of("relay-timed"),
        more='[azimuth.sensor]\nkind = "qmc5883l"\n[mount]\nnorth = "magnetic"\ndeclination_deg = 4\n'),
    Row("axes", "its compass has not learnt the iron around it → Run rotator calibrate compass --config FILE",
        base=of("relay-timed"),
        more='[azimuth.sensor]\nkind = "qmc5883l"\n[mount]\nnorth = "magnetic"\ndeclination_deg = 4\n'),
    Row("sensors", "the field is above 200 µT, four times the earth's → A magnet or a motor is too near.",
        base=of("relay-timed"), broken="azimuth-magnet-near",
        more='[azimuth.sensor]\nkind = "qmc5883l"\n[mount]\nnorth = "magnetic"\ndeclination_deg = 4\n'),
    Row("sensors", "° magnetic, magnetometer calibrated 0 of 3 →", base=of("moteus"), more=MOTEUS_PANEL),
    Row("sensors", "! compass: BNO055 at 0x28", base=of("moteus"), more=f"{MOTEUS_PANEL}bus = 1\n"),
    Row("sensors", "✓ compass: BNO055", base=of("moteus"), more=f"{MOTEUS_PANEL}bus = 1\n",
        files={MODEL: "Raspberry Pi 5 Model B Rev 1.0\0"}),
    Row("PCA9685", "✓ servo: 0x40 is a PCA9685, asleep until the box starts →", base=of("servo")),
    Row("PCA9685", "✗ servo: 0x40 has been reset since the box started", base=of("servo"), is_running=True),
    Row("I2C devices", "✗ lcd: 0x27 does not answer, 0x3f does → lcd.address = 0x3f",
        more=f"{BACKPACK}address = 0x3f\n", reads=f"{BACKPACK}address = 0x27\n"),
    Row("I2C devices", "→ adc.address = 0x4a", more="[adc]\naddress = 0x4a\n", reads=""),
    Row("I2C devices", "→ servo.address = 0x43", base=of("servo"), more="[servo]\naddress = 0x43\n", reads=""),
    Row("PCA9685", "– servo: 0x40 does not answer", base=of("servo"), more="[servo]\naddress = 0x43\n", reads=""),
    Row("I2C devices", "✗ adc: I2C /dev/i2c-1: the bus hangs; something holds SDA or SCL low (address 0x48) → Unplug",
        spoil=lambda pi: pi.world.bus.hang(hang_timeout_s=0.01)),
    # The words of docs/troubleshooting.md.
    Row("pots", "→ The pot's supply is above adc.supply_v: is it 5 V? See: rotator help pots-on-5-v",
        more="[adc]\nsupply_v = 5.0\n[sim.azimuth]\nstart_deg = 440\n", reads=""),
    Row("pots", "✓ azimuth", more="[adc]\nreference_channel = 2\n"),
    Row("pots", "→ Wire the pots' supply to A3",
        more="[adc]\nreference_channel = 2\n", reads="[adc]\nreference_channel = 3\n"),
    Row("pots", "a conversion does not end → A sick chip, or not an ADS1115 at adc.address.", spoil=another_chip(0x48)),
    Row("pots", "– the box is running", spoil=lambda pi: runs(pi, "/var/lib/rotator/monitor")),
    Row("pots", "✓ azimuth", spoil=lambda pi: runs(pi, "/home/me/other/monitor")),
    Row("sensors", "the chip's identity is 0x00", base=of("servo"), more='[elevation.sensor]\nkind = "mpu6050"\n',
        spoil=another_chip(0x68)),
    Row("PCA9685", "still makes the pulses of the last run", base=of("servo"), spoil=board((0x00, 0x20))),
    Row("PCA9685", "✓ servo: 0x40 is a PCA9685, awake", base=of("servo"), is_running=True, spoil=board((0x00, 0x20))),
    Row("PCA9685", "waits for a clock from outside, and makes no pulse → A program has set it so; only switching its "
        "3.3 V off and on", base=of("servo"), spoil=board((0x00, 0x10), (0x00, 0x50))),
    Row("PCA9685", "✗ servo: 0x40 is no PCA9685: MODE1 0x00, PRE_SCALE 0x00", base=of("servo"),
        spoil=another_chip(0x40)),
    Row("SPI", "✗ /dev/spidev0.0 is not there → sudo rotator setup pins switches it on (dtparam=spi=on)",
        base=of("digipot"), more='[digipot]\nspi = "kernel"\n'),
    Row("SPI", "\n✓ /dev/spidev0.1 is there and may be opened", base=of("digipot"), more='[digipot]\nspi = "kernel"\n',
        files={"/dev/spidev0.0": "", "/dev/spidev0.1": ""}),
]  # fmt: skip


def turn_mode(position: int, pi: Pi) -> None:
    pi.world.panel.turn_mode(position)


SWITCHED = [
    Row("switches", "✓ the stop button is closed: nothing is stopped → \n✓ the mode switch is on AUTO: programs "
        "move the antenna → \n✓ limit switches: 2 closed, none reached", more=PANEL),
    *(
        Row("switches", f"✓ the mode switch is on {name}: ", more=PANEL,
            spoil=partial(turn_mode, position))
        for position, name in enumerate(("MANUAL", "PARK", "AUTO", "JOG"))
    ),
    Row("switches", "✗ the stop button is pressed, or its wire is broken: GPIO 19", more=PANEL,
        spoil=lambda pi: pi.world.panel.press_stop()),
    Row("switches", "! the calibrate switch is closed", more=PANEL,
        spoil=lambda pi: pi.world.panel.set_calibrate(closed=True)),
    Row("switches", "! limits.azimuth_low (GPIO 18) is open", more=PANEL, broken="azimuth-low-switch-open"),
    Row("switches", "✗ both limit switches of the azimuth are open", more=PANEL, broken="azimuth-low-switch-open",
        spoil=lambda pi: pi.world.inject("azimuth-high-switch-open")),
    Row("switches", "– the box is running", more=PANEL, held=("rotator-panel", 19)),
    Row("switches", "– cannot be read", more=PANEL, held=("onewire@0", 19)),
    Row("GPIO lines", "panel.stop, is held by onewire@0", more=PANEL, held=("onewire@0", 19)),
    # What was taken for a look is let go.
    Row("GPIO lines", "✓ GPIO 22, 23, 24, 25, 10, 9, 11, 19, 18, 8, 17, 27, 5, 6, 12, 13: free", more=PANEL,
        spoil=lambda pi: pi.found("switches")),
    Row("GPIO lines", "✓ GPIO 8, 11, 10, 9, 22, 23, 24, 25: free", more=f"{MCP3208}{NO_LCD}",
        spoil=lambda pi: pi.found("pots")),
]  # fmt: skip


@pytest.mark.parametrize("row", [*LINES, *AXES, *CHIPS, *SWITCHED], ids=named)
def test_what_is_found(pi: Pi, row: Row) -> None:
    row.judge(pi)


def unfitted() -> Iterator[tuple[str, str, str]]:
    for kind, more, checks in (
        ("moteus", "", "GPIO chip, GPIO lines, I2C bus, I2C devices, pots"),
        ("servo", "[servo]\nenable = 26\n", "released lines"),
        ("servo", "", "boot pins"),
        ("digipot", "", "SPI"),
    ):
        yield from ((kind, more, check) for check in checks.split(", "))
    yield from (("", "", check) for check in ("counts", "elements"))


@pytest.mark.parametrize(("kind", "more", "check"), list(unfitted()))
def test_what_a_station_has_not_is_not_looked_at(pi: Pi, kind: str, more: str, check: str) -> None:
    pi.station(more, base=of(kind) if kind else STATION)
    assert not pi.looks_at(check)


def test_while_the_box_is_running_nothing_is_written_to_its_converter(pi: Pi) -> None:
    converter = Listener()
    another_chip(0x48, converter)(pi)
    box = hold(pi, "rotator-relays", 22)
    assert pi.only("pots").mark == "–"
    assert pi.only("I2C devices").mark == "✓"
    chips = pi.machine.chips
    pi.change(chips=replace(chips, gpio=Forbidden))  # nobody can tell whether the box runs
    assert pi.only("pots").mark == "–"
    assert converter.written == []
    pi.change(chips=chips)
    box.close()
    pi.found("pots")
    assert converter.written


def test_a_bus_that_is_switched_off(pi: Pi) -> None:
    missing = next(number for number in range(200, 256) if not os.path.exists(f"/dev/i2c-{number}"))
    pi.station(f"[adc]\nbus = {missing}\n")
    pi.change(chips=replace(pi.machine.chips, open_bus=open_bus))
    finding = pi.only("I2C bus")
    assert finding.ok is False
    assert "sudo rotator setup pins" in finding.advice
    assert pi.only("I2C devices").mark == "–"


def test_without_spidev(pi: Pi) -> None:
    def missing() -> NoReturn:
        raise HardwareError("SPI: the Python package spidev cannot be loaded")

    pi.kind("digipot", '[digipot]\nspi = "kernel"\n')
    pi.change(chips=replace(pi.machine.chips, spidev=missing))
    finding = pi.found("SPI")[0]
    assert finding.ok is False
    assert "pip install 'spidev>=3.6'" in finding.advice


def test_a_gpio_chip_that_is_not_yours(pi: Pi) -> None:
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
