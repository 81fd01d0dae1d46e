"""Many faults in one configuration file: all wrong keys are told at once, none twice; then what joins several keys."""

from __future__ import annotations

import re
import tomllib
from typing import Any

import pytest
import tomlkit
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from tests.config.texts import FIRST, faults

LINK = '[[link]]\nprotocol = "gs232b"\npty = "run/gs232"\n'


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


def test_a_single_fault_is_one_fault() -> None:
    with pytest.raises(ConfigError) as refused:
        parse("[azimuth]\ntolerance_deg = -1\n", "a.toml")
    assert str(refused.value) == "a.toml: 1 mistake\n  line 2: azimuth.tolerance_deg = -1: must be greater than 0"


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


def test_no_fault_is_told_twice() -> None:
    found = faults("[azimuth]\nx = 1\n[elevation]\nx = 1\n")
    assert len(found) == len(set(found)) == 2


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
        found = [mistake.text for mistake in refused.mistakes]
    else:
        found = ["none"]
    assert found
    assert all(found)
