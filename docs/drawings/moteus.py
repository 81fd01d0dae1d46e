"""Two moteus controllers on a CAN-FD adapter, their supply and what takes the energy of braking. Ids of `isel`."""

from __future__ import annotations

from docs.drawings.figures import BUS_FARAD
from docs.drawings.parts import capacitor, chip, contact, fuse, resistor, tap
from docs.drawings.sheet import BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

BUS = ["CAN H", "", "", "CAN L", "GND", "", "+ 24 V", "−"]
ONWARDS = ["", "CAN H 2", "CAN L 2"]
"""The second of its two sockets for the same bus."""
PHASES = ["A", "B", "C"]
ENCODER = ["3.3 V", "SDA", "SCL", "GND aux"]
TERMINATION = "120 Ω"


def draw(config: Config) -> Sheet:
    moteus = config.moteus
    sheet = Sheet("wiring-moteus", "Two moteus controllers on CAN-FD", 1090)
    sheet.put(
        chip("pi", "Raspberry Pi", (30, 120), 170, right=["USB"], lines=["any USB socket"]),
        chip("adapter", "adapter", (290, 120), 180, ["USB"], ["CAN H", "", "", "CAN L", "GND"], ["CAN-FD"]),
        chip(
            "azimuth",
            f"moteus {moteus.azimuth.id}",
            (640, 120),
            180,
            [*BUS, *ONWARDS],
            [*PHASES, "", "", "", *ENCODER],
            ["azimuth"],
        ),
        chip("azimuth motor", "motor", (1000, 140), 170, PHASES),
        chip("encoder", "AS5600", (1000, 300), 170, ["VCC", "SDA", "SCL", "GND"], lines=["on the output"]),
        chip("elevation", f"moteus {moteus.elevation.id}", (640, 640), 180, BUS, PHASES, ["elevation"]),
        chip("elevation motor", "motor", (1000, 660), 170, PHASES),
        resistor("end", TERMINATION, (590, 720), side=-1),
        chip("supply", "24 V supply", (30, 560), 170, right=["+", "", "−"], lines=["switched last"]),
        fuse("fuse", "fuse", (250, 630), flat=True, side=-1),
        contact("stop", "stop button\n(drawn pressed)", (360, 630), flat=True),
        tap("rail", (490, 590), "24 V", RED),
        capacitor("store", f"{BUS_FARAD * 1e6:.0f} µF\n50 V", (490, 680), side=-1),
        chip("chopper", "brake chopper", (30, 800), 230, right=["+", "−"], lines=["10 Ω, 50 W, from 28 V on"]),
    )
    sheet.wire(ORANGE, "pi.USB", "adapter.USB")
    sheet.wire(GREEN, "adapter.CAN H", "azimuth.CAN H")
    sheet.wire(GREEN, "azimuth.CAN H 2", "elevation.CAN H", "end.a")
    sheet.wire(BLUE, "adapter.CAN L", "azimuth.CAN L")
    sheet.wire(BLUE, "azimuth.CAN L 2", "elevation.CAN L", "end.b")
    for axis in ("azimuth", "elevation"):
        for phase, colour in zip(PHASES, (BROWN, PINK, PURPLE), strict=True):
            sheet.wire(colour, f"{axis}.{phase}", f"{axis} motor.{phase}")
    for pin, other, colour in zip(ENCODER, ("VCC", "SDA", "SCL"), (ORANGE, BLUE, TEAL), strict=False):
        sheet.wire(colour, f"azimuth.{pin}", f"encoder.{other}")
    sheet.wire(RED, "supply.+", "fuse.a")
    sheet.wire(RED, "fuse.b", "stop.a")
    sheet.wire(RED, "stop.b", "rail.bottom", "store.a")
    sheet.rail("24 V", RED, "azimuth.+ 24 V", "elevation.+ 24 V", "chopper.+")
    sheet.ground(
        *("adapter.GND", "azimuth.GND", "elevation.GND", "azimuth.−", "elevation.−", "azimuth.GND aux", "encoder.GND"),
        *("supply.−", "store.b", "chopper.−"),
    )
    sheet.note(
        (30, 990),
        "CAN H and CAN L are a twisted pair from the adapter to the first controller and on to the last: no star.",
        "120 Ω at both ends; the adapter has its own. The AS5600 on aux2 is optional; elevation may have one as well.",
        "A moteus does not survive + and − exchanged. Plug in first, switch the supply on last. The stop button is",
        "drawn pressed: the motors are then loose, and an antenna out of balance turns until something holds it.",
    )
    return sheet
