"""What is kept for every clone is whole, or is not there."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.kept import keep, kept


def whole(half: Path) -> None:
    half.mkdir()
    (half / "file").write_text("whole")


def test_it_is_made_once(tmp_path: Path) -> None:
    folder = keep(tmp_path / "kind" / "1.0", whole)
    (folder / "file").write_text("seen")
    assert (keep(tmp_path / "kind" / "1.0", whole) / "file").read_text() == "seen"


def test_what_fails_half_way_leaves_nothing(tmp_path: Path) -> None:
    def fail(half: Path) -> None:
        whole(half)
        raise OSError("the disk is full")

    with pytest.raises(OSError, match="full"):
        keep(tmp_path / "1.0", fail)
    assert list(tmp_path.iterdir()) == []
    assert (keep(tmp_path / "1.0", whole) / "file").exists()


def test_of_two_at_once_the_first_stays(tmp_path: Path) -> None:
    def overtaken(half: Path) -> None:
        whole(half)
        whole(tmp_path / "1.0")
        (tmp_path / "1.0" / "file").write_text("the other's")

    assert (keep(tmp_path / "1.0", overtaken) / "file").read_text() == "the other's"
    assert [path.name for path in tmp_path.iterdir()] == ["1.0"]


def test_it_stands_where_caches_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", "/somewhere")
    assert kept("roots") == Path("/somewhere/gs232-rotator/roots")
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", "/home/ham")
    assert kept("roots") == Path("/home/ham/.cache/gs232-rotator/roots")
