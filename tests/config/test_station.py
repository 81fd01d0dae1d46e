"""The `[station]` table: one place, exact enough for a star, and there where a link needs it."""

from __future__ import annotations

import re

import pytest

from rotator.config.load import ConfigError, parse

LX200 = '[[link]]\nprotocol = "lx200"\npty = "x"\n'


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("latitude_deg = 52.5", "latitude_deg and longitude_deg go together"),
        ("longitude_deg = 13.4", "latitude_deg and longitude_deg go together"),
        ('latitude_deg = 52.5\nlongitude_deg = 13.4\nlocator = "JO62qm"', "or locator, not both"),
        ('locator = "JO62"', 'must be a locator of 6, 8, 10 or 12 characters, such as "JO62qm"'),
        ('locator = "ZZ62qm"', "must be a locator"),
        ('locator = "JO62qm1"', "must be a locator"),
        ("latitude_deg = 91\nlongitude_deg = 0", "latitude_deg = 91"),
    ],
)
def test_what_is_no_place(keys: str, said: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(said)):
        parse(f"[station]\n{keys}\n", "x")


@pytest.mark.parametrize(
    "keys", ['locator = "jo62QM"', 'locator = "JO62qm34ab56"', "latitude_deg = -90\nlongitude_deg = 180"]
)
def test_what_is_a_place(keys: str) -> None:
    assert parse(f"[station]\n{keys}\n{LX200}", "x").station.is_known


@pytest.mark.parametrize("protocol", ["lx200", "stellarium"])
def test_a_telescope_program_needs_it(protocol: str) -> None:
    with pytest.raises(ConfigError, match=rf"the first \[\[link\]\]: {protocol} needs \[station\]"):
        parse(f'[[link]]\nprotocol = "{protocol}"\ntcp = "127.0.0.1:1"\n', "x")


@pytest.mark.parametrize("protocol", ["stellarium", "pstrotatoraz"])
@pytest.mark.parametrize("place", ['pty = "x"', 'serial = "/dev/ttyUSB0"'])
def test_these_are_spoken_over_tcp(protocol: str, place: str) -> None:
    with pytest.raises(ConfigError, match="must have tcp"):
        parse(f'[station]\nlocator = "JO62qm"\n[[link]]\nprotocol = "{protocol}"\n{place}\n', "x")
