"""The wiring pictures: what the source makes is what the documents show, it is clean, its pins are the profiles'."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from docs.drawings import one_shot
from docs.drawings.album import profile, sheets
from docs.drawings.header import GPIO_PINS
from docs.drawings.inspect import complaints
from docs.drawings.parts import chip
from docs.drawings.route import NoWay, Routed, route
from docs.drawings.sheet import Net, Sheet
from docs.drawings.svg import svg
from rotator.config.model import Config

IMAGES = Path(__file__).parents[2] / "docs" / "img"
NAMES = [sheet.file for sheet in sheets()]


@pytest.fixture(scope="module")
def drawn() -> dict[str, tuple[Sheet, list[Routed]]]:
    return {sheet.file: (sheet, route(sheet)) for sheet in sheets()}


def joined(sheet: Sheet) -> Iterator[tuple[str, str]]:
    """Every pair of pins that a wire joins, both ways round."""
    for net in sheet.nets:
        yield from ((one, other) for one in net.pins for other in net.pins if one != other)


def gpio_at(sheet: Sheet, pin: str) -> int:
    """The GPIO that a wire leads to from a pin of a part."""
    (header,) = [other.removeprefix("pi.") for one, other in joined(sheet) if one == pin and other.startswith("pi.")]
    return {place: gpio for gpio, place in GPIO_PINS.items()}[int(header)]


@pytest.mark.parametrize("name", NAMES)
def test_the_picture_in_the_documents_is_what_the_source_makes(
    name: str, drawn: dict[str, tuple[Sheet, list[Routed]]]
) -> None:
    """If this fails: make drawings."""
    assert (IMAGES / f"{name}.svg").read_text(encoding="utf-8") == svg(*drawn[name])


def test_no_picture_is_left_of_a_drawing_that_is_gone() -> None:
    assert sorted(path.stem for path in IMAGES.glob("wiring-*.svg")) == sorted(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_overlaps_and_no_wire_runs_through_a_part(
    name: str, drawn: dict[str, tuple[Sheet, list[Routed]]]
) -> None:
    assert complaints(*drawn[name]) == []


def relay_gpios(config: Config) -> list[int]:
    relays = config.relays
    return [relays.azimuth_cw, relays.azimuth_ccw, relays.elevation_up, relays.elevation_down]


@pytest.mark.parametrize(
    ("name", "inputs"),
    [
        ("wiring-f1efw", [f"relays.IN{n}" for n in (1, 2, 3, 4)]),
        ("wiring-g5500", [f"relays.IN{n}" for n in (1, 2, 3, 4)]),
        ("wiring-ssr", [f"uln.{n} IN{n}" for n in (1, 2, 3, 4)]),
    ],
)
def test_relays_hang_on_the_pins_of_the_profile(
    name: str, inputs: list[str], drawn: dict[str, tuple[Sheet, list[Routed]]]
) -> None:
    config = profile("g5500" if name == "wiring-g5500" else "f1efw")
    sheet, _ = drawn[name]
    assert [gpio_at(sheet, pin) for pin in inputs] == relay_gpios(config) == relay_gpios(Config())


def test_the_display_hangs_on_the_pins_of_the_profile(drawn: dict[str, tuple[Sheet, list[Routed]]]) -> None:
    sheet, lcd = drawn["wiring-f1efw"][0], profile("f1efw").lcd
    pins = ["4 RS", "6 E", "11 D4", "12 D5", "13 D6", "14 D7"]
    assert [gpio_at(sheet, f"lcd.{pin}") for pin in pins] == [lcd.rs, lcd.e, lcd.d4, lcd.d5, lcd.d6, lcd.d7]


@pytest.mark.parametrize("name", ["wiring-f1efw", "wiring-g5500", "wiring-divider", "wiring-backpack"])
def test_the_bus_is_the_headers(name: str, drawn: dict[str, tuple[Sheet, list[Routed]]]) -> None:
    sheet, _ = drawn[name]
    assert (gpio_at(sheet, "adc.SDA"), gpio_at(sheet, "adc.SCL")) == (2, 3)


def test_each_wiper_goes_to_its_channel(drawn: dict[str, tuple[Sheet, list[Routed]]]) -> None:
    box, adc = drawn["wiring-f1efw"][0], profile("f1efw").adc
    assert ("azimuth pot.wiper", f"adc.A{adc.azimuth_channel}") in joined(box)
    assert ("elevation pot.wiper", f"adc.A{adc.elevation_channel}") in joined(box)
    yaesu, adc = drawn["wiring-g5500"][0], profile("g5500").adc
    assert ("upper 6.b", f"adc.A{adc.azimuth_channel}") in joined(yaesu)
    assert ("upper 1.b", f"adc.A{adc.elevation_channel}") in joined(yaesu)


def test_the_g_5500s_socket_is_wired_as_yaesus_manual_has_it(drawn: dict[str, tuple[Sheet, list[Routed]]]) -> None:
    """Joined with pin 8: 2 turns right, 4 left, 3 up, 5 down; 6 and 1 tell azimuth and elevation."""
    sheet, relays = drawn["wiring-g5500"][0], profile("g5500").relays
    turns = {2: relays.azimuth_cw, 4: relays.azimuth_ccw, 3: relays.elevation_up, 5: relays.elevation_down}
    for pin, gpio in turns.items():
        ((_, contact),) = [pair for pair in joined(sheet) if re.match(rf"din\.{pin} ", pair[0])]
        relay = contact.removeprefix("relays.K").removesuffix(" NO")
        assert gpio_at(sheet, f"relays.IN{relay}") == gpio
    assert ("din.8 ground", "last.a") in joined(sheet)
    assert ("din.6 azimuth volts", "upper 6.a") in joined(sheet)
    assert ("din.1 elevation volts", "upper 1.a") in joined(sheet)


@pytest.mark.parametrize("name", ["f1efw", "g5500", "spid"])
def test_the_heartbeats_pin_is_free_in_every_profile(name: str) -> None:
    values = profile(name).model_dump()
    values["relays"]["heartbeat"] = one_shot.HEARTBEAT_GPIO
    assert Config.model_validate(values).relays.heartbeat == one_shot.HEARTBEAT_GPIO


def test_the_header_is_the_one_in_the_table_of_the_wiring_page() -> None:
    page = (IMAGES.parent / "wiring.md").read_text(encoding="utf-8")
    rows = re.findall(r"\| (\d+)(?: \(S\w+\))? \| (\d+) \|", page)
    assert len(rows) >= 13
    assert all(GPIO_PINS[int(gpio)] == int(pin) for gpio, pin in rows)


def boxes(*wires: tuple[str, str], gap: int = 200) -> Sheet:
    sheet = Sheet("test", "two boxes", 400)
    sheet.put(chip("a", "A", (100, 100), 100, right=["1", "2"]), chip("b", "B", (200 + gap, 100), 100, ["1", "2"]))
    for pins in wires:
        sheet.wire("black", *pins)
    return sheet


def test_wires_that_must_cross_do_so_at_right_angles() -> None:
    sheet = boxes(("a.1", "b.2"), ("a.2", "b.1"))
    assert complaints(sheet, route(sheet)) == []


def test_a_wire_goes_round_a_part_in_its_way() -> None:
    sheet = boxes(("a.1", "b.1"))
    sheet.put(chip("wall", "in the way", (280, 90), 60))
    wires = route(sheet)
    assert len(wires[0].paths[0]) > 2
    assert not [text for text in complaints(sheet, wires) if "runs through" in text]


def test_parts_too_close_are_said_to_be() -> None:
    with pytest.raises(NoWay, match=r"no way from a\.1 to b\.2"):
        route(boxes(("a.1", "b.2"), gap=10))


def test_a_wire_drawn_straight_through_a_part_is_noticed() -> None:
    sheet = boxes(("a.1", "b.1"))
    sheet.put(chip("wall", "wall", (250, 100), 100))
    (one, other) = (sheet.pin(name).at for name in ("a.1", "b.1"))
    wires = [Routed(Net("black", ("a.1", "b.1")), [(one, other)])]
    assert "the wire of a.1 runs through wall" in complaints(sheet, wires)


def test_wires_along_each_other_and_wires_that_end_nowhere_are_noticed() -> None:
    sheet = boxes(("a.1", "b.1"), ("a.2", "b.2"))
    one, other = sheet.pin("a.1").at, sheet.pin("b.1").at
    wires = [Routed(net, [(one, other)]) for net in sheet.nets]
    assert {text for text in complaints(sheet, wires) if "touch" in text or "reaches" in text} == {
        f"the wires of a.1 and a.2 touch at {one}",
        "no wire reaches a.2",
        "no wire reaches b.2",
    }
