"""[[mount.forbidden]]: sectors that make sense are taken, and each contradiction is named."""

from __future__ import annotations

import re

import pytest

from hw.ports import Axis
from rotator.assembly.settings import build_mount
from rotator.config.forbidden import seen_again
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


def again(*tables: str, limits: str = "") -> list[tuple[str, str]]:
    config = parse(limits + "".join(tables), "x")
    return seen_again(config.mount.forbidden, {axis: config.axis(axis) for axis in Axis})


NO_FLIP = "[elevation]\nmax_deg = 90\n"


def test_what_stands_on_the_other_turn_is_named() -> None:
    assert again(sector("[20, 50]", "[5, 35]"), limits=NO_FLIP) == [
        (
            "the chimney stands on the other turn of the azimuth too",
            "azimuth_deg = [380, 410], elevation_deg = [5, 35]",
        )
    ]
    assert again(sector("[20, 50]", "[5, 35]"), sector("[370, 420]", "[5, 35]", "again"), limits=NO_FLIP) == []
    assert again(sector("[100, 130]"), limits=NO_FLIP) == [], "460 is beyond the range"


def test_what_stands_there_over_the_top_is_named() -> None:
    (over,) = again(sector("[100, 130]"))
    assert over == (
        "over the top the antenna meets the chimney too",
        "azimuth_deg = [280, 310], elevation_deg = [145, 180]",
    )
