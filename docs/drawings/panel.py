"""A front panel on two I2C chips and a few GPIOs; and the stop button and limit switches. Pins of the tables below.

The shipped configuration of the U-100 has this panel; the others with relays leave its pins and outputs free.
"""

from __future__ import annotations

from docs.drawings.figures import (
    KNOB_END_OHM,
    KNOB_PULL_OHM,
    LAMP_OHM,
    METER_SERIES_OHM,
    METER_TRIMMER_OHM,
    ContactLoop,
)
from docs.drawings.header import GPIO_PINS, SCL_GPIO, SDA_GPIO
from docs.drawings.parts import chip, contact, diode, earth, header_labels, pi_header, pot, resistor
from docs.drawings.sheet import BLACK, BLUE, BROWN, GREEN, ORANGE, PINK, PURPLE, RED, TEAL, Sheet
from hw.ports import Axis
from rotator.config.panel import LimitsTable, PanelTable
from rotator.panel.ladder import BIAS_OHM, SWITCH_OHM

PANEL = PanelTable(
    azimuth_knob=0,
    elevation_knob=1,
    jog=2,
    reference=3,
    mode_msb=10,
    mode_lsb=9,
    calibrate=11,
    stop=19,
    azimuth_meter=0,
    elevation_meter=1,
    lamp_manual=2,
    lamp_park=3,
    lamp_auto=4,
    lamp_jog=5,
    lamp_data=6,
    lamp_motor=7,
    lamp_stop=8,
    lamp_azimuth_pulse=9,
    lamp_elevation_pulse=10,
    lamp_switch=11,
)
LIMITS = LimitsTable(azimuth_low=18, azimuth_high=8, elevation_low=7, elevation_high=21)


def _kilo(ohm: float) -> str:
    return f"{ohm / 1000:g} kΩ"


def draw(panel: PanelTable = PANEL) -> Sheet:
    assert panel.mode_msb is not None
    assert panel.mode_lsb is not None
    assert panel.calibrate is not None
    sheet = Sheet("wiring-panel", "A front panel", 1150)
    sda, scl = f"pi.{GPIO_PINS[SDA_GPIO]}", f"pi.{GPIO_PINS[SCL_GPIO]}"
    switches = {"mode 2": panel.mode_msb, "mode 1": panel.mode_lsb, "calibrate": panel.calibrate}
    lamps = list(panel.lamps.values())
    more = f"{lamps[1]} to {lamps[-1]}"
    knobs = {"azimuth": panel.azimuth_knob, "elevation": panel.elevation_knob}
    sheet.put(
        pi_header((930, 80), header_labels([SDA_GPIO, SCL_GPIO, *switches.values()], [1, 9]), rows=(1, 12)),
        chip(
            "adc",
            "ADS1115",
            (620, 90),
            150,
            ["A0", "A1", "A2", "A3", "ADDR"],
            ["VDD", "SDA", "SCL", "GND"],
            [f"at 0x{panel.adc_address:02x}"],
        ),
        chip("switches", "switches", (650, 380), 170, right=list(switches), left=["", "common"]),
        resistor("bias up", _kilo(BIAS_OHM), (550, 400), side=-1),
        resistor("bias down", _kilo(BIAS_OHM), (550, 510)),
        chip("azimuth jog", "azimuth jog", (130, 380), 170, ["CW", "CCW"], ["common"], ["on – off – on"]),
        chip("elevation jog", "elevation jog", (130, 540), 170, ["up", "down"], ["common"], ["on – off – on"]),
        resistor("azimuth arm", _kilo(SWITCH_OHM[Axis.AZIMUTH]), (350, 450), flat=True, side=-1),
        resistor("elevation arm", _kilo(SWITCH_OHM[Axis.ELEVATION]), (350, 610), flat=True, side=-1),
        chip(
            "outputs",
            "PCA9685",
            (650, 680),
            170,
            ["0", "", "", "", "1", "", "", "2", more],
            ["VCC", "SDA", "SCL", "", "OE", "", "GND"],
            [f"at 0x{panel.outputs_address:02x}"],
        ),
    )
    for axis, at, colour in (("azimuth", (430, 180), GREEN), ("elevation", (210, 180), BROWN)):
        sheet.put(
            pot(f"{axis} knob", f"{axis}\nknob 10 kΩ", at),
            resistor(f"{axis} upper", f"{KNOB_END_OHM} Ω", (at[0], at[1] - 80), side=-1),
            resistor(f"{axis} lower", f"{KNOB_END_OHM} Ω", (at[0], at[1] + 100), side=-1),
            resistor(f"{axis} pull", f"{KNOB_PULL_OHM // 1_000_000} MΩ", (at[0] + 60, at[1] + 100)),
        )
        sheet.rail("3.3 V", ORANGE, f"{axis} upper.a")
        sheet.wire(ORANGE, f"{axis} upper.b", f"{axis} knob.high")
        sheet.wire(BLACK, f"{axis} knob.low", f"{axis} lower.a")
        sheet.ground(f"{axis} lower.b", f"{axis} pull.b")
        sheet.wire(colour, f"{axis} knob.wiper", f"adc.A{knobs[axis]}", f"{axis} pull.a")
    for axis in ("azimuth", "elevation"):
        one, other = ("CW", "CCW") if axis == "azimuth" else ("up", "down")
        sheet.rail("3.3 V", ORANGE, f"{axis} jog.{one}")
        sheet.ground(f"{axis} jog.{other}")
        sheet.wire(PURPLE, f"{axis} jog.common", f"{axis} arm.a")
    sheet.rail("3.3 V", ORANGE, "bias up.a", "adc.A3", "adc.ADDR", "outputs.VCC")
    sheet.ground("bias down.b", "adc.GND", "switches.common", "outputs.OE", "outputs.GND", "pi.9")
    sheet.wire(PURPLE, "bias up.b", "bias down.a", f"adc.A{panel.jog}", "azimuth arm.b", "elevation arm.b")
    sheet.wire(ORANGE, "pi.1", "adc.VDD")
    sheet.wire(BLUE, sda, "adc.SDA", "outputs.SDA")
    sheet.wire(TEAL, scl, "adc.SCL", "outputs.SCL")
    for (name, gpio), colour in zip(switches.items(), (BROWN, PINK, PURPLE), strict=True):
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"switches.{name}")
    for axis, output, y in (("azimuth", panel.azimuth_meter, 750), ("elevation", panel.elevation_meter, 870)):
        sheet.put(
            resistor(f"{axis} series", _kilo(METER_SERIES_OHM), (530, y), flat=True, side=-1),
            resistor(f"{axis} trimmer", f"trimmer {_kilo(METER_TRIMMER_OHM)}", (400, y), flat=True, side=-1),
            chip(f"{axis} meter", "0 to 1 mA", (130, y - 70), 170, ["−"], ["+"], [f"{axis} meter"]),
        )
        sheet.ground(f"{axis} meter.−")
        sheet.wire(GREEN, f"outputs.{output}", f"{axis} series.b")
        sheet.wire(GREEN, f"{axis} series.a", f"{axis} trimmer.b")
        sheet.wire(GREEN, f"{axis} trimmer.a", f"{axis} meter.+")
    sheet.put(
        resistor("lamp series", f"{LAMP_OHM} Ω", (530, 960), flat=True, side=-1),
        diode("lamp", "LED", (400, 960), flat=True),
    )
    sheet.wire(BROWN, f"outputs.{lamps[0]}", "lamp series.b")
    sheet.wire(BROWN, "lamp series.a", "lamp.b")
    sheet.ground("lamp.a")
    sheet.note(
        (30, 1060),
        f"Outputs {more}: a lamp each, as on {lamps[0]}. Mode, calibrate and stop close to ground; the Pi pulls up.",
        "10 nF from each wiper, and from A2, to ground right at the ADS1115; 10 µF across each meter.",
        "Fit what you want: what the file does not name is not there.",
    )
    return sheet


