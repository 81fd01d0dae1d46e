"""A DC motor behind an H-bridge on the Pi's hardware PWM, and its encoder: the azimuth of `slew-drive`."""

from __future__ import annotations

from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import chip, contact, fuse, header_labels, pi_header, resistor
from docs.drawings.sheet import BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config


def draw(config: Config) -> Sheet:
    bridge, azimuth = config.bridge, config.bridge.azimuth
    assert bridge.enable is not None
    sheet = Sheet("wiring-slew-drive", "A slew drive: H-bridge and encoder of the azimuth", 960)
    gpios = [azimuth.plus, azimuth.minus, azimuth.pwm, azimuth.a, azimuth.b, bridge.enable]
    sheet.put(
        pi_header((130, 80), header_labels(gpios, [1, 6])),
        chip("motor", "azimuth motor", (960, 110), 200, ["M1", "M2"]),
        chip("halls", "its encoder", (960, 430), 200, ["+", "A", "B", "GND"]),
        chip(
            "bridge",
            "H-bridge",
            (640, 130),
            190,
            ["EN", "PWM", "IN1", "IN2", "GND 2"],
            ["M1", "M2", "", "V+", "GND"],
        ),
        chip("supply", "motors' supply", (480, 640), 200, right=["+", "", "−"], lines=["12 or 24 V"]),
        fuse("fuse", "fuse", (720, 710), flat=True, side=-1),
        contact("stop", "stop button", (840, 710), flat=True, side=-1),
        resistor("pull", "10 kΩ", (560, 420)),
    )
    sheet.wire(BROWN, "motor.M1", "bridge.M1")
    sheet.wire(GREEN, "motor.M2", "bridge.M2")
    sheet.wire(PINK, f"pi.{GPIO_PINS[bridge.enable]}", "bridge.EN", "pull.a")
    sheet.wire(PURPLE, f"pi.{GPIO_PINS[azimuth.pwm]}", "bridge.PWM")
    sheet.wire(BLUE, f"pi.{GPIO_PINS[azimuth.plus]}", "bridge.IN1")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[azimuth.minus]}", "bridge.IN2")
    sheet.wire(GREEN, f"pi.{GPIO_PINS[azimuth.a]}", "halls.A")
    sheet.wire(BROWN, f"pi.{GPIO_PINS[azimuth.b]}", "halls.B")
    sheet.wire(ORANGE, "pi.1", "halls.+")
    sheet.wire(RED, "supply.+", "fuse.a")
    sheet.wire(RED, "fuse.b", "stop.a")
    sheet.wire(RED, "stop.b", "bridge.V+")
    sheet.ground("pi.6", "supply.−", "pull.b", "bridge.GND", "bridge.GND 2", "halls.GND")
    sheet.note(
        (30, 850),
        "The elevation is wired likewise to its own GPIO; both bridges hang on the same enable. The encoder hangs on",
        f"3.3 V: 5 V at a GPIO destroys the Pi. 10 kΩ from GPIO {bridge.enable} to ground hold both bridges off while",
        "the Pi starts. The stop button is drawn pressed.",
    )
    return sheet
