"""Two steppers on TMC5160 boards: the Pi's SPI, the line DRV_ENN of both, and end switches. GPIO of `satnogs`."""

from __future__ import annotations

from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import chip, contact, fuse, header_labels, pi_header, resistor
from docs.drawings.sheet import BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.chips import KERNEL_WIRES
from rotator.config.model import Config

COILS = ["A1", "A2", "B1", "B2"]
"""OA1, OA2, OB1 and OB2 of the chip."""
LEFT = [*COILS, "", "REFL", "", "VM", "GND"]
RIGHT = ["VCC_IO", "CSN", "SCK", "SDI", "SDO", "DRV_ENN", "", "SD_MODE", "", "GND 2"]


def draw(config: Config) -> Sheet:
    stepper = config.stepper
    assert stepper.enable is not None
    sheet = Sheet("wiring-satnogs", "Two steppers on TMC5160", 1200)
    selects = {"azimuth": stepper.azimuth.select, "elevation": stepper.elevation.select}
    sck, mosi, miso = (KERNEL_WIRES[wire] for wire in ("sck", "si", "so"))
    lines = {"SCK": sck, "SDI": mosi, "SDO": miso, "DRV_ENN": stepper.enable}
    sheet.put(
        pi_header((840, 80), header_labels([*selects.values(), *lines.values()], [17, 25]), rows=(1, 13)),
        chip("azimuth", "TMC5160", (400, 110), 190, LEFT, RIGHT),
        chip("elevation", "TMC5160", (400, 520), 190, LEFT, RIGHT),
        chip("azimuth motor", "azimuth", (40, 110), 170, right=COILS),
        chip("elevation motor", "elevation", (40, 520), 170, right=COILS),
        chip("supply", "motor supply", (40, 880), 170, right=["+", "", "−"], lines=["24 V"]),
        fuse("fuse", "fuse", (260, 950), flat=True, side=-1),
        contact("stop", "stop button", (340, 950), flat=True, side=-1),
        contact("azimuth end", "end", (220, 330), flat=True, side=-1),
        contact("elevation end", "end", (220, 740), flat=True, side=-1),
        resistor("azimuth pull", "10 kΩ", (330, 200), side=-1),
        resistor("elevation pull", "10 kΩ", (330, 610), side=-1),
        resistor("pull", "10 kΩ", (760, 560)),
    )
    for axis in selects:
        for coil in COILS:
            sheet.wire(GREEN if coil.startswith("A") else BROWN, f"{axis} motor.{coil}", f"{axis}.{coil}")
        sheet.wire(PINK, f"{axis} pull.b", f"{axis}.REFL", f"{axis} end.b")
        sheet.rail("3.3 V", ORANGE, f"{axis} pull.a")
        sheet.wire(BLUE, f"pi.{GPIO_PINS[selects[axis]]}", f"{axis}.CSN")
    for (name, gpio), colour in zip(lines.items(), (TEAL, BROWN, GREEN, PURPLE), strict=True):
        more = ["pull.b"] if name == "DRV_ENN" else []
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"azimuth.{name}", f"elevation.{name}", *more)
    sheet.wire(ORANGE, "pi.17", "azimuth.VCC_IO", "elevation.VCC_IO")
    sheet.rail("3.3 V", ORANGE, "pull.a")
    sheet.wire(RED, "supply.+", "fuse.a")
    sheet.wire(RED, "fuse.b", "stop.a")
    sheet.wire(RED, "stop.b", "azimuth.VM", "elevation.VM")
    sheet.ground(
        "pi.25",
        *(f"{axis}.{pin}" for axis in selects for pin in ("GND", "GND 2", "SD_MODE")),
        *(f"{axis} end.a" for axis in selects),
        "supply.−",
    )
    sheet.note(
        (30, 1100),
        "VCC_IO is on 3.3 V, for SDO drives the Pi; VM is the motors' own supply. SD_MODE on ground: the chip",
        "makes the ramps. High at DRV_ENN takes the current from the motors. The switches open at the lower",
        "end: a broken wire reads as the end. The stop button is drawn pressed. Never pull a motor's plug while",
        "it has current.",
    )
    return sheet
