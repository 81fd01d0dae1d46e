"""Debian roots to install in, for the tests of install.sh. They take root and minutes: `make test-install` runs them.

Knows which roots and trees the tests share. How a root is made and entered is `roots`.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import pytest

from release import archives, deb, environment
from release.source import Source, run
from tests.install.roots import Layer, Root, can_run_arm64, debian
from tests.install.visit import Visit, visit, visit_deb
from tests.kept import kept

PROJECT = Path(__file__).parent.parent.parent
ROOTS = kept("roots")
WHAT_IT_TAKES = (
    *("install.sh", "install", "pyproject.toml", "README.md", "CHANGELOG.md", "LICENSE"),
    *("rotator", "hw", "firmware_sim", "docs"),
)
RELEASES = ("trixie", "bookworm")
"""The package is tried on both, install.sh on the first."""
PACKAGES_AT = f"{deb.HOME.lstrip('/')}/{environment.PACKAGES}"


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Only where they are asked for by name."""
    asked = any("tests/install" in argument for argument in config.args)
    return None if asked or collection_path == Path(__file__) else True


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Emulation goes on beside the other tests, so its results are looked at last."""
    items.sort(key=lambda item: item.path.name == "test_arm64.py")


@pytest.fixture(scope="session")
def able() -> None:
    """Root, and the programs that make and enter a Debian."""
    needed = {
        "debootstrap": "debootstrap",
        "unshare": "util-linux",
        "nsenter": "util-linux",
        "systemd-nspawn": "systemd-container",
        "dpkg-deb": "dpkg",
        "pgrep": "procps",
    }
    missing = [package for program, package in needed.items() if shutil.which(program) is None]
    if os.geteuid() != 0 or missing:
        reason = f"sudo apt install {' '.join(missing)}" if missing else "only root makes a Debian root"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)


@pytest.fixture(scope="session")
def amd64(able: None) -> Path:
    """A bare Debian 12 on this machine's own architecture. Made once a machine."""
    return debian("bookworm", "amd64", ROOTS)


@pytest.fixture(scope="session")
def arm64_visits(
    request: pytest.FixtureRequest, able: None, tree: Path, wheel: Path, layers: Callable[[], Layer]
) -> Iterator[dict[str, Future[list[Visit]]]]:
    """By release; under way from the first test on."""
    arch = "arm64"
    if not can_run_arm64():
        arch = "amd64"
        report = request.config.pluginmanager.get_plugin("terminalreporter")
        assert report is not None
        report.write_line("arm64 does not run here (sudo apt install qemu-user-static binfmt-support): amd64 instead")

    built, _ = deb.build(Source.at(tree), wheel, wheel.parent, arch)

    def bring(release: str, layer: Layer) -> Visit:
        with Root([debian(release, arch, ROOTS)], layer) as root:
            shutil.copy(built, root.at("/root"))
            return visit_deb(root, f"/root/{built.name}")

    def install(release: str, layer: Layer) -> Visit:
        with Root([debian(release, arch, ROOTS)], layer) as root:
            root.receive(tree, "/src")
            return visit(root)

    def go(release: str, one: Layer, other: Layer) -> list[Visit]:
        return [bring(release, one)] + ([install(release, other)] if release == RELEASES[0] else [])

    with ThreadPoolExecutor(len(RELEASES)) as pool:
        yield {release: pool.submit(go, release, layers(), layers()) for release in RELEASES}


@pytest.fixture(scope="session", autouse=True)
def _start_early(request: pytest.FixtureRequest) -> None:
    if any("arm64_visits" in getattr(item, "fixturenames", ()) for item in request.session.items):
        request.getfixturevalue("arm64_visits")


@pytest.fixture(scope="session")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources as a person has them after `git clone`."""
    copy = tmp_path_factory.mktemp("tree") / "gs232-rotator"
    copy.mkdir()
    for name in WHAT_IT_TAKES:
        source = PROJECT / name
        if source.is_dir():
            shutil.copytree(source, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, copy / name)
    return copy


@pytest.fixture(scope="session")
def layers(tmp_path_factory: pytest.TempPathFactory) -> Callable[[], Layer]:
    def make() -> Layer:
        return Layer(tmp_path_factory.mktemp("layer"))

    return make


@pytest.fixture
def bare(amd64: Path, tree: Path, layers: Callable[[], Layer]) -> Iterator[Root]:
    """A Debian that never saw the project, with its sources in /src."""
    with Root([amd64], layers()) as root:
        root.receive(tree, "/src")
        yield root


@pytest.fixture(scope="session")
def installed_layer(amd64: Path, tree: Path, layers: Callable[[], Layer]) -> Layer:
    layer = layers()
    with Root([amd64], layer) as root:
        root.receive(tree, "/src")
        root.run("/src/install.sh", "--yes").check()
    return layer


@pytest.fixture
def installed(amd64: Path, installed_layer: Layer, layers: Callable[[], Layer]) -> Iterator[Root]:
    """The same, with the project installed from /src."""
    with Root([installed_layer.upper, amd64], layers()) as root:
        yield root


@pytest.fixture(scope="session")
def wheel(tree: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    _, made = archives.build(Source.at(tree), tmp_path_factory.mktemp("wheel"))
    return made


@dataclass(frozen=True, slots=True)
class Debs:
    """The Debian package of today, and a later one. Only the version is another."""

    today: Path
    later: Path


@pytest.fixture(scope="session")
def debs(able: None, tree: Path, wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Debs:
    folder = tmp_path_factory.mktemp("debs")
    source = Source.at(tree)
    today, _ = deb.build(source, wheel, folder, "amd64")
    opened = folder / "opened"
    run("dpkg-deb", "--raw-extract", today, opened, epoch_s=source.epoch_s)
    for name, was, becomes in (
        ("DEBIAN/control", f"Version: {deb.deb_version(source)}", "Version: 9.8.7"),
        (f"{PACKAGES_AT}/rotator/__init__.py", f'"{source.version}"', '"9.8.7"'),
    ):
        text = (opened / name).read_text()
        assert was in text
        (opened / name).write_text(text.replace(was, becomes))
    later = folder / "later_9.8.7_amd64.deb"
    run("dpkg-deb", "--root-owner-group", "-Zzstd", "--build", opened, later, epoch_s=source.epoch_s)
    return Debs(today, later)
