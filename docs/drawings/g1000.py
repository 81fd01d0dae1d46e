"""An azimuth rotor with a speed input on the Pi, such as a Yaesu G-1000: at its socket EXT CONTROL."""

from __future__ import annotations

from docs.drawings.figures import DIVIDER_LOWER_OHM, DIVIDER_UPPER_OHM
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, contact, header_labels, pi_header, resistor
from docs.drawings.sheet import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

ANGLE, SPEED, RIGHT, LEFT = "angle, 0–4.5 V", "speed, 0–5 V", "right", "left"
COMMON = "ground, for both"


def draw(config: Config) -> Sheet:
    relays, adc = config.relays, config.adc
    sheet = Sheet("wiring-g1000", "An azimuth rotor with a speed input, on a Raspberry Pi", 930)
    driven = {RIGHT: (relays.azimuth_cw, GREEN), LEFT: (relays.azimuth_ccw, TEAL)}
    used = header_labels([gpio for gpio, _ in driven.values()] + [SDA_GPIO, SCL_GPIO], [1, 2, 6])
    rows = [ANGLE, "ground", *[""] * 7, SPEED, *[""] * 5, RIGHT, LEFT, COMMON]
    sheet.put(
        chip("box", "EXT CONTROL", (30, 70), 190, right=rows, lines=("of a G-800, G-1000,", "G-2800")),
        chip("adc", "ADS1115", (650, 110), 120, ["A0", "A1", "", "ADDR"], ["VDD", "SDA", "SCL", "GND"]),
        chip("dac", "MCP4725", (650, 350), 120, ["OUT", "", "A0"], ["VCC", "SDA", "SCL", "GND"]),
        pi_header((900, 80), used, rows=(1, 12)),
    )
    y = sheet.pin(f"box.{ANGLE}").at[1]
    sheet.put(
        resistor("upper", f"{DIVIDER_UPPER_OHM // 1000} kΩ", (330, y), flat=True, side=-1),
        resistor("lower", f"{DIVIDER_LOWER_OHM // 1000} kΩ", (460, y + 30)),
    )
    sheet.ground("lower.b", "box.ground")
    sheet.wire(BLUE, f"box.{ANGLE}", "upper.a")
    sheet.wire(BLUE, "upper.b", f"adc.A{adc.azimuth_channel}", "lower.a")
    sheet.ground("adc.ADDR", "adc.GND", "dac.GND", "dac.A0", "pi.6")
    sheet.wire(ORANGE, "pi.1", "adc.VDD", "dac.VCC")
    sheet.wire(GREEN, f"pi.{GPIO_PINS[SDA_GPIO]}", "adc.SDA", "dac.SDA")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[SCL_GPIO]}", "adc.SCL", "dac.SCL")
    y = sheet.pin(f"box.{SPEED}").at[1]
    lines = ("10 kΩ: − to ground,", "5.1 kΩ: OUT to −")
    sheet.put(
        resistor("series", "1 kΩ", (270, y), flat=True, side=-1),
        chip("amp", "½ MCP6002", (370, y - 90), 200, ["OUT", "", "VDD"], ["+", "", "VSS"], lines),
    )
    sheet.wire(PURPLE, f"box.{SPEED}", "series.a")
    sheet.wire(PURPLE, "series.b", "amp.OUT")
    sheet.wire(PURPLE, "amp.+", "dac.OUT")
    sheet.put(
        chip(
            "relays",
            "Relay board",
            (540, 580),
            230,
            ["K1 NO", "K2 NO", "", "COM, both"],
            ["VCC", "IN1", "IN2", "GND"],
            ["on at high"],
        ),
        contact("last", "heartbeat relay,\nor a plain wire", (360, 750), flat=True),
    )
    sheet.rail("5 V", RED, "amp.VDD", "relays.VCC", "pi.2")
    sheet.ground("amp.VSS", "relays.GND")
    sheet.relays({f"box.{line}": wired for line, wired in driven.items()})
    sheet.wire(BLACK, "last.b", "relays.COM, both")
    sheet.wire(BLACK, f"box.{COMMON}", "last.a")
    sheet.note(
        (30, 860),
        "A contact takes the line to ground, as the GS-232 does. 4.5 V at the socket becomes 2.9 V at the converter.",
        "100 nF from A0 to ground. The amplifier makes 0–5 V of the 0–3.3 V of the MCP4725.",
    )
    return sheet
