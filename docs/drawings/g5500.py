"""A Yaesu G-5500 on the Pi, through the EXT CONTROL socket of its control box. GPIO numbers of `g5500`.

The socket, as Yaesu's manual of the G-5500 has it (section on external control): 1 gives 2 to 4.5 V for 0 to 180° of
elevation, 6 the same for 0 to 450° of azimuth; joined with 8, the common ground, 2 turns right (clockwise), 4 left, 3
up, 5 down; 7 is a supply of 6 to 13 V for small things, which nothing here uses.
"""

from __future__ import annotations

from docs.drawings.figures import DIVIDER_LOWER_OHM, DIVIDER_UPPER_OHM
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, contact, earth, header_labels, pi_header, resistor
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

ELEVATION_V, RIGHT, UP, LEFT, DOWN, AZIMUTH_V, SUPPLY, COMMON = range(1, 9)
"""Pins of the socket."""
SOCKET = ("8-pin DIN socket", "of the control box")


def draw(config: Config) -> Sheet:
    relays, adc = config.relays, config.adc
    sheet = Sheet("wiring-g5500", "A Yaesu G-5500 on a Raspberry Pi", 850)
    driven = {
        RIGHT: (relays.azimuth_cw, "right (CW)", GREEN),
        LEFT: (relays.azimuth_ccw, "left (CCW)", TEAL),
        UP: (relays.elevation_up, "up", BROWN),
        DOWN: (relays.elevation_down, "down", PINK),
    }
    labels = {pin: f"{pin} {what}" for pin, (_, what, _) in driven.items()}
    labels |= {AZIMUTH_V: f"{AZIMUTH_V} azimuth volts", ELEVATION_V: f"{ELEVATION_V} elevation volts"}
    labels |= {COMMON: f"{COMMON} ground"}
    rows = [AZIMUTH_V, 0, 0, 0, 0, ELEVATION_V, 0, 0, 0, 0, *driven, 0, COMMON]
    used = header_labels([gpio for gpio, _, _ in driven.values()] + [SDA_GPIO, SCL_GPIO], [1, 2, 6])
    sheet.put(
        chip("din", "EXT CONTROL", (30, 70), 210, right=[labels.get(pin, "") for pin in rows], lines=SOCKET),
        chip("adc", "ADS1115", (650, 110), 120, ["A0", "A1", "", "ADDR"], ["VDD", "SDA", "SCL", "GND"]),
        pi_header((880, 80), used, rows=(1, 12)),
    )
    for pin, channel, colour in ((AZIMUTH_V, adc.azimuth_channel, BLUE), (ELEVATION_V, adc.elevation_channel, PURPLE)):
        y = sheet.pin(f"din.{labels[pin]}").at[1]
        sheet.put(
            resistor(f"upper {pin}", f"{DIVIDER_UPPER_OHM // 1000} kΩ", (330, y), flat=True, side=-1),
            resistor(f"lower {pin}", f"{DIVIDER_LOWER_OHM // 1000} kΩ", (460, y + 30)),
        )
        sheet.ground(f"lower {pin}.b")
        sheet.wire(colour, f"din.{labels[pin]}", f"upper {pin}.a")
        sheet.wire(colour, f"upper {pin}.b", f"adc.A{channel}", f"lower {pin}.a")
    sheet.ground("adc.ADDR", "adc.GND", "pi.6")
    sheet.wire(ORANGE, "pi.1", "adc.VDD")
    sheet.wire(GREEN, f"pi.{GPIO_PINS[SDA_GPIO]}", "adc.SDA")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[SCL_GPIO]}", "adc.SCL")

    inputs = [f"IN{relay}" for relay in range(1, 5)]
    contacts = [f"K{relay} NO" for relay in range(1, 5)]
    sheet.put(
        chip(
            "relays",
            "Relay board",
            (520, 390),
            230,
            [*contacts, "", "COM, all four"],
            ["VCC", *inputs, "GND"],
            ["on at high"],
        ),
        contact("last", "heartbeat relay,\nor a plain wire", (360, 610), flat=True),
        earth("earth", (290, 650)),
    )
    sheet.rail("5 V", RED, "relays.VCC", "pi.2")
    sheet.ground("relays.GND")
    sheet.relays({f"din.{labels[pin]}": (gpio, colour) for pin, (gpio, _, colour) in driven.items()})
    sheet.wire(BLACK, "last.b", "relays.COM, all four")
    sheet.wire(BLACK, f"din.{labels[COMMON]}", "last.a", "earth.top")
    sheet.note(
        (30, 760),
        "Each contact joins its pin with pin 8, as the switches on the control box do. No motor's current flows here.",
        "4.5 V at the socket becomes 2.9 V at the converter, 5 V becomes 3.2 V. 100 nF from A0 and A1 to ground.",
        "Pin 7 stays free. The relays are on at high: their GPIOs are pulled down, that is off, while the Pi starts.",
    )
    return sheet
