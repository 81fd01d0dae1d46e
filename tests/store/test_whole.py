"""A file is replaced whole or not at all, whenever the power goes."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

import pytest

from rotator.config.toml_text import replace
from rotator.store.whole import BLOCK, write_block, write_whole


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


def test_a_new_file_is_nobody_else_s_to_read(tmp_path: Path) -> None:
    """It may hold who is paired, or a password."""
    write_whole(tmp_path / "a", "text")
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o600
    write_whole(tmp_path / "b", "text", mode=0o640)
    assert (tmp_path / "b").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("before", [None, 0o644, 0o600])
@pytest.mark.parametrize("mode", [0o640, 0o600, 0o644])
def test_a_copy_is_read_by_those_who_may_read_the_original(tmp_path: Path, mode: int, before: int | None) -> None:
    path, copy = tmp_path / "a", tmp_path / "a.bak"
    path.write_text("secret")
    path.chmod(mode)
    if before is not None:
        copy.write_text("older")
        copy.chmod(before)
    write_whole(copy, "secret", like=path)
    assert copy.stat().st_mode & 0o777 == mode


SERVICE = 1000
ROOT = pytest.mark.skipif(os.geteuid() != 0, reason="only root has another user's folder to fear")


class Planted:
    """A folder of the service's user, with a file in it, and a file of root's that this user may not write."""

    def __init__(self, folder: Path) -> None:
        self.shadow = folder / "shadow"
        self.shadow.write_text("root's")
        self.shadow.chmod(0o600)
        self.folder = folder / "service"
        self.folder.mkdir()
        os.chown(self.folder, SERVICE, SERVICE)

    def link(self, name: str, to: Path, owner: int = SERVICE) -> Path:
        path = self.folder / name
        path.symlink_to(to)
        os.chown(path, owner, owner, follow_symlinks=False)
        return path

    def file(self, name: str) -> Path:
        path = self.folder / name
        path.write_text("old")
        os.chown(path, SERVICE, SERVICE)
        return path


@pytest.fixture
def planted(tmp_path: Path) -> Planted:
    return Planted(tmp_path)


@ROOT
@pytest.mark.parametrize("name", ["a.new", "a", "a.bak", "a.bak.new", "inner"])
def test_root_writes_through_no_link_that_the_service_s_user_has_planted(planted: Planted, name: str) -> None:
    """As `rotator setup`, `config` or `calibrate` do behind sudo: the file itself, its copy, what both are written as
    first, and a folder on the way."""
    path = planted.folder / "inner/a" if name == "inner" else planted.folder / "a"
    if name not in ("a", "inner"):
        planted.file("a")
    planted.link(name, planted.shadow.parent if name == "inner" else planted.shadow)
    planted.shadow.write_text("root's".ljust(BLOCK))
    writes: tuple[Callable[[], None], ...] = (
        partial(replace, path, "old", "new"),
        partial(write_whole, path, "new"),
        partial(write_block, path, "new"),
    )
    for write in writes:
        with suppress(OSError):
            write()
    assert planted.shadow.read_text().strip() == "root's"
    assert (planted.shadow.stat().st_uid, planted.shadow.stat().st_mode & 0o777) == (0, 0o600)
    assert os.listdir(planted.shadow.parent) in (["shadow", "service"], ["service", "shadow"])


@ROOT
def test_root_says_which_link_it_does_not_follow(planted: Planted) -> None:
    link = planted.link("a", planted.shadow)
    with pytest.raises(PermissionError, match="is a link of another user, and root does not follow it") as refused:
        write_whole(link, "new")
    assert refused.value.filename == str(link)


@ROOT
@pytest.mark.parametrize("sudo", [False, True])
def test_root_follows_its_own_links_and_those_of_the_person_behind_sudo(
    planted: Planted, monkeypatch: pytest.MonkeyPatch, sudo: bool
) -> None:
    if sudo:
        monkeypatch.setenv("SUDO_UID", str(SERVICE))
    path = planted.file("real")
    link = planted.link("a", path, SERVICE if sudo else 0)
    write_whole(link, "new")
    assert link.is_symlink()
    assert (path.read_text(), path.stat().st_uid) == ("new", SERVICE)


@ROOT
def test_what_root_writes_stays_the_service_s(planted: Planted) -> None:
    path = planted.file("a")
    path.chmod(0o640)
    replace(path, "old", "new")
    for each in (path, planted.folder / "a.bak"):
        assert (each.stat().st_uid, each.stat().st_gid, each.stat().st_mode & 0o777) == (SERVICE, SERVICE, 0o640)


def test_a_link_that_leads_to_itself_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "a")
    with pytest.raises((OSError, RuntimeError)):
        write_whole(tmp_path / "a", "new")
    assert os.listdir(tmp_path) == ["a"]
