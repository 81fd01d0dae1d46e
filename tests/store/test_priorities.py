"""Changed priorities beside the configuration: they last, until a person writes another one into the file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rotator.store.priorities import Priorities


def test_a_change_outlives_the_program_and_ends_when_the_file_says_something_else(tmp_path: Path) -> None:
    path = tmp_path / "priorities.json"
    assert Priorities(path).change({"ISS": 3.0, "SO-50": 1.0}, {"ISS": 1.0, "SO-50": 1.0})
    kept = Priorities(path)
    assert kept.of("ISS", 1.0) == 3.0
    assert kept.of("SO-50", 1.0) == 1.0
    assert kept.of("ISS", 2.0) == 2.0, "the person has written 2 since"
    assert json.loads(path.read_text())["changed"].keys() == {"ISS"}
    kept.change({"ISS": 0.25}, {"ISS": 0.5})
    assert Priorities(path).of("ISS", 0.5) == 0.25
    kept.change({"ISS": 1.0}, {"ISS": 1.0})
    assert Priorities(path).of("ISS", 1.0) == 1.0


def test_a_hundred_targets_are_kept_and_long_names_are_cut(tmp_path: Path) -> None:
    path = tmp_path / "priorities.json"
    rows = {f"{number:03}" + "x" * 80: {"priority": 1000.0, "written": 0.0} for number in range(101)}
    path.write_text(json.dumps({"format": "rotator priorities 1", "changed": rows}))
    kept = Priorities(path)
    assert kept.of("099" + "x" * 77, 0.0) == 1000.0
    assert kept.of("100" + "x" * 77, 0.0) == 0.0


@pytest.mark.parametrize(
    "content",
    [
        '{"format": "rotator priorities 1", "changed": {"ISS": {"priority": 0, "written": 1}}}',
        '{"format": "rotator priorities 1", "changed": {"ISS": {"priority": 1e9, "written": 1}}}',
        '{"format": "rotator priorities 1", "changed": {"ISS": {"priority": 1000.5, "written": 1}}}',
        '{"format": "rotator priorities 1", "changed": {"ISS": {"priority": 2, "written": -0.5}}}',
        '{"format": "rotator priorities 1", "changed": []}',
        '{"format": "rotator priorities 2", "changed": {}}',
        "not JSON",
    ],
)
def test_a_damaged_file_leaves_the_priorities_as_they_are_written(
    tmp_path: Path, content: str, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "priorities.json"
    path.write_text(content)
    assert Priorities(path).of("ISS", 1.0) == 1.0
    assert "the plan has the priorities of the configuration" in caplog.text
