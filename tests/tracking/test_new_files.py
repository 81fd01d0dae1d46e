"""A name that has just come in a file of elements is tracked at once, not a minute later."""

from __future__ import annotations

from pathlib import Path

import pytest

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
