"""A configuration file: one without a fault, one with a single fault in words, and what is no such file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import get_args

import pytest

from rotator.config.links import FOLLOW, ProtocolName
from rotator.config.load import ConfigError, load, parse, shipped
from rotator.config.model import Config
from tests.config.texts import faults

LINK = '[[link]]\nprotocol = "gs232b"\npty = "run/gs232"\n'


def test_it_says_which_file_is_mistaken() -> None:
    with pytest.raises(ConfigError) as refused:
        parse("[rotr]", "station.toml")
    assert refused.value.name == "station.toml"


# --- a good file


def test_an_empty_file_is_a_good_one() -> None:
    assert parse("", "empty") == Config()


def test_the_shipped_file_says_what_the_defaults_are() -> None:
    config = load(None)
    assert config.model_copy(update={"link": []}) == Config()
    assert [(link.protocol, link.pty or link.tcp) for link in config.link] == [
        ("gs232b", "run/gs232"),
        ("rotctld", "127.0.0.1:4533"),
    ]


def test_the_keys_that_others_rely_on() -> None:
    """A G-5500 as everybody simulates it."""
    config = Config()
    assert (config.rotor.type, config.rotor.hardware, config.mount.flip) == ("relay-pot", "sim", "off")
    azimuth, elevation = config.azimuth, config.elevation
    assert (azimuth.min_deg, azimuth.max_deg, azimuth.tolerance_deg) == (0, 450, 4)
    assert (elevation.min_deg, elevation.max_deg, elevation.tolerance_deg) == (0, 180, 4)
    assert config.sim.azimuth.model_dump(exclude={"start_deg"}) == {
        "speed_dps": 6.0,
        "lag_s": 0.15,
        "relay_delay_s": 0.015,
        "backlash_deg": 0.5,
        "pot_noise_deg": 0.1,
        "pot_bow_deg": 0.0,
    }
    assert config.sim.elevation.speed_dps == 2.7
    assert parse('[[link]]\nprotocol = "gs232a"\nserial = "/dev/ttyGS0"\n', "x").link[0].serial_baud == 9600


def test_whole_numbers_are_numbers() -> None:
    assert parse("[azimuth]\ntolerance_deg = 2\ncalibration = [[0, 0], [1, 360]]\n", "x").azimuth.tolerance_deg == 2


@pytest.mark.parametrize(
    ("link", "baud"),
    [
        ('protocol = "gs232b"', 9600),
        ('protocol = "easycomm2"', 9600),
        ('protocol = "md01"', 9600),
        ('protocol = "dcu1"', 4800),
        ('protocol = "rot1prog"', 1200),
        ('protocol = "rot2prog"', 600),
        ('protocol = "rot2prog"\nbaud = 9600', 9600),
    ],
)
def test_a_makers_own_speed_unless_another_is_given(link: str, baud: int) -> None:
    assert parse(f'[[link]]\n{link}\nserial = "/dev/ttyGS0"\n', "x").link[0].serial_baud == baud


ONE_PLACE = (FOLLOW, "pstrotator", "n1mm", "macdoppler", "wsjtx", "stellarium", "pstrotatoraz")


@pytest.mark.parametrize("protocol", [name for name in get_args(ProtocolName) if name not in ONE_PLACE])
@pytest.mark.parametrize("place", ['pty = "x"', 'serial = "/dev/ttyUSB0"', 'tcp = "[::1]:4533"'])
def test_any_protocol_on_any_link(protocol: str, place: str) -> None:
    text = f'[station]\nlocator = "JO62qm"\n[[link]]\nprotocol = "{protocol}"\n{place}\n'
    assert parse(text, "x").link[0].where in place


def test_it_may_be_read_by_path(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(shipped(), encoding="utf-8")
    assert load(path) == load(None)


# --- one fault, in words


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[azimuth]\ntolerance_deg = 'four'\n", 'azimuth.tolerance_deg = "four": must be a number'),
        ("[azimuth]\ntolerance_deg = 0\n", "azimuth.tolerance_deg = 0: must be greater than 0"),
        ("[azimuth]\ntolerance_deg = 46\n", "azimuth.tolerance_deg = 46: must be less than or equal to 45"),
        ("[azimuth]\nmin_deg = nan\n", "azimuth.min_deg = nan: must be a finite number"),
        ("[azimuth]\nmin_deg = true\n", "azimuth.min_deg = true: must be a number"),
        ("[relays]\nazimuth_cw = 2.5\n", "relays.azimuth_cw = 2.5: must be a whole number"),
        ("[relays]\nazimuth_cw = 58\n", "relays.azimuth_cw = 58: must be less than or equal to 57"),
        (
            "[azimuth]\ndirection_checked = 'yes'\n",
            'azimuth.direction_checked = "yes": must be true or false',
        ),
        ("[relays]\nchip = 0\n", "relays.chip = 0: must be text in quotes"),
        ("azimuth = 4\n", "azimuth = 4: must be a table"),
        ("link = 4\n", "link = 4: must be a list in brackets"),
        ("[azimuth]\ncalibration = 1\n", "azimuth.calibration = 1: must be a list in brackets"),
        (
            "[relays]\nactive = 'hihg'\n",
            'relays.active = "hihg": must be one of high, low; did you mean high?',
        ),
        ("[adc]\nrate_sps = 100\n", "adc.rate_sps = 100: must be one of 128, 250, 475, 860"),
        (
            "[[link]]\npty = 'x'\n",
            "the first [[link]]: protocol: must be given, one of " + ", ".join(get_args(ProtocolName)),
        ),
        ("[[link]]\nprotocol = 'rotctld'\n", "the first [[link]]: must have exactly one of pty, serial, tcp"),
        (
            "[[link]]\nprotocol = 'rotctld'\npty = 'x'\ntcp = 'localhost:1'\n",
            "the first [[link]]: must have exactly one of pty, serial, tcp",
        ),
        (
            "[[link]]\nprotocol = 'rotctld'\ntcp = '4533'\n",
            'the first [[link]]: tcp: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
        ),
        ("[azimuth]\nmin_deg = 360\nmax_deg = 0\n", "azimuth: min_deg (360) must be below max_deg (0): swap the two"),
        (
            "[azimuth]\nmax_deg = -10\n",
            "azimuth: min_deg (0) must be below max_deg (-10); the file leaves min_deg out: "
            "write a greater max_deg, or a min_deg below it",
        ),
        (
            "[azimuth]\nmin_deg = 450\n",
            "azimuth: min_deg (450) must be below max_deg (450); the file leaves max_deg out: "
            "write a lower min_deg, or a max_deg above it",
        ),
        (
            "[azimuth]\nmin_deg = 0\nmax_deg = 0\n",
            "azimuth: min_deg (0) must be below max_deg (0): write both stops of the rotor",
        ),
        (
            "[azimuth]\ncalibration = [[0.1, 0]]\n",
            "azimuth: calibration needs two points or more, each [reading, degrees]",
        ),
        (
            "[azimuth]\ncalibration = [[0.1, 0], [0.9, 0]]\n",
            "azimuth: calibration: degrees must rise from point to point",
        ),
        (
            "[azimuth]\ncalibration = [[0.1, 0], [0.5, 90], [0.4, 180]]\n",
            "azimuth: calibration: readings must rise, or fall, all the way",
        ),
    ],
)
def test_one_fault(text: str, said: str) -> None:
    assert faults(text) == [said]


def test_a_misspelt_key_gets_a_suggestion() -> None:
    (fault,) = faults('[rotor]\nhardwear = "pi"\n')
    assert fault == 'rotor.hardwear = "pi": no such key; did you mean hardware?'


@pytest.mark.parametrize(
    ("text", "key", "meant"),
    [
        ("[sim.azimuth]\nspeed = 6\n", "sim.azimuth.speed", "speed_dps"),
        (LINK + "buad = 9600\n", "the first [[link]]: buad", "baud"),
    ],
)
def test_wherever_it_is_misspelt(text: str, key: str, meant: str) -> None:
    (fault,) = faults(text)
    assert fault.startswith(f"{key} = ")
    assert fault.endswith(f": no such key; did you mean {meant}?")


def test_a_heading_like_no_other() -> None:
    (said,) = faults("[qqq]\nx = 1\n")
    assert said.startswith("[qqq]: no such table; there are rotor, azimuth, ")


def test_a_key_of_a_table_with_few_names_them_all() -> None:
    (said,) = faults('[rotor]\nname = "Dachständer"\n')
    assert said == 'rotor.name = "Dachständer": no such key; known here: type, hardware'


def test_a_key_like_no_other_gets_no_suggestion() -> None:
    (fault,) = faults("[mount]\nqqq = 1\n")
    assert fault.startswith("mount.qqq = 1: no such key; known here: flip, ")


def test_a_long_value_is_not_shown_whole() -> None:
    (fault,) = faults(f"[azimuth]\ntolerance_deg = '{'x' * 500}'\n")
    assert len(fault) < 120
    assert fault.endswith("...: must be a number")


# --- files that are none


def test_not_there(tmp_path: Path) -> None:
    path = tmp_path / "none.toml"
    with pytest.raises(ConfigError, match=r"there is no such file: `rotator config --ask --to .*none\.toml` writes it"):
        load(path)


def test_not_there_but_one_like_it(tmp_path: Path) -> None:
    (tmp_path / "rotator.toml").write_text(LINK)
    with pytest.raises(ConfigError, match=r"did you mean .*/rotator\.toml\?"):
        load(tmp_path / "rotater.toml")


def test_not_there_and_nothing_like_it(tmp_path: Path) -> None:
    """The ending, which all have, makes no two names alike."""
    (tmp_path / "spid.toml").write_text(LINK)
    with pytest.raises(ConfigError, match=r"there is no such file: `rotator config --ask"):
        load(tmp_path / "missing.toml")


def test_a_folder(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="is a folder: name the file in it"):
        load(tmp_path)


def test_another_persons_file(tmp_path: Path) -> None:
    path = tmp_path / "secret.toml"
    path.write_text(LINK)
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("root may read every file")
    with pytest.raises(ConfigError, match="you may not read it: put sudo before the command"):
        load(path)


@pytest.mark.parametrize("text", ["", "\n\n", "# all of it is a remark\n"])
def test_a_file_without_a_key(tmp_path: Path, text: str) -> None:
    """As a shell leaves it when the command before `>` has failed: it is no simulated rotor that somebody wants."""
    path = tmp_path / "empty.toml"
    path.write_text(text)
    with pytest.raises(ConfigError, match="is empty: `rotator config --ask --to "):
        load(path)


@pytest.mark.parametrize("digits", ["9" * 5000, "1_0" * 3000])
def test_a_number_that_never_ends(digits: str) -> None:
    with pytest.raises(ConfigError, match="line 2: a number has thousands of digits"):
        parse(f"[azimuth]\nmax_deg = {digits}\n", "x")
