"""A configuration file: one without a fault, one with a single fault in words, and what is no such file."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import get_args

import pytest

from rotator.config.links import ProtocolName
from rotator.config.load import ConfigError, load, parse, shipped
from rotator.config.model import Config
from tests.config.texts import FIRST, faults

LINK = '[[link]]\nprotocol = "gs232b"\npty = "run/gs232"\n'


# --- a good file


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


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[rotor]\nhardwear = "pi"\n', 'rotor.hardwear = "pi": no such key; did you mean hardware?'),
        ("[sim.azimuth]\nspeed = 6\n", "sim.azimuth.speed = 6: no such key; did you mean speed_dps?"),
        (LINK + "buad = 9600\n", "the first [[link]]: buad = 9600: no such key; did you mean baud?"),
        ("[qqq]\nx = 1\n", "[qqq]: no such table; there are rotor, azimuth, "),
        ('[rotor]\nname = "Dachständer"\n', 'rotor.name = "Dachständer": no such key; known here: type, hardware'),
        ("[mount]\nqqq = 1\n", "mount.qqq = 1: no such key; known here: flip, "),
    ],
)
def test_a_name_that_is_none_gets_the_nearest_or_all_that_there_are(text: str, said: str) -> None:
    (fault,) = faults(text)
    assert fault.startswith(said)


def test_a_long_value_is_not_shown_whole() -> None:
    (fault,) = faults(f"[azimuth]\ntolerance_deg = '{'x' * 500}'\n")
    assert len(fault) < 120
    assert fault.endswith("...: must be a number")


# --- files that are none


@pytest.mark.parametrize(
    ("there", "name", "said"),
    [
        ("other.toml", "none.toml", r"there is no such file: `rotator config --ask --to .*none\.toml` writes it"),
        ("rotator.toml", "rotater.toml", r"did you mean .*/rotator\.toml\?"),
        # The ending, which all have, makes no two names alike.
        ("spid.toml", "missing.toml", "there is no such file: `rotator config --ask"),
        ("other.toml", ".", "is a folder: name the file in it"),
    ],
)
def test_not_there(tmp_path: Path, there: str, name: str, said: str) -> None:
    (tmp_path / there).write_text(LINK)
    with pytest.raises(ConfigError, match=said):
        load(tmp_path / name)


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


# --- many faults

SENSORS = "[azimuth.sensor]\nkind = 'as5600'\nbus = {bus}\n[elevation.sensor]\nkind = 'as5600'\n"

# --- several at once


def test_every_fault_at_once() -> None:
    text = """
    [rotor]
    hardware = "pie"
    [azimuth]
    tolerance_deg = -1
    tolerence_deg = 4
    [elevation]
    min_deg = 90
    max_deg = 0
    [relays]
    azimuth_cw = "22"
    [[link]]
    protocol = "gs232"
    pty = "x"
    [[link]]
    protocol = "rotctld"
    tcp = "4533"
    """
    with pytest.raises(ConfigError) as refused:
        parse(text, "station.toml")
    first, *rest = str(refused.value).splitlines()
    assert first == "station.toml: 7 mistakes"
    assert all(line.startswith("  ") for line in rest)
    numbers = [int(line.split(":")[0].split()[-1]) for line in rest]
    assert numbers == sorted(numbers), "in the order of the file"
    found = {re.sub(r"^ *lines? [\d and]+: ", "", line) for line in rest if "no such key" not in line}
    assert found == {
        'rotor.hardware = "pie": must be one of sim, pi; did you mean pi?',
        "azimuth.tolerance_deg = -1: must be greater than 0",
        "elevation: min_deg (90) must be below max_deg (0): swap the two",
        'relays.azimuth_cw = "22": must be a whole number',
        FIRST + 'protocol = "gs232": must be one of gs232a, gs232b, gs232-f1efw, rotctld, rotctld-follow, easycomm1, '
        "easycomm2, easycomm3, rot1prog, rot2prog, md01, dcu1, pstrotator, n1mm, macdoppler, wsjtx, "
        "lx200, stellarium, pstrotatoraz, prosistel-d, prosistel-c, rc2800; "
        "did you mean gs232b?",
        'the second [[link]]: tcp: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
    }
    assert any(
        line.endswith("  line 6: azimuth.tolerence_deg = 4: no such key; did you mean tolerance_deg?") for line in rest
    )


def test_a_rule_over_a_key_with_a_mistake_is_not_told_before_the_mistake_is_mended() -> None:
    """The latitude is given: nothing is missing beside the longitude."""
    with pytest.raises(ConfigError) as refused:
        parse("[station]\nlatitude_deg = 91\nlongitude_deg = 2\n[azimuth]\nmin_deg = 500\nmax_deg = 'x'\n", "a.toml")
    assert [str(each).split(" = ")[0] for each in refused.value.mistakes] == [
        "line 2: station.latitude_deg",
        "line 6: azimuth.max_deg",
    ]


def test_rules_over_several_keys_are_told_once_each_of_them_is_good() -> None:
    """Limits are compared only once both are numbers, links only once each is one, pins only at the end."""
    text = (
        "[azimuth]\nmin_deg = 300\nmax_deg = 200\n{}"
        "[relays]\nazimuth_cw = 24\n"
        "[[link]]\nprotocol = 'rotctld'\npty = 'a'\n[[link]]\nprotocol = 'gs232a'\npty = 'a'\n"
    )
    assert faults(text.format("tolerance_deg = 'x'\n")) == ['azimuth.tolerance_deg = "x": must be a number']
    assert faults(text.format("")) == ["azimuth: min_deg (300) must be below max_deg (200): swap the two"]
    whole = "\n".join(faults(text.format("").replace("300", "100")))
    assert "GPIO 24 is used by relays.azimuth_cw and relays.elevation_up" in whole
    assert "2 links use a" in whole


# --- used twice


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[relays]\nazimuth_ccw = 22\n", "GPIO 22 is used by relays.azimuth_cw and relays.azimuth_ccw"),
        ("[relays]\nmaster = 25\n", "GPIO 25 is used by relays.elevation_down and relays.master"),
        ("[lcd]\nkind = 'gpio'\nrs = 22\n", "GPIO 22 is used by relays.azimuth_cw and lcd.rs"),
        ("[lcd]\nkind = 'gpio'\nd4 = 6\n", "GPIO 6 is used by lcd.d4 and lcd.d5"),
        (SENSORS.format(bus=1), "elevation.sensor.address and azimuth.sensor.address are both 0x36 on bus 1"),
        (LINK * 2, "2 links use run/gs232: the first [[link]] and the second [[link]]: give one of them another place"),
        (
            LINK * 3,
            "3 links use run/gs232: the first [[link]] and the second [[link]] and "
            "the third [[link]]: give one of them another place",
        ),
        (
            "[adc]\nelevation_channel = 0\n",
            "adc: azimuth_channel, elevation_channel and reference_channel must differ",
        ),
    ],
)
def test_nothing_is_used_twice(text: str, said: str) -> None:
    assert faults(text) == [said]


@pytest.mark.parametrize(
    "text",
    [
        "[lcd]\nkind = 'pcf8574'\nrs = 22\n",
        "[lcd]\nkind = 'none'\nrs = 22\naddress = 0x48\n",
        SENSORS.format(bus=0),
    ],
)
def test_what_is_not_used_may_be_the_same(text: str) -> None:
    parse(text, "x")
