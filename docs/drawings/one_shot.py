"""The one-shot that lets the motors' supply go when the program no longer beats."""

from __future__ import annotations

from docs.drawings.figures import BASE_OHM, OneShot
from docs.drawings.header import GPIO_PINS
from docs.drawings.parts import capacitor, chip, diode, earth, header_labels, npn, pi_header, resistor, tap
from docs.drawings.sheet import BLACK, BLUE, GREEN, PURPLE, RED, Sheet
from rotator.config.model import Config

HEARTBEAT_GPIO = 26
"""`relays.heartbeat`, which no shipped configuration sets: pulled down at boot, no bus's pin."""


def draw(config: Config) -> Sheet:
    sheet = Sheet("wiring-heartbeat", "The heartbeat one-shot", 830)
    gpio, times = HEARTBEAT_GPIO, OneShot()
    beat = f"pi.{GPIO_PINS[gpio]}"
    sheet.put(
        pi_header((40, 330), header_labels([gpio], [39]), rows=(17, 20)),
        resistor("series", "1 kΩ", (330, 430), flat=True, side=-1),
        resistor("pull", "10 kΩ", (430, 450), side=-1),
        resistor("reset up", "100 kΩ", (430, 130), side=-1),
        capacitor("reset down", "100 nF", (370, 240), side=-1),
        chip("shot", "one-shot", (490, 150), 200, LEFT_PINS, RIGHT_PINS, ["CD74HCT4538"]),
        resistor("time", f"{times.ohm / 1000:.0f} kΩ", (790, 130), side=-1),
        capacitor("keeps", f"{times.farad * 1e6:.1f} µF\nfilm", (790, 250), side=-1),
        diode("guard", "BAT85", (880, 130)),
        earth("time ground", (760, 360)),
        resistor("base", f"{BASE_OHM // 1000} kΩ", (730, 430), flat=True, side=-1),
        resistor("base pull", "10 kΩ", (840, 450), side=-1),
        npn("switch", "BC337", (880, 430)),
        diode("flyback", "1N4007", (940, 240), side=-1),
        tap("coil supply", (980, 190), "5 V", RED),
        chip("relay", "relay", (1020, 180), 150, ["coil +", "", "coil −", "", "COM", "NO"], lines=["5 V coil"]),
        chip("motors", "motors' supply", (980, 520), 190, ["to the relays", "from the fuse"]),
    )
    sheet.wire(GREEN, beat, "series.a")
    sheet.wire(GREEN, "series.b", "shot.4 A", "pull.a")
    sheet.wire(BLACK, "reset up.b", "shot.3 RESET", "reset down.a")
    sheet.wire(BLUE, "time.b", "shot.2 RXCX", "keeps.a", "guard.b")
    sheet.wire(BLACK, "shot.1 CX", "keeps.b", "time ground.top")
    sheet.wire(PURPLE, "shot.6 Q", "base.a")
    sheet.wire(PURPLE, "base.b", "switch.base", "base pull.a")
    sheet.wire(BLACK, "switch.collector", "relay.coil −", "flyback.b")
    sheet.wire(RED, "coil supply.bottom", "relay.coil +", "flyback.a")
    sheet.wire(BLACK, "relay.COM", "motors.from the fuse")
    sheet.wire(BLACK, "relay.NO", "motors.to the relays")
    sheet.rail("5 V", RED, "reset up.a", "time.a", "guard.a", "shot.16 VCC", "shot.5 B")
    sheet.ground("pi.39", "pull.b", "reset down.b", "shot.8 GND", "base pull.b", "switch.emitter")
    sheet.note(
        (30, 690),
        f"Each rising edge at pin 4 keeps pin 6 high for 0.7 × R × C = {times.pulse_s:.2f} s.",
        "A level that stands, high or low, does nothing.",
        "5 V: header pin 2, with 100 nF from pin 16 to pin 8. Other half: 12, 13, 15 to ground, 11 to 5 V.",
        "After power-on pin 3 holds pin 6 low, and without edges it stays low: no supply until the beat begins.",
        f"The relay is open when the Pi is off, starting or frozen, and when the wire from GPIO {gpio} is broken.",
    )
    return sheet


LEFT_PINS = ["3 RESET", "", "", "", "16 VCC", "5 B", "", "4 A", "8 GND"]
RIGHT_PINS = ["2 RXCX", "", "", "", "1 CX", "", "", "6 Q"]
"""The first half of a 4538 (SCHS123): A triggers on rising edges, B on falling ones."""
