"""A pot that must stay on 5 V, in front of a converter on 3.3 V: a divider for the wiper and one for the supply."""

from __future__ import annotations

from docs.drawings.figures import ADC_LIMIT_V, DIVIDER_LOWER_OHM, DIVIDER_UPPER_OHM, divided_v
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, header_labels, pi_header, pot, resistor
from docs.drawings.sheet import BLUE, GREEN, ORANGE, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

REFERENCE_CHANNEL = 2


def draw(config: Config) -> Sheet:
    adc = config.adc
    sheet = Sheet("wiring-divider", "A pot on 5 V, a converter on 3.3 V", 660)
    upper, lower = f"{DIVIDER_UPPER_OHM // 1000} kΩ", f"{DIVIDER_LOWER_OHM // 1000} kΩ"
    sheet.put(
        pot("pot", "azimuth\npot", (150, 130)),
        resistor("upper", upper, (300, 170), flat=True, side=-1),
        resistor("lower", lower, (430, 200)),
        resistor("upper supply", upper, (300, 340), flat=True, side=-1),
        resistor("lower supply", lower, (430, 370)),
        chip("adc", "ADS1115", (690, 120), 120, ["A0", "A1", "A2", "ADDR"], ["VDD", "SDA", "SCL", "GND"]),
        pi_header((910, 90), header_labels([SDA_GPIO, SCL_GPIO], [1, 6]), rows=(1, 5)),
    )
    sheet.rail("5 V", RED, "pot.high")
    sheet.ground("pot.low", "lower.b", "lower supply.b", "adc.GND", "adc.ADDR", "pi.6")
    sheet.rail("5 V", RED, "upper supply.a")
    sheet.wire(GREEN, "pot.wiper", "upper.a")
    sheet.wire(PURPLE, "upper supply.b", f"adc.A{REFERENCE_CHANNEL}", "lower supply.a")
    sheet.wire(GREEN, "upper.b", f"adc.A{adc.azimuth_channel}", "lower.a")
    sheet.wire(ORANGE, "pi.1", "adc.VDD")
    sheet.wire(BLUE, f"pi.{GPIO_PINS[SDA_GPIO]}", "adc.SDA")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[SCL_GPIO]}", "adc.SCL")
    sheet.note(
        (30, 540),
        f"5 V becomes {divided_v(5):.3f} V; the converter bears {ADC_LIMIT_V:.1f} V. The elevation has a divider too.",
        f"With the supply's divider, reference_channel = {REFERENCE_CHANNEL}: a supply that drifts does no harm.",
        f"Without it, supply_v = {divided_v(5):.3f}. The converter itself hangs on 3.3 V, as its bus does.",
    )
    return sheet
