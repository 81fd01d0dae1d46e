"""Solid-state relays for motors on 24 V AC with a run capacitor. GPIO numbers of `f1efw`; the azimuth in full."""

from __future__ import annotations

from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import capacitor, chip, contact, fuse, header_labels, pi_header, resistor
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

ACROSS = ["~ supply", "", "", "", "", "", "~ motor"]
ULN2803 = {"IN": (1, 2, 3, 4), "OUT": (18, 17, 16, 15)}
"""Its pins, of the first four of eight drivers; 9 is ground, 10 the diodes' common end."""


def draw(config: Config) -> Sheet:
    relays = config.relays
    sheet = Sheet("wiring-ssr", "Solid-state relays for 24 V AC motors", 960)
    driven = (relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down)
    inputs = [f"{pin} IN{number}" for number, pin in enumerate(ULN2803["IN"], 1)]
    outputs = [f"{pin} OUT{number}" for number, pin in enumerate(ULN2803["OUT"], 1)]
    sheet.put(
        pi_header((30, 80), header_labels(driven, [2, 6]), rows=(1, 12)),
        chip("uln", "ULN2803", (370, 300), 180, [*inputs, "9 GND"], ["10 COM", *outputs]),
        chip("K1", "SSR 1", (650, 80), 150, ["+", "−"], ACROSS),
        chip("K2", "SSR 2", (650, 350), 150, ["+", "−"], ACROSS),
        chip(
            "K34", "SSR 3 and 4", (650, 620), 150, ["+", "− 3", "− 4"], ["~ supply"], ["elevation:", "the same again"]
        ),
        chip(
            "motor", "azimuth", (1020, 240), 150, ["CW", "", "", "", "", "CCW", "", "common"], lines=["motor, 24 V AC"]
        ),
        capacitor("run", "run\ncapacitor", (980, 350), side=-1),
        chip("transformer", "transformer", (1020, 660), 150, ["0 V", "", "24 V"]),
        fuse("fuse", "fuse", (930, 770), flat=True),
        contact("last", "heartbeat\nrelay", (840, 770), flat=True),
    )
    colours = (GREEN, TEAL, BROWN, PINK)
    for gpio, name, colour in zip(driven, inputs, colours, strict=True):
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"uln.{name}")
    for name, pin, colour in zip(outputs[::-1], ("K34.− 4", "K34.− 3", "K2.−", "K1.−"), colours[::-1], strict=True):
        sheet.wire(colour, f"uln.{name}", pin)
    for relay, terminal, colour in (("K1", "motor.CW", BLUE), ("K2", "motor.CCW", PURPLE)):
        top = sheet.pin(f"{relay}.~ supply").at[1]
        sheet.put(
            resistor(f"{relay} damper", "100 Ω", (880, top + 20)),
            capacitor(f"{relay} snubber", "100 nF", (880, top + 100)),
        )
        sheet.wire(BLACK, f"{relay} damper.b", f"{relay} snubber.a")
        ends = (f"{relay}.~ motor", terminal, f"{relay} snubber.b")
        sheet.wire(colour, *ends, "run.a" if relay == "K1" else "run.b")
    sheet.wire(RED, "K1.~ supply", "K1 damper.a", "last.a", "K2.~ supply", "K2 damper.a", "K34.~ supply")
    sheet.wire(RED, "last.b", "fuse.a")
    sheet.wire(RED, "fuse.b", "transformer.24 V")
    sheet.wire(BLACK, "transformer.0 V", "motor.common")
    sheet.rail("5 V", RED, "pi.2", "uln.10 COM", "K1.+", "K2.+", "K34.+")
    sheet.ground("pi.6", "uln.9 GND")
    sheet.note(
        (30, 860),
        "The SSRs must be made for 24 V AC (such as 12 to 280 V) and switch at the zero crossing. Swapping the end",
        "that is fed directly with the one behind the capacitor reverses the motor. 5 V and ground on the left have no",
        "connection with the 24 V on the right: the SSRs part them.",
    )
    return sheet
