"""Digital pots in place of the knobs of two ORBIT-360 control boxes, and the relay in the boxes' supply.

GPIO numbers of `orbit360`.
"""

from __future__ import annotations

from docs.drawings.figures import BASE_OHM
from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import chip, diode, header_labels, npn, pi_header, resistor, tap
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

BUFFER = {
    "azimuth": ("2 1A", "3 1Y"),
    "elevation": ("5 2A", "6 2Y"),
    "sck": ("9 3A", "8 3Y"),
    "si": ("12 4A", "11 4Y"),
}
"""A 74HCT125's four gates by their pins; 1, 4, 10 and 13 enable them when low, 7 is ground and 14 the supply."""
CONTROL = ["1 CS", "2 SCK", "3 SI", "4 VSS"]
POT = ["8 VDD", "5 PA0", "6 PW0", "7 PB0"]
"""An MCP41010's pins (Microchip DS11195C)."""
BOX = ["", "knob +", "knob wiper", "knob −", "ground", "supply a", "supply b"]
KNOB = (("5 PA0", "knob +", ORANGE), ("6 PW0", "knob wiper", GREEN), ("7 PB0", "knob −", BLACK))


def draw(config: Config) -> Sheet:
    digipot = config.digipot
    assert digipot.enable is not None
    sheet = Sheet("wiring-orbit360", "Digital pots in two ORBIT-360 control boxes", 1090)
    lines = {"azimuth": digipot.azimuth.select, "elevation": digipot.elevation.select}
    lines |= {"sck": digipot.sck, "si": digipot.si}
    sheet.put(
        pi_header((30, 80), header_labels([*lines.values(), digipot.enable], [2, 6])),
        chip(
            "buffer",
            "74HCT125",
            (370, 330),
            180,
            [*(a for a, _ in BUFFER.values()), "1 4 10 13", "", "7 GND"],
            ["14 VCC", *(y for _, y in BUFFER.values())],
        ),
        resistor("base", f"{BASE_OHM // 1000} kΩ", (360, 790), flat=True, side=-1),
        resistor("base pull", "10 kΩ", (470, 810), side=-1),
        npn("switch", "BC337", (510, 790)),
        diode("flyback", "1N4007", (580, 680), side=-1),
        tap("coil supply", (580, 650), "5 V", RED),
        chip(
            "relay",
            "relay",
            (690, 790),
            150,
            ["coil +", "", "coil −"],
            ["NO 1", "COM 1", "NO 2", "COM 2"],
            ["5 V coil"],
        ),
    )
    colours = dict(zip(lines, (BLUE, PURPLE, BROWN, TEAL), strict=True))
    for axis, y in (("azimuth", 110), ("elevation", 460)):
        sheet.put(
            chip(axis, "MCP41010", (690, y), 150, CONTROL, POT, [axis]),
            chip(f"{axis} box", f"{axis} box", (1000, y), 170, BOX, lines=["its knob taken out"]),
        )
        sheet.rail("5 V", RED, f"{axis}.8 VDD")
        sheet.ground(f"{axis}.4 VSS", f"{axis} box.ground")
        for pin, end, colour in KNOB:
            sheet.wire(colour, f"{axis}.{pin}", f"{axis} box.{end}")
    for name, (a, _) in BUFFER.items():
        sheet.wire(colours[name], f"pi.{GPIO_PINS[lines[name]]}", f"buffer.{a}")
    sheet.wire(colours["azimuth"], f"buffer.{BUFFER['azimuth'][1]}", "azimuth.1 CS")
    sheet.wire(colours["sck"], f"buffer.{BUFFER['sck'][1]}", "azimuth.2 SCK", "elevation.2 SCK")
    sheet.wire(colours["si"], f"buffer.{BUFFER['si'][1]}", "azimuth.3 SI", "elevation.3 SI")
    sheet.wire(colours["elevation"], f"buffer.{BUFFER['elevation'][1]}", "elevation.1 CS")
    sheet.wire(PINK, f"pi.{GPIO_PINS[digipot.enable]}", "base.a")
    sheet.wire(PINK, "base.b", "switch.base", "base pull.a")
    sheet.wire(RED, "coil supply.bottom", "relay.coil +", "flyback.a")
    sheet.wire(BLACK, "switch.collector", "relay.coil −", "flyback.b")
    for number, axis in enumerate(("elevation", "azimuth"), 1):
        sheet.wire(RED, f"relay.NO {number}", f"{axis} box.supply a")
        sheet.wire(RED, f"relay.COM {number}", f"{axis} box.supply b")
    sheet.rail("5 V", RED, "pi.2", "buffer.14 VCC")
    sheet.ground("pi.6", "buffer.1 4 10 13", "buffer.7 GND", "base pull.b", "switch.emitter")
    sheet.note(
        (30, 1000),
        "The chips hang on 5 V, for the knobs' divider gives 4.5 V, and no pin of theirs may be above their supply.",
        "Chips, boxes and Pi have one ground. The relay cuts both boxes' supply, on its low-voltage side, until both",
        "chips have got their step. 100 nF from VDD to VSS right at each chip, and from 14 to 7.",
    )
    return sheet
