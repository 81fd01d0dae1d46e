"""`rotator setup pins`: the relay lines off from power-on, on every board that builders use."""

from __future__ import annotations

import pytest
from hypothesis import given

from rotator.config.load import parse
from rotator.setup.pins import BLOCK, off_levels
from tests.setup.conftest import BOOKWORM, ROTATOR, Card
from tests.setup.test_blocks import ANY_FILE

NO_ADC_ON_THE_HEADER = "[adc]\nbus = 3\n"


def block(*lines: str) -> str:
    return "\n".join(["# rotator setup pins: begin", "[all]", *lines, "# rotator setup pins: end", ""])


def relays(*lines: str) -> str:
    return "\n".join([ROTATOR, "[relays]", *lines, ""])


def test_the_default_pins(shipped: Card) -> None:
    before = shipped.boot.read_text()
    said = shipped.setup("pins", "--yes")
    assert said.code == 0
    assert "WARNING" not in said.text
    assert "takes effect when the Pi starts from this card" in said.text
    assert shipped.boot.read_text() == (
        block("gpio=22,23,24,25=op,dl", "dtparam=strict_gpiod", "dtparam=i2c_arm=on") + before
    )
    assert "i2c-dev\n" in (shipped.root / "etc/modules-load.d/rotator-pins.conf").read_text()


@pytest.mark.parametrize(
    ("lines", "wanted"),
    [
        (["master = 16"], ["gpio=22,23,24,25,16=op,dl"]),
        (["master = 16", "heartbeat = 26"], ["gpio=22,23,24,25,16,26=op,dl"]),
        (
            ['active = "low"', "azimuth_cw = 4", "azimuth_ccw = 5", "elevation_up = 6", "elevation_down = 7"],
            ["gpio=4,5,6,7=op,dh"],
        ),
        (
            [
                'active = "low"',
                "azimuth_cw = 4",
                "azimuth_ccw = 5",
                "elevation_up = 6",
                "elevation_down = 7\nmaster = 8\nheartbeat = 26",
            ],
            ["gpio=26=op,dl", "gpio=4,5,6,7,8=op,dh"],
        ),
    ],
    ids=["master", "heartbeat", "on at low", "on at low, with a heartbeat"],
)
def test_all_lines_at_their_off_level(card: Card, lines: list[str], wanted: list[str]) -> None:
    card.rotator.write_text(relays(*lines, '[lcd]\nkind = "none"'))
    said = card.setup("pins", "--yes")
    assert "WARNING" not in said.text
    assert card.boot.read_text() == block(*wanted, "dtparam=strict_gpiod", "dtparam=i2c_arm=on") + BOOKWORM


def test_no_i2c_where_the_box_does_not_use_the_headers(card: Card) -> None:
    card.rotator.write_text(ROTATOR + NO_ADC_ON_THE_HEADER)
    card.setup("pins", "--yes")
    assert card.boot.read_text() == block("gpio=22,23,24,25=op,dl", "dtparam=strict_gpiod") + BOOKWORM
    assert not (card.root / "etc/modules-load.d/rotator-pins.conf").exists()


def test_shown_asked_and_not_done_without_a_yes(card: Card) -> None:
    before = card.files()
    said = card.setup("pins", answer="n\n")
    assert said.code == 1
    assert "+gpio=22,23,24,25=op,dl\n+dtparam=strict_gpiod\n" in said.text
    assert card.files() == before


def test_a_second_run_changes_nothing_and_says_so(card: Card) -> None:
    card.setup("pins", "--yes")
    before = card.files()
    said = card.setup("pins")
    assert (said.code, "Nothing to change" in said.text) == (0, True)
    assert card.files() == before


def test_other_pins_take_the_place_of_the_old_ones(card: Card) -> None:
    card.boot.write_text(f"# mine\n{BOOKWORM}")
    card.setup("pins", "--yes")
    card.boot.write_text("# above\n" + card.boot.read_text())
    card.rotator.write_text(relays("azimuth_cw = 26"))
    card.setup("pins", "--yes")
    wanted = block("gpio=26,23,24,25=op,dl", "dtparam=strict_gpiod", "dtparam=i2c_arm=on")
    assert card.boot.read_text() == f"# above\n{wanted}# mine\n{BOOKWORM}"


def test_undo_needs_no_configuration(shipped: Card) -> None:
    before = shipped.files()
    shipped.setup("pins", "--yes")
    toml = shipped.rotator.read_text()
    shipped.rotator.unlink()
    assert shipped.setup("pins", "--undo", "--yes").code == 0
    shipped.rotator.write_text(toml)
    assert shipped.files() == before


