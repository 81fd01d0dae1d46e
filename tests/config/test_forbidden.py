"""[[mount.forbidden]]: sectors that make sense are taken, and each contradiction is named."""

from __future__ import annotations

import re

import pytest

from rotator.assembly.settings import build_mount
from rotator.config.load import ConfigError, parse
from rotator.control.sky.mount import Range

DIGIPOT = '[rotor]\ntype = "digipot"\n[mount]\npark_azimuth_deg = 90\n'


def sector(azimuth: str = "[100, 130]", elevation: str = "[0, 35]", name: str = "the chimney") -> str:
    return f'[[mount.forbidden]]\nname = "{name}"\nazimuth_deg = {azimuth}\nelevation_deg = {elevation}\n'


def test_a_sector_is_on_the_rotors_own_scale() -> None:
    shifted = "[azimuth]\noffset_deg = 10\n[elevation]\noffset_deg = -1\n"
    (chimney,) = build_mount(parse(shifted + sector(), "x")).sectors
    assert (chimney.name, chimney.azimuth, chimney.elevation) == ("the chimney", Range(110, 140), Range(-1, 34))


def test_whole_numbers_and_decimals_are_both_taken() -> None:
    (chimney,) = parse(sector("[100, 130.5]"), "x").mount.forbidden
    assert chimney.azimuth_deg == (100, 130.5)
    assert chimney.margin_deg == 2


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (sector("[130, 100]"), "azimuth_deg = [130, 100] must rise"),
        (sector(elevation="[35, 35]"), "elevation_deg = [35, 35] must rise"),
        (sector("[500, 510]"), "azimuth_deg lies outside the rotor's range of 0 to 450"),
        (sector(elevation="[-30, -5]"), "elevation_deg lies outside the rotor's range of 0 to 180"),
        (sector("[0, 450]", "[0, 180]"), "covers the whole range"),
        (sector("[2, 448.5]", "[1, 179]"), "covers the whole range"),
        (sector("[1, 30]"), '"the chimney" holds the park position'),
        (sector() + sector("[200, 210]"), 'two of mount.forbidden are named "the chimney"'),
        (sector(name=""), "name"),
        (sector("100"), "azimuth_deg = 100: must be a pair of numbers in brackets"),
        (DIGIPOT + sector("[1, 30]"), "holds digipot's start_deg"),
        ("".join(sector(f"[{10 * i + 100}, {10 * i + 101}]", name=f"{i}") for i in range(17)), "forbidden"),
    ],
)
def test_what_is_no_sector(text: str, said: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(said)):
        parse(text, "x")
