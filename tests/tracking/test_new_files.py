"""A name that has just come in a file of elements is tracked at once, not a minute later."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.tracking.known_sky import KnownSky
from tests.tables import every_row
from tests.tracking.tracked_box import ELEMENTS, FEBRUARY_S, Box, pass_of


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


@every_row(
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


@pytest.mark.long
@pytest.mark.parametrize("left", [None, "", "<html>", "ISS\n1 25544U 98067A"])
@pytest.mark.parametrize("by_s", [3.0, 86_400.0])
def test_where_the_file_goes_or_breaks_its_tracked_satellite_is_tracked_on(
    tmp_path: Path, left: str | None, by_s: float, caplog: pytest.LogCaptureFixture
) -> None:
    """A new plan needs the elements: the clock is set. Some programs delete a file before they write it anew."""
    file = tmp_path / "sets.tle"
    file.write_text(ELEMENTS.read_text(encoding="utf-8"), encoding="utf-8")
    rises_s = pass_of("iss").aos_s
    assert rises_s is not None
    box = Box(rises_s - 20.0, elements=file)
    assert box.tracker.track("iss") == ""
    box.wait(60.0)
    if left is None:
        file.unlink()
    else:
        file.write_text(left, encoding="utf-8")
    box.known.refresh()
    box.set_clock(by_s)
    box.wait(30.0)
    assert box.tracker.state == "tracking"
    assert len(box.planner.plans) == 2
    assert box.loop.status.flown is not None
    assert ("with the elements read before" in caplog.text) is (left is None)
    if by_s < 60.0:
        assert box.off_deg("iss") < 5.0
