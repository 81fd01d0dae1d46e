"""`rotator setup pins`: the relay lines off from power-on, on every board that builders use."""

from __future__ import annotations

import pytest

from tests.setup.conftest import BOOKWORM, ROTATOR, Card


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


def test_other_pins_take_the_place_of_the_old_ones(card: Card) -> None:
    card.boot.write_text(f"# mine\n{BOOKWORM}")
    card.setup("pins", "--yes")
    card.boot.write_text("# above\n" + card.boot.read_text())
    card.rotator.write_text(relays("azimuth_cw = 26"))
    card.setup("pins", "--yes")
    wanted = block("gpio=26,23,24,25=op,dl", "dtparam=strict_gpiod", "dtparam=i2c_arm=on")
    assert card.boot.read_text() == f"# above\n{wanted}# mine\n{BOOKWORM}"


def test_both_setups_leave_in_either_order(card: Card) -> None:
    before = card.files()
    for first, second in (("pins", "usb-serial"), ("usb-serial", "pins")):
        card.setup("pins", "--yes")
        card.setup("usb-serial", "--yes")
        card.setup(first, "--undo", "--yes")
        card.setup(second, "--undo", "--yes")
        assert card.files() == before


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


def of(kind: str, *lines: str) -> str:
    limits = "[azimuth]\nmin_deg = 0\nmax_deg = 180\n[elevation]\nmin_deg = 0\nmax_deg = 90"
    return "\n".join(['[rotor]\nhardware = "pi"', f'type = "{kind}"', limits, '[lcd]\nkind = "none"', *lines, ""])


STRICT, I2C, SPI, NO_LCD = "dtparam=strict_gpiod", "dtparam=i2c_arm=on", "dtparam=spi=on", '[lcd]\nkind = "none"'
LOW = 'active = "low"\nazimuth_cw = 4\nazimuth_ccw = 5\nelevation_up = 6\nelevation_down = 7'


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (relays("master = 16", NO_LCD), ["gpio=22,23,24,25,16=op,dl", STRICT, I2C]),
        (relays("master = 16\nheartbeat = 26", NO_LCD), ["gpio=22,23,24,25,16,26=op,dl", STRICT, I2C]),
        (relays(LOW, NO_LCD), ["gpio=4,5,6,7=op,dh", STRICT, I2C]),
        (relays(LOW, "master = 8\nheartbeat = 26", NO_LCD), ["gpio=26=op,dl", "gpio=4,5,6,7,8=op,dh", STRICT, I2C]),
        (relays("heartbeat = 4"), ["gpio=22,23,24,25,4=op,dl", STRICT, I2C]),
        (ROTATOR + "[adc]\nbus = 3\n", ["gpio=22,23,24,25=op,dl", STRICT]),
        (of("relay-pulse"), ["gpio=22,23,24,25=op,dl", STRICT]),
        (of("digipot", "[digipot]\nenable = 16"), ["gpio=16=op,dl", STRICT]),
        (of("digipot", '[digipot]\nspi = "kernel"\nenable = 16'), ["gpio=16=op,dl", STRICT, SPI]),
        # OE is active low. A program's death need not make the servos limp: no strict_gpiod
        (of("servo", "[servo]\nenable = 26"), ["gpio=26=op,dh", I2C]),
        (of("moteus", "[relays]\nazimuth_cw = 2"), []),
    ],
)
def test_all_lines_of_a_rotor_are_at_their_off_level(card: Card, text: str, wanted: list[str]) -> None:
    card.rotator.write_text(text)
    said = card.setup("pins", "--yes")
    assert said.code == 0
    assert "WARNING" not in said.text
    assert card.boot.read_text() == (block(*wanted) if wanted else "") + BOOKWORM
    assert (card.root / "etc/modules-load.d/rotator-pins.conf").exists() is (I2C in wanted)


@pytest.mark.parametrize(
    ("text", "config_line", "said"),
    [
        (relays("azimuth_cw = 2"), "", "relays.azimuth_cw = 2 is a pin of the I2C bus of the box's own chips"),
        (relays("azimuth_cw = 9"), SPI, "is a pin of the SPI bus (config.txt, line 24, dtparam=spi=on)"),
        (
            relays("azimuth_cw = 15"),
            "enable_uart=1",
            "is a pin of the serial port (config.txt, line 24, enable_uart=1)",
        ),
        (relays("heartbeat = 14"), "dtparam=uart0=on", "relays.heartbeat = 14 is a pin of the serial port"),
        (relays("master = 14"), "dtoverlay=disable-bt", "relays.master = 14 is a pin of the serial port"),
        (relays("azimuth_cw = 0"), "", "ID EEPROM"),
        (relays("azimuth_cw = 28"), "", "not on the 40-pin header"),
        (
            of("digipot", '[digipot]\nspi = "kernel"\nenable = 9'),
            "",
            "digipot.enable = 9 is a pin of the SPI bus of the digital pots",
        ),
    ],
)
def test_pins_with_another_trade_are_refused(card: Card, text: str, config_line: str, said: str) -> None:
    card.rotator.write_text(text)
    card.boot.write_text(f"{BOOKWORM}{config_line}\n")
    answer = card.setup("pins", "--yes")
    assert answer.code == 1
    assert said in answer.text
    assert card.copies() == []


@pytest.mark.parametrize(
    ("text", "config_line"),
    [
        (relays("azimuth_cw = 9", "azimuth_ccw = 10", "elevation_up = 11", "elevation_down = 15"), ""),
        (ROTATOR, "gpio=22=pd"),
        (ROTATOR, "[pi5]\ngpio=22=ip"),
        (ROTATOR, "#gpio=22=op,dh"),
        (ROTATOR, "gpio=17=ip"),
    ],
)
def test_what_is_in_nobodys_way_is_done(card: Card, text: str, config_line: str) -> None:
    card.rotator.write_text(text)
    card.boot.write_text(f"{BOOKWORM}{config_line}\n")
    assert card.setup("pins", "--yes").code == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (relays("azimuth_cw = 4"), "WARNING: GPIO 4: pulled up at power-on"),
        (relays('active = "low"'), "WARNING: GPIO 22, 23, 24, 25: pulled down at power-on"),
        (of("digipot", "[digipot]\nenable = 4"), "WARNING: GPIO 4: pulled up at power-on"),
    ],
)
def test_a_pull_that_closes_the_relay_is_warned_of(card: Card, text: str, said: str) -> None:
    card.rotator.write_text(text)
    answer = card.setup("pins", "--yes")
    assert answer.code == 0
    assert said in answer.text
    assert "10 kΩ" in answer.text