def draw_limits(panel: PanelTable = PANEL, limits: LimitsTable = LIMITS) -> Sheet:
    assert panel.stop is not None
    loop = ContactLoop()
    sheet = Sheet("wiring-limits", "Stop button and limit switches", 1010)
    sheet.put(
        pi_header((40, 80), header_labels([panel.stop, *limits.switches.values()], [6])),
        contact("button", "stop button,\nfirst contact", (350, 810), flat=True, side=-1),
        chip("source", "motors' supply", (540, 760), 190, right=["after the fuse"]),
        contact("cuts", "stop button,\nsecond contact", (820, 810), flat=True, side=-1),
        chip("relays", "motor relays", (970, 760), 170, ["supply"]),
    )
    for (key, gpio), colour, y in zip(
        limits.switches.items(), (GREEN, TEAL, BROWN, PINK), range(80, 640, 150), strict=False
    ):
        name = key.replace("_", " ")
        sheet.put(
            chip(f"{key} opto", "PC817", (440, y), 130, ["4 C", "3 E"], ["1 A", "2 K"], [name]),
            resistor(f"{key} limit", f"{loop.ohm / 1000:.1f} kΩ\n1 W", (660, y + 70), flat=True, side=-1),
            contact(f"{key} switch", key.replace("_", "\n"), (900, y + 100), flat=True, side=-1),
        )
        sheet.wire(colour, f"pi.{GPIO_PINS[gpio]}", f"{key} opto.4 C")
        sheet.wire(ORANGE, f"{key} opto.1 A", f"{key} limit.a")
        sheet.wire(colour, f"{key} opto.2 K", f"{key} switch.a")
        sheet.rail(f"{loop.supply_v:.0f} V", ORANGE, f"{key} limit.b")
        sheet.rail("0 V", BLACK, f"{key} switch.b")
        sheet.ground(f"{key} opto.3 E")
    sheet.wire(RED, f"pi.{GPIO_PINS[panel.stop]}", "button.a")
    sheet.wire(RED, "source.after the fuse", "cuts.a")
    sheet.wire(RED, "cuts.b", "relays.supply")
    sheet.put(earth("earth", (460, 840)))
    sheet.wire(BLACK, "button.b", "earth.top")
    sheet.ground("pi.6")
    sheet.note(
        (30, 920),
        "All contacts are normally closed and drawn open: pressed, at the limit, or a wire is broken.",
        f"{loop.supply_v:.0f} V and 0 V are the loop's own supply on the tower's side, as for the U-100.",
        "A switch beside the Pi needs no opto: from the GPIO through the switch to ground.",
        "The button's second contact needs no program to work.",
    )
    return sheet
