"""A name that has just come in a file of elements is tracked at once, not a minute later."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.tracking.known_sky import KnownSky
from tests.tracking.tracked_box import ELEMENTS, FEBRUARY_S, Box


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    lines = ELEMENTS.read_text(encoding="utf-8").splitlines()
    (tmp_path / "first.tle").write_text("\n".join(lines[:3]), encoding="utf-8")
    return tmp_path


def arrives(folder: Path) -> None:
    (folder / "second.tle").write_text(ELEMENTS.read_text(encoding="utf-8"), encoding="utf-8")


@pytest.mark.parametrize("name", ["so-50", "27607"])
def test_a_name_of_a_file_that_has_just_come(folder: Path, name: str) -> None:
    box = Box(FEBRUARY_S, elements=folder)
    assert "is not among" in box.tracker.track(name)
    arrives(folder)
    assert box.tracker.track(name) == ""
    assert box.tracker.state == "planning"
    box.wait(3.0)
    assert box.tracker.state == "tracking"
    assert box.loop.status.flown is not None
    assert box.loop.status.flown.name == "SO-50"


def test_what_is_in_no_file_is_refused_after_one_look(folder: Path) -> None:
    box = Box(FEBRUARY_S, elements=folder)
    arrives(folder)
    assert box.tracker.track("nothing-1") == ""
    box.wait(3.0)
    assert box.tracker.state.startswith('ended: "nothing-1" is not among the 3 satellites known')
    assert box.tracker.track("nothing-1") != "", "no file is new"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("foo", 'there is no target "foo"'),
        ("10", '"10" is an azimuth without an elevation: write both, such as 10 30'),
        ("359,5", '"359,5" is an azimuth without an elevation'),
        ("sun", "the box does not know where it stands"),
        ("JO62qm", "the box does not know where it stands"),
    ],
)
def test_without_a_place_of_the_station_an_unknown_name_is_the_first_error(words: str, said: str) -> None:
    with pytest.raises(Unknown, match=re.escape(said)):
        KnownSky(None, Catalogue(())).find(words)


def test_without_a_place_a_direction_is_known() -> None:
    assert KnownSky(None, Catalogue(())).find("180 45") == Aim(180.0, 45.0)
