"""What each check of lines, axes and chips tells of a healthy station, and of one thing that is damaged on it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from firmware_sim.buses.gpio import SimGpio
from tests.doctor.conftest import STATION, Forbidden, Pi
from tests.doctor.rows import (
    AS5600,
    CONFIG_TXT,
    MCP3208,
    MODEL,
    MOTEUS_PANEL,
    NO_LCD,
    PERSIST,
    SWITCHES,
    Row,
    named,
    of,
)

LINES = [
    Row("GPIO chip", "✓ /dev/gpiochip0 →"),
    Row("GPIO chip", "→ Leave relays.chip out", more='[relays]\nchip = "/dev/gpiochip4"\n'),
    Row("GPIO lines", "✓ GPIO 22, 23, 24, 25, 17, 27, 5, 6, 12, 13 free →"),
    Row("GPIO lines", "✗ GPIO 23, relays.azimuth_ccw, is held by onewire@0 → Stop that program, or remove the overlay "
        "from config.txt; or move relays.azimuth_ccw to a free pin.\n✓ GPIO 22, 24,", held=("onewire@0", 23)),
    Row("GPIO lines", "✓ GPIO 22 held by the box: it is running → \n✓ GPIO 23,", held=("rotator-relays", 22)),
    Row("GPIO lines", "✓ GPIO 22, 23, 24, 25, 16, 26 free", more=f"[relays]\nmaster = 16\nheartbeat = 26\n{NO_LCD}"),
    Row("GPIO lines", "✗ GPIO 16, pulses.azimuth.contact, is held by onewire@0", base=of("relay-pulse"),
        more=f"{SWITCHES}[pulses.azimuth]\nhome_deg = -3\n", held=("onewire@0", 16)),
    Row("GPIO lines", "\n✓ GPIO 22, 23, 24, 25, 20, 10, 9, 19, 18 free", base=of("relay-pulse"),
        more=f"{SWITCHES}[pulses.azimuth]\nhome_deg = -3\n", held=("onewire@0", 16)),
    Row("GPIO lines", "✓ GPIO 8, 7, 11, 10, 16 free", base=of("digipot"), more="[digipot]\nenable = 16\n"),
    Row("GPIO lines", "✓ GPIO 16 free", base=of("digipot"),
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
    Row("pots", "✗ azimuth: ", broken="azimuth-pot-open"),
    Row("pots", "→ Wiper or supply lead broken", broken="azimuth-pot-open"),
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
    Row("I2C devices", "✗ azimuth.sensor: 0x36", base=AS5600, broken="azimuth-as5600-gone"),
    Row("sensors", "✓ elevation: MPU6050 at 0x68 feels 1 g, 4", base=of("servo"),
        more='[elevation.sensor]\nkind = "mpu6050"\n'),
    Row("sensors", "° magnetic, magnetometer calibrated 0 of 3 →", base=of("moteus"), more=MOTEUS_PANEL),
    Row("sensors", "! compass: BNO055 at 0x28", base=of("moteus"), more=f"{MOTEUS_PANEL}bus = 1\n"),
    Row("sensors", "✓ compass: BNO055", base=of("moteus"), more=f"{MOTEUS_PANEL}bus = 1\n",
        files={MODEL: "Raspberry Pi 5 Model B Rev 1.0\0"}),
    Row("PCA9685", "✓ servo: 0x40 is a PCA9685, asleep until the box starts →", base=of("servo")),
    Row("PCA9685", "✗ servo: 0x40 has been reset since the box started", base=of("servo"), is_running=True),
    Row("SPI", "✗ /dev/spidev0.0 is not there → sudo rotator setup pins switches it on (dtparam=spi=on)",
        base=of("digipot"), more='[digipot]\nspi = "kernel"\n'),
    Row("SPI", "\n✓ /dev/spidev0.1 is there and may be opened", base=of("digipot"), more='[digipot]\nspi = "kernel"\n',
        files={"/dev/spidev0.0": "", "/dev/spidev0.1": ""}),
]  # fmt: skip


@pytest.mark.parametrize("row", [*LINES, *AXES, *CHIPS], ids=named)
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
