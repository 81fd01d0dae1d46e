"""Satellites by the names that radio amateurs say, in lists that write them otherwise."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.names import OSCARS
from tests.orbits.test_omm import MESSAGE

AS_LISTED = {
    7530: "OSCAR 7 (AO-7)",
    25338: "NOAA 15 [B]",
    25544: "ISS (ZARYA) [+]",
    39444: "FUNCUBE-1 (AO-73)",
    40908: "LILACSAT-2",
    41847: "CAS-2T & KS-1Q",
    43017: "RADFXSAT (FOX-1B)",
    43678: "DIWATA-2B",
    43700: "ES'HAIL 2",
    44881: "TIANYAN 01",
    44909: "RS-44 & BREEZE-KM R/B",
    53106: "GREENCUBE",
    57191: "POLYTECH-UNIVERSE 3 (R*)",
}
"""Names as public lists of elements write them."""


def known(folder: Path, names: dict[int, str]) -> Catalogue:
    messages = [MESSAGE | {"OBJECT_NAME": name, "NORAD_CAT_ID": number} for number, name in names.items()]
    (folder / "all.json").write_text(json.dumps(messages), encoding="utf-8")
    return Catalogue([str(folder)])


@pytest.mark.parametrize(
    ("said", "number"),
    [
        *((said, 7530) for said in ("AO-07", "ao07", "AO 7", "Oscar-07", "07530", "7530")),
        *((said, 44909) for said in ("RS-44", "rs44", "BREEZE-KM R/B", "RS-44 & BREEZE-KM R/B")),
        *((said, 43017) for said in ("AO 91", "ao-91", "RADFXSAT", "fox-1b")),
        *((said, 44881) for said in ("Tianyan 1", "TIANYAN-01", "TO-108")),
        *((said, 25338) for said in ("noaa15", "NOAA-15", "NOAA 15 [B]")),
        *((said, 25544) for said in ("iss", "zarya", "ISS (ZARYA)", "ISS (ZARYA) [+]")),
        ("KS-1Q", 41847),
        ("QO-100", 43700),
        ("io117", 53106),
        ("PO 101", 43678),
        ("polytech universe 3", 57191),
    ],
)
def test_what_amateurs_say_finds_what_the_list_means(tmp_path: Path, said: str, number: int) -> None:
    assert known(tmp_path, AS_LISTED).find(said).catalogue_number == number


def test_each_oscar_number_finds_its_satellite_whatever_the_list_calls_it(tmp_path: Path) -> None:
    catalogue = known(tmp_path, {number: f"OBJECT {number}" for number in OSCARS})
    assert {number: catalogue.find(said).catalogue_number for number, said in OSCARS.items()} == {
        number: number for number in OSCARS
    }


def test_a_list_may_write_the_zero_and_a_person_not(tmp_path: Path) -> None:
    assert known(tmp_path, {7530: "AO-07"}).find("AO-7").catalogue_number == 7530


def test_the_very_name_goes_before_one_without_its_zero(tmp_path: Path) -> None:
    catalogue = known(tmp_path, {1: "CUBE 1", 2: "CUBE 01"})
    assert [catalogue.find(said).catalogue_number for said in ("cube 1", "cube 01")] == [1, 2]


def test_the_zeros_inside_a_number_count(tmp_path: Path) -> None:
    catalogue = known(tmp_path, {1: "NO-103", 100_001: "NEW"})
    for said in ("NO-13", "NO-130", "A1"):
        with pytest.raises(Unknown):
            catalogue.find(said)
