"""The Debian package as a file: the same bytes wherever it is built, and one folder that serves three Pythons.

What becomes of it on a Debian, tests/install says.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from release import deb, environment
from tests.release.conftest import PROJECT, Archives, python_of

HERE = "arm64" if os.uname().machine == "aarch64" else "amd64"
LOOK = """
import sys
sys.path.insert(0, sys.argv[1])
import can, gpiod, moteus, pydantic_core, wrapt
gpiod.request_lines
import rotator
from rotator.config.load import load
assert load(None).link
assert rotator.__file__.startswith(sys.argv[1])
"""


@pytest.fixture(scope="module")
def package(built: Archives, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The package, and the list of its parts."""
    if not Path("/usr/bin/dpkg-deb").exists():
        pytest.skip("only a Debian builds its packages: sudo apt install dpkg")
    return deb.build(built.source, built.wheel, tmp_path_factory.mktemp("deb"), HERE)


def test_built_by_another_person_it_is_the_same_bytes(
    package: tuple[Path, Path], built: Archives, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TZ", "Asia/Tokyo")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    umask = os.umask(0o077)
    try:
        again = deb.build(built.source, built.wheel, tmp_path, HERE)
    finally:
        os.umask(umask)
    assert [path.read_bytes() for path in again] == [path.read_bytes() for path in package]


@pytest.mark.parametrize("minor", environment.MINORS)
def test_each_python_finds_its_compiled_parts(package: tuple[Path, Path], tmp_path: Path, minor: int) -> None:
    python = python_of(minor)
    subprocess.run(["dpkg-deb", "--extract", package[0], tmp_path], check=True)
    packages = tmp_path / deb.HOME.lstrip("/") / environment.PACKAGES
    subprocess.run([python, "-I", "-B", "-c", LOOK, packages], check=True)


def test_it_names_no_place_of_the_builders(package: tuple[Path, Path], tmp_path: Path) -> None:
    subprocess.run(["dpkg-deb", "--raw-extract", package[0], tmp_path / "all"], check=True)
    hosts = [b"/tmp/", str(PROJECT).encode(), str(Path.home()).encode() + b"/"]
    named = [
        path.name
        for path in (tmp_path / "all").rglob("*")
        if path.is_file()
        and not path.is_symlink()  # to the machine's own Python
        and path.suffix in (".json", ".txt", "", ".cfg")
        and any(h in path.read_bytes() for h in hosts)
    ]
    assert named == []
