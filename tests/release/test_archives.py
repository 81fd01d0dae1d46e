"""The sdist and the wheel: the same bytes wherever and whenever they are built, and with everything in them."""

from __future__ import annotations

import os
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

from release import archives
from release.source import Source
from tests.release.conftest import PROJECT, Archives

PACKAGES = ("rotator/", "hw/", "firmware_sim/")


def tracked() -> set[str]:
    said = subprocess.run(["git", "ls-files"], cwd=PROJECT, capture_output=True, text=True, check=True)
    return {name for name in said.stdout.splitlines() if (PROJECT / name).is_file()}


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """The same commit on another builder's machine: another folder, other modes, other times."""
    copy = tmp_path / "a folder of its own"
    Source.at(PROJECT).copy_to(copy)
    for path in copy.rglob("*"):
        os.utime(path, (1, 1))
        if path.is_file():
            path.chmod(path.stat().st_mode & ~0o077)
    return copy


def test_built_elsewhere_with_another_umask_they_are_the_same_bytes(
    built: Archives, elsewhere: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", str(built.source.epoch_s))
    umask = os.umask(0o077)
    try:
        sdist, wheel = archives.build(Source.at(elsewhere), tmp_path / "dist")
    finally:
        os.umask(umask)
    assert sdist.read_bytes() == built.sdist.read_bytes()
    assert wheel.read_bytes() == built.wheel.read_bytes()


def test_a_person_who_has_only_the_sdist_builds_the_same(built: Archives, tmp_path: Path) -> None:
    """Without git, and without a word on the time."""
    subprocess.run(["tar", "--extract", "--file", built.sdist, "--directory", tmp_path], check=True)
    (folder,) = tmp_path.iterdir()
    sdist, wheel = archives.build(Source.at(folder), tmp_path / "dist")
    assert sdist.read_bytes() == built.sdist.read_bytes()
    assert wheel.read_bytes() == built.wheel.read_bytes()


def test_the_wheel_has_every_file_of_the_program_and_no_other(built: Archives) -> None:
    with zipfile.ZipFile(built.wheel) as packed:
        inside = {name for name in packed.namelist() if ".dist-info/" not in name}
    pages = {f"rotator/{name}" for name in tracked() if name.startswith("docs/") and name.endswith(".md")}
    assert inside == {name for name in tracked() if name.startswith(PACKAGES)} | pages


def test_the_sdist_has_every_file_of_the_project(built: Archives) -> None:
    with tarfile.open(built.sdist) as packed:
        inside = {name.split("/", 1)[1] for name in packed.getnames()}
    assert inside - {"PKG-INFO"} == tracked()


def test_neither_names_the_builders_folder(built: Archives) -> None:
    with zipfile.ZipFile(built.wheel) as packed:
        assert not [name for name in packed.namelist() if str(PROJECT).encode() in packed.read(name)]
