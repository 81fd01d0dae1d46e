"""An azimuth rotor alone on the Pi, such as a Yaesu G-450: beside the switches and the meter of its control box."""

from __future__ import annotations

from docs.drawings.figures import DIVIDER_LOWER_OHM, DIVIDER_UPPER_OHM
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, contact, header_labels, pi_header, resistor
from docs.drawings.sheet import BLACK, BLUE, GREEN, ORANGE, RED, TEAL, Sheet
from rotator.config.model import Config

METER, RIGHT, LEFT, COMMON = "meter +", "switch RIGHT", "switch LEFT", "common of both"


def draw(config: Config) -> Sheet:
    relays, adc = config.relays, config.adc
    sheet = Sheet("wiring-g450", "An azimuth rotor alone, on a Raspberry Pi", 690)
    driven = {RIGHT: (relays.azimuth_cw, GREEN), LEFT: (relays.azimuth_ccw, TEAL)}
    used = header_labels([gpio for gpio, _ in driven.values()] + [SDA_GPIO, SCL_GPIO], [1, 2, 6])
    rows = [METER, "ground", "", "", "", "", "", "", RIGHT, LEFT, COMMON]
    sheet.put(
        chip("box", "Control box", (30, 70), 210, right=rows, lines=("of a G-450, G-650,", "G-1000 and others")),
        chip("adc", "ADS1115", (650, 110), 120, ["A0", "A1", "", "ADDR"], ["VDD", "SDA", "SCL", "GND"]),
        pi_header((880, 80), used, rows=(1, 12)),
    )
    y = sheet.pin(f"box.{METER}").at[1]
    sheet.put(
        resistor("upper", f"{DIVIDER_UPPER_OHM // 1000} kΩ", (330, y), flat=True, side=-1),
        resistor("lower", f"{DIVIDER_LOWER_OHM // 1000} kΩ", (460, y + 30)),
    )
    sheet.ground("lower.b", "box.ground")
    sheet.wire(BLUE, f"box.{METER}", "upper.a")
    sheet.wire(BLUE, "upper.b", f"adc.A{adc.azimuth_channel}", "lower.a")
    sheet.ground("adc.ADDR", "adc.GND", "pi.6")
    sheet.wire(ORANGE, "pi.1", "adc.VDD")
    sheet.wire(GREEN, f"pi.{GPIO_PINS[SDA_GPIO]}", "adc.SDA")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[SCL_GPIO]}", "adc.SCL")
    sheet.put(
        chip(
            "relays",
            "Relay board",
            (520, 390),
            230,
            ["K1 NO", "K2 NO", "", "COM, both"],
            ["VCC", "IN1", "IN2", "GND"],
            ["on at high"],
        ),
        contact("last", "heartbeat relay,\nor a plain wire", (360, 540), flat=True),
    )
    sheet.rail("5 V", RED, "relays.VCC", "pi.2")
    sheet.ground("relays.GND")
    sheet.relays({f"box.{switch}": wired for switch, wired in driven.items()})
    sheet.wire(BLACK, "last.b", "relays.COM, both")
    sheet.wire(BLACK, f"box.{COMMON}", "last.a")
    sheet.note(
        (30, 620),
        "Each contact is wired beside a switch of the control box, which goes on to work as before.",
        "4.5 V at the meter becomes 2.9 V at the converter. 100 nF from A0 to ground.",
    )
    return sheet