def test_both_setups_leave_in_either_order(card: Card) -> None:
    before = card.files()
    for first, second in (("pins", "usb-serial"), ("usb-serial", "pins")):
        card.setup("pins", "--yes")
        card.setup("usb-serial", "--yes")
        card.setup(first, "--undo", "--yes")
        card.setup(second, "--undo", "--yes")
        assert card.files() == before


@given(text=ANY_FILE)
def test_any_config_txt_comes_back_byte_for_byte(text: str) -> None:
    lines = ["[all]", "gpio=22,23=op,dl", "gpio=4=op,dh", "dtparam=strict_gpiod", "dtparam=i2c_arm=on"]
    assert BLOCK.without(BLOCK.into(text, lines)) == text


@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
@pytest.mark.parametrize("at_end", ["", "\n"])
def test_windows_lines_and_a_missing_last_line_feed_stay(card: Card, line_end: str, at_end: str) -> None:
    text = f"a=1{line_end}[cm4]{line_end}otg_mode=1{at_end and line_end}".encode()
    card.boot.write_bytes(text)
    card.setup("pins", "--yes")
    during = card.boot.read_bytes()
    assert during.endswith(text)
    assert during.count(b"\r\n") == (during.count(b"\n") if line_end == "\r\n" else 0)
    card.setup("pins", "--undo", "--yes")
    assert card.boot.read_bytes() == text


def test_bytes_that_are_no_text_stay(card: Card) -> None:
    card.boot.write_bytes(b"# caf\xe9 \x00\n")
    card.setup("pins", "--yes")
    assert card.boot.read_bytes().endswith(b"# caf\xe9 \x00\n")
    card.setup("pins", "--undo", "--yes")
    assert card.boot.read_bytes() == b"# caf\xe9 \x00\n"


def test_what_is_in_force_already_is_not_said_twice(card: Card) -> None:
    card.boot.write_text(BOOKWORM + "dtparam=i2c_arm=on,strict_gpiod\ngpio=22-24=op,dl\n")
    card.setup("pins", "--yes")
    assert card.boot.read_text().startswith(block("gpio=25=op,dl"))


@pytest.mark.parametrize("section", ["[pi5]", "[pi4]", "[gpio4=1]"])
def test_what_is_in_force_under_a_condition_is(card: Card, section: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{section}\ngpio=22,23,24,25=op,dl\n")
    card.setup("pins", "--yes")
    assert "\ngpio=22,23,24,25=op,dl\ndtparam" in card.boot.read_text()


@pytest.mark.parametrize(
    "line", ["gpio=22=op,dh", "gpio=20-30=ip,pd", "gpio=25=a0", "dtparam=strict_gpiod=off", "dtparam=i2c_arm=off"]
)
def test_a_line_that_says_otherwise_is_left_to_the_person(card: Card, line: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{line}\n")
    before = card.files()
    said = card.setup("pins", "--yes")
    assert said.code == 1
    assert f"says otherwise (line 24, {line})" in said.text
    assert card.files() == before


@pytest.mark.parametrize("line", ["gpio=22=pd", "[pi5]\ngpio=22=ip", "#gpio=22=op,dh", "gpio=17=ip"])
def test_a_line_that_does_not(card: Card, line: str) -> None:
    card.boot.write_text(f"{BOOKWORM}{line}\n")
    assert card.setup("pins", "--yes").code == 0


@pytest.mark.parametrize(
    ("keys", "config_line", "said"),
    [
        ("azimuth_cw = 2", "", "relays.azimuth_cw = 2 is a pin of the I2C bus of the box's own chips"),
        ("azimuth_cw = 9", "dtparam=spi=on", "is a pin of the SPI bus (config.txt, line 24, dtparam=spi=on)"),
        ("azimuth_cw = 15", "enable_uart=1", "is a pin of the serial port (config.txt, line 24, enable_uart=1)"),
        ("heartbeat = 14", "dtparam=uart0=on", "relays.heartbeat = 14 is a pin of the serial port"),
        ("master = 14", "dtoverlay=disable-bt", "relays.master = 14 is a pin of the serial port"),
        ("azimuth_cw = 0", "", "ID EEPROM"),
        ("azimuth_cw = 28", "", "not on the 40-pin header"),
    ],
)
def test_pins_with_another_trade_are_refused(card: Card, keys: str, config_line: str, said: str) -> None:
    card.rotator.write_text(relays(keys))
    card.boot.write_text(f"{BOOKWORM}{config_line}\n")
    answer = card.setup("pins", "--yes")
    assert answer.code == 1
    assert said in answer.text
    assert card.copies() == []


def test_those_pins_are_free_while_the_bus_is_off(card: Card) -> None:
    card.rotator.write_text(relays("azimuth_cw = 9", "azimuth_ccw = 10", "elevation_up = 11", "elevation_down = 15"))
    assert card.setup("pins", "--yes").code == 0


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (["azimuth_cw = 4"], "WARNING: GPIO 4: pulled up at power-on"),
        (['active = "low"'], "WARNING: GPIO 22, 23, 24, 25: pulled down at power-on"),
    ],
)
def test_a_pull_that_closes_the_relay_is_warned_of(card: Card, lines: list[str], said: str) -> None:
    card.rotator.write_text(relays(*lines))
    answer = card.setup("pins", "--yes")
    assert answer.code == 0
    assert said in answer.text
    assert "10 kΩ" in answer.text


