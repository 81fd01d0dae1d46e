"""A configuration file with faults: everything that is wrong, in words, at once; and one without."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomlkit
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotator.config.load import ConfigError, load, parse, shipped
from rotator.config.model import Config

LINK = '[[link]]\nprotocol = "gs232b"\npty = "run/gs232"\n'


def faults(text: str) -> list[str]:
    with pytest.raises(ConfigError) as refused:
        parse(text, "station.toml")
    assert refused.value.name == "station.toml"
    return refused.value.faults


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
    assert parse('[[link]]\nprotocol = "gs232a"\nserial = "/dev/ttyGS0"\n', "x").link[0].baud == 9600


def test_whole_numbers_are_numbers() -> None:
    assert parse("[azimuth]\ntolerance_deg = 2\ncalibration = [[0, 0], [1, 360]]\n", "x").azimuth.tolerance_deg == 2


@pytest.mark.parametrize("protocol", ["gs232a", "gs232b", "gs232-f1efw", "rotctld"])
@pytest.mark.parametrize("place", ['pty = "x"', 'serial = "/dev/ttyUSB0"', 'tcp = "[::1]:4533"'])
def test_any_protocol_on_any_link(protocol: str, place: str) -> None:
    assert parse(f'[[link]]\nprotocol = "{protocol}"\n{place}\n', "x").link[0].where in place


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
        ("[azimuth]\nmin_deg = true\n", "azimuth.min_deg = True: must be a number"),
        ("[relays]\nazimuth_cw = 2.5\n", "relays.azimuth_cw = 2.5: must be a whole number"),
        ("[relays]\nazimuth_cw = 58\n", "relays.azimuth_cw = 58: must be less than or equal to 57"),
        ("[azimuth]\ndirection_checked = 'yes'\n", 'azimuth.direction_checked = "yes": must be true or false'),
        ("[relays]\nchip = 0\n", "relays.chip = 0: must be text in quotes"),
        ("azimuth = 4\n", "azimuth = 4: must be a table"),
        ("link = 4\n", "link = 4: must be a list in brackets"),
        ("[azimuth]\ncalibration = 1\n", "azimuth.calibration = 1: must be a list in brackets"),
        (
            "[relays]\nactive = 'hihg'\n",
            'relays.active = "hihg": must be one of high, low; did you mean high?',
        ),
        ("[adc]\nrate_sps = 100\n", "adc.rate_sps = 100: must be one of 128, 250, 475, 860"),
        ("[[link]]\npty = 'x'\n", "link[0].protocol: must be given"),
        ("[[link]]\nprotocol = 'rotctld'\n", "link[0]: must have exactly one of pty, serial, tcp"),
        (
            "[[link]]\nprotocol = 'rotctld'\npty = 'x'\ntcp = 'localhost:1'\n",
            "link[0]: must have exactly one of pty, serial, tcp",
        ),
        (
            "[[link]]\nprotocol = 'rotctld'\ntcp = '4533'\n",
            'link[0].tcp: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
        ),
        ("[azimuth]\nmin_deg = 360\nmax_deg = 0\n", "azimuth: min_deg (360) must be below max_deg (0)"),
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


def test_a_misspelt_key_gets_a_suggestion_and_the_list() -> None:
    (fault,) = faults('[rotor]\nhardwear = "pi"\n')
    assert fault == 'rotor.hardwear = "pi": no such key; did you mean hardware?; known here: type, hardware'


@pytest.mark.parametrize(
    ("text", "key", "meant"),
    [
        ("[azimut]\nmin_deg = 0\n", "azimut", "azimuth"),
        ("[sim.azimuth]\nspeed = 6\n", "sim.azimuth.speed", "speed_dps"),
        ("[sim.elevatoin]\nspeed_dps = 6\n", "sim.elevatoin", "elevation"),
        (LINK + "buad = 9600\n", "link[0].buad", "baud"),
    ],
)
def test_wherever_it_is_misspelt(text: str, key: str, meant: str) -> None:
    (fault,) = faults(text)
    assert fault.startswith(f"{key} = ")
    assert f": no such key; did you mean {meant}?; known here: " in fault


def test_a_key_like_no_other_gets_no_suggestion() -> None:
    (fault,) = faults("[mount]\nqqq = 1\n")
    assert fault.startswith("mount.qqq = 1: no such key; known here: flip, ")


def test_a_long_value_is_not_shown_whole() -> None:
    (fault,) = faults(f"[azimuth]\ntolerance_deg = '{'x' * 500}'\n")
    assert len(fault) < 120
    assert fault.endswith("...: must be a number")


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
    assert first == "station.toml: 7 faults"
    assert all(line.startswith("  ") for line in rest)
    found = {line.strip() for line in rest if "no such key" not in line}
    assert found == {
        'rotor.hardware = "pie": must be one of sim, pi; did you mean pi?',
        "azimuth.tolerance_deg = -1: must be greater than 0",
        "elevation: min_deg (90) must be below max_deg (0)",
        'relays.azimuth_cw = "22": must be a whole number',
        'link[0].protocol = "gs232": must be one of gs232a, gs232b, gs232-f1efw, rotctld; did you mean gs232b?',
        'link[1].tcp: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
    }
    assert any(
        line.startswith("  azimuth.tolerence_deg = 4: no such key; did you mean tolerance_deg?") for line in rest
    )


def test_a_single_fault_is_one_fault() -> None:
    with pytest.raises(ConfigError) as refused:
        parse("[azimuth]\ntolerance_deg = -1\n", "a.toml")
    assert str(refused.value) == "a.toml: 1 fault\n  azimuth.tolerance_deg = -1: must be greater than 0"


def test_one_fault_does_not_hide_another() -> None:
    """Limits are compared only once both are numbers, links only once each is one, pins only at the end."""
    found = faults(
        "[azimuth]\nmin_deg = 300\nmax_deg = 200\ntolerance_deg = 'x'\n"
        "[relays]\nazimuth_cw = 24\ndead_time_s = 9\n"
        "[[link]]\nprotocol = 'nonsense'\n"
        "[[link]]\nprotocol = 'rotctld'\npty = 'a'\n"
        "[[link]]\nprotocol = 'gs232a'\npty = 'a'\n"
    )
    text = "\n".join(found)
    for fault in (
        'azimuth.tolerance_deg = "x": must be a number',
        "azimuth: min_deg (300) must be below max_deg (200)",
        "relays.dead_time_s = 9: must be less than or equal to 5",
        'link[0].protocol = "nonsense": must be one of',
        "link[0]: must have exactly one of pty, serial, tcp",
        "GPIO 24 is used by relays.azimuth_cw and relays.elevation_up",
        "2 links use a",
    ):
        assert fault in text


def test_no_fault_is_told_twice() -> None:
    found = faults("[azimuth]\nx = 1\nmin_deg = 9\nmax_deg = 1\n[elevation]\nx = 1\nmin_deg = 9\nmax_deg = 1\n")
    assert len(found) == len(set(found)) == 4


# --- used twice


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[relays]\nazimuth_ccw = 22\n", "GPIO 22 is used by relays.azimuth_cw and relays.azimuth_ccw"),
        ("[relays]\nmaster = 25\n", "GPIO 25 is used by relays.elevation_down and relays.master"),
        ("[lcd]\nkind = 'gpio'\nrs = 22\n", "GPIO 22 is used by relays.azimuth_cw and lcd.rs"),
        ("[lcd]\nkind = 'gpio'\nd4 = 6\n", "GPIO 6 is used by lcd.d4 and lcd.d5"),
        ("[lcd]\nkind = 'pcf8574'\naddress = 0x48\n", "lcd.address and adc.address are both 0x48 on bus 1"),
        (LINK * 2, "2 links use run/gs232"),
        (LINK * 3, "3 links use run/gs232"),
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
        "[lcd]\nkind = 'pcf8574'\nbus = 0\naddress = 0x48\n",
    ],
)
def test_what_is_not_used_may_be_the_same(text: str) -> None:
    parse(text, "x")


# --- files that are none


def test_not_toml() -> None:
    (fault,) = faults("[azimuth\nmin_deg = 0\n")
    assert fault.startswith("is not TOML: ")
    assert "line 1" in fault


def test_a_key_twice_is_not_toml() -> None:
    (fault,) = faults("[azimuth]\nmin_deg = 0\nmin_deg = 1\n")
    assert fault.startswith("is not TOML: ")
    assert "line 3" in fault


def test_not_there(tmp_path: Path) -> None:
    path = tmp_path / "none.toml"
    with pytest.raises(ConfigError) as refused:
        load(path)
    assert str(refused.value) == (f"{path}: 1 fault\n  cannot be read: [Errno 2] No such file or directory: '{path}'")


def test_a_folder(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"cannot be read: .*Is a directory"):
        load(tmp_path)


def test_not_utf_8(tmp_path: Path) -> None:
    path = tmp_path / "latin.toml"
    path.write_bytes("# Grüße\n".encode("latin-1"))
    with pytest.raises(ConfigError, match="cannot be read: 'utf-8' codec can't decode"):
        load(path)


# --- whatever the file says


def keys(table: Any) -> list[str]:
    return [*table.model_fields, "nonsense"]


plain = st.one_of(st.integers(-1000, 1000), st.floats(-1e3, 1e3), st.text("ab:1", max_size=4), st.booleans())
values = st.recursive(
    plain, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text("ab", min_size=1), inner, max_size=2)
)
tables = st.one_of(
    [
        st.tuples(
            st.just(name),
            values | st.dictionaries(st.sampled_from(keys(type(getattr(Config(), name)))), values, max_size=4),
        )
        for name in Config.model_fields
        if name != "link"
    ]
)
link_keys = ["protocol", "name", "pty", "serial", "tcp", "baud", "ack", "nonsense"]
links = st.lists(st.dictionaries(st.sampled_from(link_keys), values, max_size=4) | values, max_size=3)


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(st.lists(tables, max_size=4).map(dict), links)
def test_it_loads_or_says_what_is_wrong(said: dict[str, Any], linked: list[Any]) -> None:
    text = tomlkit.dumps(said | {"link": linked})
    tomllib.loads(text)
    try:
        parse(text, "any.toml")
    except ConfigError as refused:
        found = refused.faults
    else:
        found = ["none"]
    assert found
    assert all(found)
