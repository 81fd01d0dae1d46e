"""Two hobby servos on a PCA9685 board, fed from a supply of their own. GPIO and outputs of `servos`."""

from __future__ import annotations

from docs.drawings.figures import SWITCH_PULL_OHM
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import capacitor, chip, contact, fuse, header_labels, pi_header, resistor
from docs.drawings.sheet import BLUE, BROWN, GREEN, ORANGE, PURPLE, RED, TEAL, Sheet
from rotator.config.model import Config

SERVO = ["signal", "+", "−"]


def draw(config: Config) -> Sheet:
    servo = config.servo
    assert servo.enable is not None
    sheet = Sheet("wiring-servos", "Two hobby servos on a PCA9685", 810)
    channels = {"azimuth": servo.azimuth.channel, "elevation": servo.elevation.channel}
    rows = [[f"{channel} PWM", f"{channel} V+", f"{channel} GND", "", ""] for channel in channels.values()]
    sheet.put(
        pi_header((930, 80), header_labels([SDA_GPIO, SCL_GPIO, servo.enable], [1, 9]), rows=(1, 5)),
        chip(
            "board",
            "PCA9685 board",
            (500, 90),
            190,
            [*rows[0], *rows[1], "", "V+", "", "GND"],
            ["VCC", "SDA", "SCL", "OE", "GND 2"],
            [f"at 0x{servo.address:02x}"],
        ),
        chip("azimuth", "azimuth servo", (40, 110), 200, right=SERVO),
        chip("elevation", "elevation servo", (40, 260), 200, right=SERVO),
        chip("supply", "servo supply", (40, 420), 200, right=["+", "", "−"], lines=["5 V, 5 A"]),
        fuse("fuse", "fuse", (270, 490), flat=True, side=-1),
        contact("stop", "stop button", (350, 490), flat=True, side=-1),
        capacitor("store", "1000 µF\n16 V", (440, 520), side=-1),
        resistor("pull", f"{SWITCH_PULL_OHM // 1000} kΩ", (800, 270)),
    )
    for axis, channel in channels.items():
        sheet.wire(GREEN if axis == "azimuth" else BROWN, f"{axis}.signal", f"board.{channel} PWM")
        sheet.wire(RED, f"{axis}.+", f"board.{channel} V+")
        sheet.wire("#222", f"{axis}.−", f"board.{channel} GND")
    sheet.wire(ORANGE, "pi.1", "board.VCC")
    sheet.wire(BLUE, f"pi.{GPIO_PINS[SDA_GPIO]}", "board.SDA")
    sheet.wire(TEAL, f"pi.{GPIO_PINS[SCL_GPIO]}", "board.SCL")
    sheet.wire(PURPLE, f"pi.{GPIO_PINS[servo.enable]}", "board.OE", "pull.a")
    sheet.wire(RED, "supply.+", "fuse.a")
    sheet.wire(RED, "fuse.b", "stop.a")
    sheet.wire(RED, "stop.b", "board.V+", "store.a")
    sheet.rail("3.3 V", ORANGE, "pull.b")
    sheet.ground("pi.9", "board.GND 2", "board.GND", "supply.−", "store.b")
    sheet.note(
        (30, 680),
        "VCC, the chip and its bus, hangs on 3.3 V; V+, the servos, on a supply of its own, never on the Pi's pins.",
        f"The grounds of both are joined. High at OE means no pulses: 1 kΩ and GPIO {servo.enable}'s own pull hold it",
        "there while the Pi starts, against the 10 kΩ to ground that many boards have. The stop button is drawn",
        "pressed. Servos without their supply are limp, and what hangs on them falls.",
    )
    return sheet
