"""The F1EFW box on a Pi: two pots, an ADS1115, four relays, a display on six lines. GPIO numbers of `f1efw`."""

from __future__ import annotations

from docs.drawings.figures import POT_END_OHM, POT_OHM, POT_PULL_OHM
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, header_labels, pi_header, pot, resistor
from docs.drawings.sheet import BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config


def draw(config: Config) -> Sheet:
    relays, lcd, adc = config.relays, config.lcd, config.adc
    sheet = Sheet("wiring-f1efw", "The F1EFW box on a Raspberry Pi", 1000)
    driven = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
    lines = {"RS": lcd.rs, "E": lcd.e, "D4": lcd.d4, "D5": lcd.d5, "D6": lcd.d6, "D7": lcd.d7}
    used = header_labels([*driven, *lines.values(), SDA_GPIO, SCL_GPIO], [1, 2, 6])
    sheet.put(pi_header((690, 80), used))
    sheet.put(chip("adc", "ADS1115", (520, 110), 120, ["A0", "A1", "A2", "ADDR"], ["VDD", "SDA", "SCL", "GND"]))
    for channel, axis, x in ((adc.azimuth_channel, "azimuth", 130), (adc.elevation_channel, "elevation", 350)):
        sheet.put(
            resistor(f"{axis} top", f"{POT_END_OHM} Ω", (x, 120), side=-1),
            pot(f"{axis} pot", f"{axis}\npot {POT_OHM} Ω", (x, 200)),
            resistor(f"{axis} bottom", f"{POT_END_OHM} Ω", (x, 300), side=-1),
            resistor(f"{axis} pull", f"{POT_PULL_OHM // 1000} kΩ", (x + 60, 300)),
        )
        sheet.rail("3.3 V", ORANGE, f"{axis} top.a")
        sheet.ground(f"{axis} bottom.b", f"{axis} pull.b")
        sheet.wire(ORANGE, f"{axis} top.b", f"{axis} pot.high")
        sheet.wire("#222", f"{axis} pot.low", f"{axis} bottom.a")
        sheet.wire(GREEN if axis == "azimuth" else TEAL, f"adc.A{channel}", f"{axis} pot.wiper", f"{axis} pull.a")
    sheet.rail("3.3 V", ORANGE, f"adc.A{adc.reference_channel}")
    sheet.ground("adc.ADDR", "adc.GND", "pi.6")
    sheet.wire(ORANGE, "pi.1", "adc.VDD")
    sheet.wire(BLUE, f"pi.{GPIO_PINS[SDA_GPIO]}", "adc.SDA")
    sheet.wire(PURPLE, f"pi.{GPIO_PINS[SCL_GPIO]}", "adc.SCL")

    inputs = ("IN1", "IN2", "IN3", "IN4")
    moves = ("azimuth CW", "azimuth CCW", "elevation up", "elevation down")
    sheet.put(chip("relays", "Relay board", (1010, 240), 170, ["VCC", *inputs, "GND"], lines=["on at high"]))
    sheet.rail("5 V", RED, "relays.VCC", "pi.2")
    sheet.ground("relays.GND")
    for gpio, name, colour in zip(driven, inputs, (GREEN, TEAL, BROWN, PINK), strict=True):
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"relays.{name}")
    sheet.note(
        (1000, 510), *(f"{name}: {move}" for name, move in zip(inputs, moves, strict=True)), "contacts: to motors"
    )

    left = ["1 VSS", "2 VDD", "3 VO", "5 RW", "15 A", "16 K"]
    right = ["4 RS", "6 E", "11 D4", "12 D5", "14 D7", "13 D6"]
    sheet.put(
        chip("lcd", "HD44780", (240, 590), 200, left, right, lines=["16×2 display"]),
        pot("contrast", "contrast\n10 kΩ", (130, 680)),
    )
    sheet.ground("lcd.1 VSS", "lcd.5 RW", "lcd.16 K", "contrast.low")
    sheet.rail("5 V", RED, "lcd.2 VDD", "lcd.15 A", "contrast.high")
    sheet.wire("#222", "contrast.wiper", "lcd.3 VO")
    for label, colour in reversed(list(zip(right, (BLUE, PURPLE, GREEN, TEAL, BROWN, PINK), strict=True))):
        sheet.wire(colour, f"pi.{GPIO_PINS[lines[label.split()[1]]]}", f"lcd.{label}")
    sheet.note(
        (30, 900),
        "All grounds are joined. Pots and converter hang on 3.3 V (header pin 1), never on 5 V.",
        "A2 measures the pots' supply. RW must be at ground: the display would drive 5 V into the Pi.",
        "Backlight (15 A): through 100 Ω where the display has no resistor of its own.",
    )
    return sheet
