"""The wiring pictures: what the source makes is what the documents show, it is clean, its pins are the profiles'."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from docs.drawings import panel
from docs.drawings.__main__ import pictures
from docs.drawings.album import profile, sheets
from docs.drawings.header import GPIO_PINS
from docs.drawings.inspect import complaints
from docs.drawings.route import Routed, route
from docs.drawings.sheet import Sheet
from docs.drawings.svg import svg
from rotator.config.model import Config

IMAGES = Path(__file__).parents[2] / "docs" / "img"
SHEETS = {sheet.file: sheet for sheet in sheets()}


@cache
def drawn(name: str) -> tuple[Sheet, list[Routed]]:
    sheet = SHEETS[name]
    return sheet, route(sheet)


def joined(sheet: Sheet) -> Iterator[tuple[str, str]]:
    """Every pair of pins that a wire joins, both ways round."""
    for net in sheet.nets:
        yield from ((one, other) for one in net.pins for other in net.pins if one != other)


def gpio_at(sheet: Sheet, pin: str) -> int:
    """The GPIO that a wire leads to from a pin of a part."""
    (header,) = [other.removeprefix("pi.") for one, other in joined(sheet) if one == pin and other.startswith("pi.")]
    return {place: gpio for gpio, place in GPIO_PINS.items()}[int(header)]


@pytest.mark.parametrize("name", SHEETS)
def test_the_picture_in_the_documents_is_what_the_source_makes(name: str) -> None:
    """If this fails: make drawings."""
    assert (IMAGES / f"{name}.svg").read_text(encoding="utf-8") == svg(*drawn(name))


@pytest.mark.parametrize("name", pictures())
def test_a_picture_that_is_no_wiring_is_what_its_source_makes(name: str) -> None:
    """If this fails: make drawings."""
    assert (IMAGES / f"{name}.svg").read_text(encoding="utf-8") == pictures()[name]


def test_no_picture_is_left_of_a_drawing_that_is_gone() -> None:
    assert sorted(path.stem for path in IMAGES.glob("wiring-*.svg")) == sorted(SHEETS)


@pytest.mark.parametrize("name", SHEETS)
def test_nothing_overlaps_and_no_wire_runs_through_a_part(name: str) -> None:
    assert complaints(*drawn(name)) == []


def relay_gpios(config: Config) -> list[int]:
    relays = config.relays
    return [relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down]


@pytest.mark.parametrize(
    ("name", "inputs"),
    [
        ("wiring-f1efw", [f"relays.IN{n}" for n in (1, 2, 3, 4)]),
        ("wiring-g5500", [f"relays.IN{n}" for n in (1, 2, 3, 4)]),
        ("wiring-ssr", [f"uln.{n} IN{n}" for n in (1, 2, 3, 4)]),
        ("wiring-u100", [f"uln.{n} IN{n}" for n in (1, 2, 3, 4)]),
    ],
)
def test_relays_hang_on_the_pins_of_the_profile(name: str, inputs: list[str]) -> None:
    config = profile({"wiring-g5500": "g5500", "wiring-u100": "u100"}.get(name, "f1efw"))
    sheet, _ = drawn(name)
    assert [gpio_at(sheet, pin) for pin in inputs] == relay_gpios(config) == relay_gpios(Config())


def test_the_display_hangs_on_the_pins_of_the_profile() -> None:
    sheet, lcd = drawn("wiring-f1efw")[0], profile("f1efw").lcd
    pins = ["4 RS", "6 E", "11 D4", "12 D5", "13 D6", "14 D7"]
    assert [gpio_at(sheet, f"lcd.{pin}") for pin in pins] == [lcd.rs, lcd.e, lcd.d4, lcd.d5, lcd.d6, lcd.d7]


def test_each_wiper_goes_to_its_channel() -> None:
    box, adc = drawn("wiring-f1efw")[0], profile("f1efw").adc
    assert ("azimuth pot.wiper", f"adc.A{adc.azimuth_channel}") in joined(box)
    assert ("elevation pot.wiper", f"adc.A{adc.elevation_channel}") in joined(box)
    yaesu, adc = drawn("wiring-g5500")[0], profile("g5500").adc
    assert ("upper 6.b", f"adc.A{adc.azimuth_channel}") in joined(yaesu)
    assert ("upper 1.b", f"adc.A{adc.elevation_channel}") in joined(yaesu)


def test_the_g_5500s_socket_is_wired_as_yaesus_manual_has_it() -> None:
    """Joined with pin 8: 2 turns right, 4 left, 3 up, 5 down; 6 and 1 tell azimuth and elevation."""
    sheet, relays = drawn("wiring-g5500")[0], profile("g5500").relays
    turns = {2: relays.azimuth_cw, 4: relays.azimuth_ccw, 3: relays.elevation_up, 5: relays.elevation_down}
    for pin, gpio in turns.items():
        ((_, contact),) = [pair for pair in joined(sheet) if re.match(rf"din\.{pin} ", pair[0])]
        relay = contact.removeprefix("relays.K").removesuffix(" NO")
        assert gpio_at(sheet, f"relays.IN{relay}") == gpio
    assert ("din.8 ground", "last.a") in joined(sheet)
    assert ("din.6 azimuth volts", "upper 6.a") in joined(sheet)
    assert ("din.1 elevation volts", "upper 1.a") in joined(sheet)


@pytest.mark.parametrize(
    ("number", "relay"), [(1, "azimuth.CW"), (2, "azimuth.CCW"), (3, "elevation.up"), (4, "elevation.down")]
)
def test_each_ssr_of_the_u_100_feeds_the_wire_of_its_relay(number: int, relay: str) -> None:
    sheet, _ = drawn("wiring-u100")
    output = {1: "18 OUT1", 2: "17 OUT2", 3: "16 OUT3", 4: "15 OUT4"}[number]
    assert (f"uln.{output}", f"ssrs.− {number}") in joined(sheet)
    assert (f"ssrs.~ {number}", relay) in joined(sheet)


@pytest.mark.parametrize("axis", ["azimuth", "elevation"])
def test_a_cams_contact_reaches_its_gpio_through_an_opto_only(axis: str) -> None:
    sheet, pulses = drawn("wiring-u100")[0], profile("u100").pulses
    assert gpio_at(sheet, f"{axis} opto.4 C") == getattr(pulses, axis).contact
    assert (f"{axis} opto.2 K", f"{axis}.contact a") in joined(sheet)
    tower = {net for net in sheet.nets if any(pin.startswith((f"{axis}.", "transformer.")) for pin in net.pins)}
    assert not [pin for net in tower for pin in net.pins if pin.startswith("pi.")]


def test_a_digital_pot_is_reached_through_the_buffer_at_the_profiles_pins() -> None:
    sheet, digipot = drawn("wiring-orbit360")[0], profile("orbit360").digipot
    assert digipot.enable is not None
    ins = ("2 1A", "5 2A", "9 3A", "12 4A")
    lines = [digipot.azimuth.select, digipot.elevation.select, digipot.sck, digipot.si]
    assert [gpio_at(sheet, f"buffer.{pin}") for pin in ins] == lines
    pairs = set(joined(sheet))
    assert {("buffer.3 1Y", "azimuth.1 CS"), ("buffer.6 2Y", "elevation.1 CS")} <= pairs
    for axis in ("azimuth", "elevation"):
        assert {("buffer.8 3Y", f"{axis}.2 SCK"), ("buffer.11 4Y", f"{axis}.3 SI")} <= pairs
        assert {(f"{axis}.5 PA0", f"{axis} box.knob +"), (f"{axis}.6 PW0", f"{axis} box.knob wiper")} <= pairs
    assert gpio_at(sheet, "base.a") == digipot.enable
    assert digipot.enable >= 9, "pulled down while the Pi starts: the boxes have no supply"


def test_the_servo_boards_wires() -> None:
    sheet, servo = drawn("wiring-servos")[0], profile("servos").servo
    assert servo.enable is not None
    assert gpio_at(sheet, "board.OE") == servo.enable
    assert servo.enable < 9, "pulled up while the Pi starts: no pulses"
    assert (gpio_at(sheet, "board.SDA"), gpio_at(sheet, "board.SCL")) == (2, 3)
    assert ("azimuth.signal", f"board.{servo.azimuth.channel} PWM") in joined(sheet)
    assert ("elevation.signal", f"board.{servo.elevation.channel} PWM") in joined(sheet)
    assert ("pi.1", "board.VCC") in joined(sheet)
    assert not [pair for pair in joined(sheet) if pair[0] == "board.V+" and pair[1].startswith("pi.")]


def test_the_panel_is_drawn_as_its_tables_say() -> None:
    sheet, wired = drawn("wiring-panel")[0], panel.PANEL
    switches = {"mode 2": wired.mode_msb, "mode 1": wired.mode_lsb, "calibrate": wired.calibrate}
    assert {name: gpio_at(sheet, f"switches.{name}") for name in switches} == switches
    pairs = set(joined(sheet))
    assert ("azimuth knob.wiper", f"adc.A{wired.azimuth_knob}") in pairs
    assert ("elevation knob.wiper", f"adc.A{wired.elevation_knob}") in pairs
    assert {("azimuth arm.b", f"adc.A{wired.jog}"), ("elevation arm.b", f"adc.A{wired.jog}")} <= pairs
    assert (f"outputs.{wired.azimuth_meter}", "azimuth series.b") in pairs
    assert (f"outputs.{wired.lamp_manual}", "lamp series.b") in pairs


def test_stop_and_limits_are_drawn_as_their_tables_say() -> None:
    sheet = drawn("wiring-limits")[0]
    assert gpio_at(sheet, "button.a") == panel.PANEL.stop
    assert {key: gpio_at(sheet, f"{key} opto.4 C") for key in panel.LIMITS.switches} == panel.LIMITS.switches
    assert {("source.after the fuse", "cuts.a"), ("cuts.b", "relays.supply")} <= set(joined(sheet))


def test_the_header_is_the_one_in_the_table_of_the_wiring_page() -> None:
    page = (IMAGES.parent / "wiring.md").read_text(encoding="utf-8")
    rows = re.findall(r"\| (\d+)(?: \(S\w+\))? \| (\d+)\b", page)
    assert len(rows) >= 13
    assert all(GPIO_PINS[int(gpio)] == int(pin) for gpio, pin in rows)
