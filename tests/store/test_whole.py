"""A file is replaced whole or not at all, whenever the power goes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rotator.store.whole import write_whole


def test_a_new_file(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", "text\n")
    assert (tmp_path / "a").read_text() == "text\n"
    assert os.listdir(tmp_path) == ["a"]


def test_bytes_that_are_no_text(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", b"caf\xe9\r\n")
    assert (tmp_path / "a").read_bytes() == b"caf\xe9\r\n"


def test_power_lost_in_the_middle_of_writing(tmp_path: Path) -> None:
    # What such a moment leaves: the old file, and half of the new one beside it.
    path, half = tmp_path / "a", tmp_path / "a.new"
    path.write_text("old")
    half.write_text("ne")
    assert path.read_text() == "old"
    write_whole(path, "newer")
    assert path.read_text() == "newer"
    assert not half.exists()


@pytest.mark.parametrize("mode", [0o640, 0o600, 0o777])
def test_mode_stays(tmp_path: Path, mode: int) -> None:
    path = tmp_path / "a"
    path.write_text("old")
    path.chmod(mode)
    write_whole(path, "new")
    assert path.stat().st_mode & 0o777 == mode


@pytest.mark.skipif(os.geteuid() != 0, reason="only root gives a file away")
def test_the_owner_stays(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_text("old")
    os.chown(path, 1000, 1001)
    write_whole(path, "new")
    assert (path.stat().st_uid, path.stat().st_gid) == (1000, 1001)


def test_it_leaves_no_file_open(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", "text")
    before = os.listdir("/proc/self/fd")
    for _ in range(10):
        write_whole(tmp_path / "a", "text")
    assert os.listdir("/proc/self/fd") == before


def test_a_symbolic_link_stays_one(tmp_path: Path) -> None:
    (tmp_path / "etc").mkdir()
    path, link = tmp_path / "etc" / "a", tmp_path / "a"
    path.write_text("old")
    link.symlink_to(path)
    write_whole(link, "new")
    assert link.is_symlink()
    assert path.read_text() == "new"


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        write_whole(tmp_path / "none" / "a", "text")