def test_a_heartbeat_may_be_pulled_either_way(card: Card) -> None:
    card.rotator.write_text(relays("heartbeat = 4"))
    assert "WARNING" not in card.setup("pins", "--yes").text


def test_a_simulated_rotor_has_no_pins(card: Card) -> None:
    card.rotator.write_text('[rotor]\nhardware = "sim"\n')
    said = card.setup("pins", "--yes")
    assert (said.code, 'hardware = "pi" under [rotor]' in said.text) == (1, True)


def test_a_configuration_elsewhere(card: Card) -> None:
    elsewhere = card.write("home/me/station.toml", relays("azimuth_cw = 17", '[lcd]\nkind = "none"'))
    card.rotator.unlink()
    assert "say with --config which file" in card.setup("pins", "--yes").text
    assert card.setup("pins", "--yes", "--config", str(elsewhere)).code == 0
    assert "gpio=17,23,24,25=op,dl" in card.boot.read_text()


def test_off_is_the_opposite_of_active_but_for_the_heartbeat() -> None:
    config = parse(relays('active = "low"', "heartbeat = 26"), "test")
    assert off_levels(config) == {22: "dh", 23: "dh", 24: "dh", 25: "dh", 26: "dl"}


# --- rotors without relays


def of(kind: str, *lines: str) -> str:
    limits = "[azimuth]\nmin_deg = 0\nmax_deg = 180\n[elevation]\nmin_deg = 0\nmax_deg = 90"
    return "\n".join(['[rotor]\nhardware = "pi"', f'type = "{kind}"', limits, '[lcd]\nkind = "none"', *lines, ""])


def test_the_supply_of_control_boxes_is_off_at_low(card: Card) -> None:
    card.rotator.write_text(of("digipot", "[digipot]\nenable = 16"))
    said = card.setup("pins", "--yes")
    assert "WARNING" not in said.text
    assert card.boot.read_text() == block("gpio=16=op,dl", "dtparam=strict_gpiod") + BOOKWORM


def test_the_supply_of_control_boxes_on_a_pin_that_is_pulled_up(card: Card) -> None:
    card.rotator.write_text(of("digipot", "[digipot]\nenable = 4"))
    assert "WARNING: GPIO 4: pulled up at power-on" in card.setup("pins", "--yes").text


def test_digital_pots_on_the_kernels_spi_have_it_switched_on(card: Card) -> None:
    before = card.files()
    card.rotator.write_text(of("digipot", '[digipot]\nspi = "kernel"\nenable = 16'))
    card.setup("pins", "--yes")
    wanted = block("gpio=16=op,dl", "dtparam=strict_gpiod", "dtparam=spi=on")
    assert card.boot.read_text() == wanted + BOOKWORM
    card.setup("pins", "--undo", "--yes")
    assert card.files()["boot/firmware/config.txt"] == before["boot/firmware/config.txt"]


def test_that_spi_has_its_pins(card: Card) -> None:
    card.rotator.write_text(of("digipot", '[digipot]\nspi = "kernel"\nenable = 9'))
    assert "digipot.enable = 9 is a pin of the SPI bus of the digital pots" in card.setup("pins", "--yes").text


def test_the_enable_input_of_a_servo_board_is_off_at_high(card: Card) -> None:
    # OE is active low. A program's death need not make the servos limp: no strict_gpiod
    card.rotator.write_text(of("servo", "[servo]\nenable = 26"))
    said = card.setup("pins", "--yes")
    assert "WARNING" not in said.text
    assert card.boot.read_text() == block("gpio=26=op,dh", "dtparam=i2c_arm=on") + BOOKWORM


def test_two_moteus_have_no_pin_to_be_off(card: Card) -> None:
    card.rotator.write_text(of("moteus", "[relays]\nazimuth_cw = 2"))
    said = card.setup("pins", "--yes")
    assert (said.code, "Nothing to change" in said.text) == (0, True)


def test_counting_rotors_have_the_relays_of_all_others(card: Card) -> None:
    card.rotator.write_text(of("relay-pulse"))
    card.setup("pins", "--yes")
    assert card.boot.read_text() == block("gpio=22,23,24,25=op,dl", "dtparam=strict_gpiod") + BOOKWORM
