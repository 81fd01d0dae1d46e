"""A rotor with a wedge brake on the Pi, such as a Ham IV: beside the three levers and the meter of its control box."""

from __future__ import annotations

from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import capacitor, chip, contact, header_labels, pi_header, resistor
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, ORANGE, RED, TEAL, Sheet
from rotator.config.model import Config

POT, RIGHT, LEFT = "13 V, before the 27 Ω", "lever RIGHT", "lever LEFT"
BRAKE, COMMON = "lever BRAKE", "its other contact"
UPPER_OHM, LOWER_OHM = 39_000, 12_000


def draw(config: Config) -> Sheet:
    relays, adc, brake = config.relays, config.adc, config.azimuth.brake.line
    assert brake is not None, "a Ham IV has a brake"
    sheet = Sheet("wiring-ham4", "A Ham IV with its brake, on a Raspberry Pi", 860)
    driven = {RIGHT: (relays.azimuth_cw, GREEN), LEFT: (relays.azimuth_ccw, TEAL)}
    used = header_labels([gpio for gpio, _ in driven.values()] + [brake, SDA_GPIO, SCL_GPIO], [1, 2, 6])
    rows = [POT, "terminal 1, ground", "", "", "", "", "", "", RIGHT, LEFT, "common of both", "", BRAKE, COMMON]
    sheet.put(
        chip("box", "Control box", (30, 70), 210, right=rows, lines=("27 Ω between the 13 V", "and terminal 3")),
        chip("adc", "ADS1115", (650, 110), 120, ["A0", "A1", "", "ADDR"], ["VDD", "SDA", "SCL", "GND"]),
        pi_header((880, 80), used),
    )
    y = sheet.pin(f"box.{POT}").at[1]
    sheet.put(
        resistor("upper", f"{UPPER_OHM // 1000} kΩ", (330, y), flat=True, side=-1),
        resistor("lower", f"{LOWER_OHM // 1000} kΩ", (440, y + 30)),
        capacitor("filter", "10 µF", (530, y + 30)),
    )
    sheet.ground("lower.b", "filter.b", "box.terminal 1, ground")
    sheet.wire(BLUE, f"box.{POT}", "upper.a")
    sheet.wire(BLUE, "upper.b", f"adc.A{adc.azimuth_channel}", "lower.a", "filter.a")
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
            ["K1 NO", "K2 NO", "COM of K1, K2", "", "K3 NO", "K3 COM"],
            ["VCC", "IN1", "IN2", "IN3", "GND"],
            ["on at high"],
        ),
        contact("last", "heartbeat relay,\nor a plain wire", (360, 560), flat=True),
    )
    sheet.rail("5 V", RED, "relays.VCC", "pi.2")
    sheet.ground("relays.GND")
    sheet.wire(BROWN, f"pi.{GPIO_PINS[brake]}", "relays.IN3")
    sheet.relays({f"box.{lever}": wired for lever, wired in driven.items()})
    sheet.wire(BLACK, "last.b", "relays.COM of K1, K2")
    sheet.wire(BLACK, "box.common of both", "last.a")
    sheet.wire(BROWN, f"box.{BRAKE}", "relays.K3 NO")
    sheet.wire(RED, f"box.{COMMON}", "relays.K3 COM")
    sheet.note(
        (30, 790),
        "Each contact is wired beside a lever of the control box, which goes on to work as before.",
        "K3 for the mains, if BRAKE switches the mains: see the page. 13 V become 3.06 V at the converter.",
    )
    return sheet
