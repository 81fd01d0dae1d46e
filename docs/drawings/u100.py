"""Two motors on 24 V AC whose cam contacts are counted: optos between the tower and the Pi. GPIO numbers of `u100`."""

from __future__ import annotations

from docs.drawings.figures import ContactLoop
from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import capacitor, chip, contact, diode, fuse, header_labels, pi_header, resistor, tap
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from docs.drawings.ssr import ULN2803
from rotator.config.model import Config

ROTOR_PINS = {
    "azimuth": ["CW", "", "", "CCW", "common", "contact a", "contact b"],
    "elevation": ["up", "down", "common", "contact a", "contact b"],
}


def draw(config: Config) -> Sheet:
    relays, pulses, loop = config.relays, config.pulses, ContactLoop()
    sheet = Sheet("wiring-u100", "Two Alliance U-100 rotators on a Raspberry Pi", 1270)
    driven = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
    counted = {"azimuth": pulses.azimuth.contact, "elevation": pulses.elevation.contact}
    inputs = [f"{pin} IN{number}" for number, pin in enumerate(ULN2803["IN"], 1)]
    outputs = [f"{pin} OUT{number}" for number, pin in enumerate(ULN2803["OUT"], 1)]
    sheet.put(
        pi_header((30, 80), header_labels([*driven, *counted.values()], [2, 6])),
        chip("uln", "ULN2803", (370, 300), 180, [*inputs, "9 GND"], ["10 COM", *outputs]),
        chip(
            "ssrs",
            "SSR 1 to 4",
            (700, 280),
            170,
            ["+", "− 1", "− 2", "− 3", "− 4"],
            ["~ 1", "", "", "~ 2", "", "~ 3", "~ 4", "~ supply"],
            ["with snubbers"],
        ),
        chip("azimuth", "azimuth", (1000, 80), 170, ROTOR_PINS["azimuth"], lines=["motor and cam"]),
        chip("elevation", "elevation", (1000, 420), 170, ROTOR_PINS["elevation"], lines=["the same again"]),
        capacitor("run", "run\ncapacitor", (960, 160), side=-1),
        chip("transformer", "transformer", (1000, 950), 170, ["24 V", "", "0 V"]),
        fuse("fuse", "fuse", (920, 1000), flat=True, side=-1),
        contact("last", "heartbeat\nrelay", (790, 1000), flat=True, side=-1),
        diode("rectifier", "1N4007", (790, 1080), flat=True),
        capacitor("keeps", f"{loop.farad * 1e6:.0f} µF\n63 V", (730, 1110), side=-1),
        tap("loops", (730, 1060), f"{loop.supply_v:.0f} V", ORANGE),
    )
    colours = (GREEN, TEAL, BROWN, PINK)
    for gpio, name, colour in zip(driven, inputs, colours, strict=True):
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"uln.{name}")
    for name, number, colour in zip(outputs[::-1], (4, 3, 2, 1), colours[::-1], strict=True):
        sheet.wire(colour, f"uln.{name}", f"ssrs.− {number}")
    sheet.wire(BLUE, "ssrs.~ 1", "azimuth.CW", "run.a")
    sheet.wire(PURPLE, "ssrs.~ 2", "azimuth.CCW", "run.b")
    for (axis, gpio), colour, y in zip(counted.items(), (GREEN, BROWN), (590, 790), strict=True):
        sheet.put(
            chip(f"{axis} opto", "PC817", (400, y), 120, ["4 C", "", "3 E"], ["1 A", "", "", "2 K"], [axis]),
            resistor(f"{axis} limit", f"{loop.ohm / 1000:.1f} kΩ\n1 W", (640, y + 70), flat=True, side=-1),
            diode(f"{axis} reverse", "1N4148", (570, y + 80)),
        )
        sheet.rail(f"{loop.supply_v:.0f} V", ORANGE, f"{axis} limit.b")
        sheet.ground(f"{axis} opto.3 E")
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"{axis} opto.4 C")
        sheet.wire(ORANGE, f"{axis} opto.1 A", f"{axis} limit.a", f"{axis} reverse.a")
        sheet.wire(colour, f"{axis} opto.2 K", f"{axis}.contact a", f"{axis} reverse.b")
    sheet.wire(TEAL, "ssrs.~ 3", "elevation.up")
    sheet.wire(PINK, "ssrs.~ 4", "elevation.down")
    sheet.wire(RED, "ssrs.~ supply", "last.a")
    sheet.wire(RED, "last.b", "fuse.a", "rectifier.b")
    sheet.wire(RED, "fuse.b", "transformer.24 V")
    sheet.wire(ORANGE, "rectifier.a", "keeps.a", "loops.bottom")
    sheet.wire(
        BLACK,
        "transformer.0 V",
        "elevation.common",
        "elevation.contact b",
        "azimuth.contact b",
        "azimuth.common",
        "keeps.b",
    )
    sheet.rail("5 V", RED, "pi.2", "uln.10 COM", "ssrs.+")
    sheet.ground("pi.6", "uln.9 GND")
    sheet.note(
        (30, 1210),
        "Left of the SSRs and the optos: 5 V and the Pi's ground. Right of them: the tower. No wire joins",
        f"the two. A closed contact lets {loop.led_a * 1000:.0f} mA through its opto; its GPIO is then low.",
    )
    return sheet
