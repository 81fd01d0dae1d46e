"""A display behind a PCF8574 backpack on 5 V, and the level shifter between its bus and the Pi's."""

from __future__ import annotations

from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, header_labels, pi_header
from docs.drawings.sheet import BLUE, GREEN, ORANGE, RED, Sheet
from rotator.config.model import Config

KIND = ["for I2C, BSS138"]


def draw(config: Config) -> Sheet:
    sheet = Sheet("wiring-backpack", "A display with an I2C backpack", 620)
    address = f"0x{config.lcd.address:02x}"
    sda, scl = f"pi.{GPIO_PINS[SDA_GPIO]}", f"pi.{GPIO_PINS[SCL_GPIO]}"
    sheet.put(
        pi_header((880, 80), header_labels([SDA_GPIO, SCL_GPIO], [1, 2, 6]), rows=(1, 5)),
        chip("adc", "ADS1115", (490, 310), 170, right=["VDD", "SDA", "SCL", "GND"]),
        chip(
            "shifter", "level shifter", (430, 90), 230, ["HV", "HV1", "HV2", "GND"], ["LV", "LV1", "LV2", "GND 2"], KIND
        ),
        chip("lcd", "backpack", (50, 90), 210, right=["VCC", "SDA", "SCL", "GND"], lines=[f"PCF8574 at {address}"]),
    )
    sheet.wire(BLUE, sda, "shifter.LV1", "adc.SDA")
    sheet.wire(GREEN, scl, "shifter.LV2", "adc.SCL")
    sheet.wire(BLUE, "shifter.HV1", "lcd.SDA")
    sheet.wire(GREEN, "shifter.HV2", "lcd.SCL")
    sheet.rail("3.3 V", ORANGE, "shifter.LV", "adc.VDD", "pi.1")
    sheet.rail("5 V", RED, "shifter.HV", "lcd.VCC", "pi.2")
    sheet.ground("shifter.GND", "shifter.GND 2", "lcd.GND", "adc.GND", "pi.6")
    sheet.note(
        (30, 540),
        "The backpack pulls its bus up to 5 V; the Pi's pins bear 3.3 V. The converter stays on the Pi's side.",
        "Instead of the shifter you may take the backpack's two pull-up resistors off and join the buses.",
    )
    return sheet
