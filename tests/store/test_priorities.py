"""Changed priorities beside the configuration: they last, until a person writes another one into the file."""

from __future__ import annotations

import json
from pathlib import Path

from rotator.store.priorities import Priorities
from rotator.store.state import State


def test_a_change_outlives_the_program_and_ends_when_the_file_says_something_else(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    assert Priorities(State(path)).change({"ISS": 3.0, "SO-50": 1.0}, {"ISS": 1.0, "SO-50": 1.0})
    kept = Priorities(State(path))
    assert kept.of("ISS", 1.0) == 3.0
    assert kept.of("SO-50", 1.0) == 1.0
    assert kept.of("ISS", 2.0) == 2.0, "the person has written 2 since"
    assert json.loads(path.read_text())["priorities"]["changed"].keys() == {"ISS"}
    kept.change({"ISS": 0.25}, {"ISS": 0.5})
    assert Priorities(State(path)).of("ISS", 0.5) == 0.25
    kept.change({"ISS": 1.0}, {"ISS": 1.0})
    assert Priorities(State(path)).of("ISS", 1.0) == 1.0


def test_a_hundred_targets_are_kept_and_long_names_are_cut(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    rows = {f"{number:03}" + "x" * 80: {"priority": 1000.0, "written": 0.0} for number in range(101)}
    path.write_text(json.dumps({"format": "rotator state 2", "priorities": {"changed": rows}}))
    kept = Priorities(State(path))
    assert kept.of("099" + "x" * 77, 0.0) == 1000.0
    assert kept.of("100" + "x" * 77, 0.0) == 0.0
