"""The Debian package on a bare Debian 12: in, newer, from install.sh and back to it, out. What you wrote, stays."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.install.conftest import Debs
from tests.install.roots import Layer, Root, Said
from tests.install.visit import APT, APTS_OWN, DEB_IMPORTS, REFUSED_BY_THE_CARD, THE_GROUPS, WORST_EXPOSURE, exposure

CONFIG = "/etc/rotator/rotator.toml"
STATE = "/var/lib/rotator/state.json"
TODAY, LATER = "/tmp/today.deb", "/tmp/later.deb"


def give(root: Root, debs: Debs) -> None:
    shutil.copy(debs.today, root.at(TODAY))
    shutil.copy(debs.later, root.at(LATER))


def apt(root: Root, *words: str, **environment: str) -> Said:
    """Without a network: all that the package needs is in it, or on a bare Debian with Python."""
    return root.run("unshare", "--net", *APT, *words, **environment)


@pytest.fixture
def empty(bare: Root, debs: Debs) -> Root:
    give(bare, debs)
    return bare


@pytest.fixture(scope="session")
def packed_layer(amd64: Path, debs: Debs, layers: Callable[[], Layer]) -> Layer:
    layer = layers()
    with Root([amd64], layer) as root:
        give(root, debs)
        apt(root, "install", TODAY).check()
    return layer


@pytest.fixture
def packed(amd64: Path, packed_layer: Layer, tree: Path, layers: Callable[[], Layer]) -> Iterator[Root]:
    """With today's package, the sources in /src."""
    with Root([packed_layer.upper, amd64], layers()) as root:
        root.receive(tree, "/src")
        yield root


def write_of_ones_own(root: Root) -> dict[str, bytes]:
    """A configuration that a person edited, and what the box has learnt."""
    root.shell(f'echo \'# mine\' >>{CONFIG}; echo \'{{"format": "rotator state 1", "axes": {{}}}}\' >{STATE}').check()
    root.run("chown", "rotator:rotator", STATE).check()
    return ones_own(root)


def ones_own(root: Root) -> dict[str, bytes]:
    assert root.run("stat", "-c", "%U", CONFIG, STATE).lines == ["rotator", "rotator"]
    return {path: root.at(path).read_bytes() for path in (CONFIG, STATE)}


def test_the_service_user_can_run_it(packed: Root) -> None:
    as_user = ("runuser", "-u", "rotator", "--")
    assert packed.run(*as_user, "rotator", "--version").check().text.startswith("rotator ")
    assert packed.run(*as_user, "bash", "-c", DEB_IMPORTS) == Said(0, "")


def test_user_groups_folders_and_unit(packed: Root) -> None:
    assert packed.run("getent", "passwd", "rotator").text.split(":")[5:] == ["/var/lib/rotator", "/usr/sbin/nologin\n"]
    assert set(packed.run("id", "-nG", "rotator").text.split()) == {"rotator", "gpio", "i2c", "spi", "dialout"}
    assert packed.run("stat", "-c", "%U %a", "/etc/rotator", "/var/lib/rotator").lines == ["rotator 755"] * 2
    assert packed.run("systemd-analyze", "verify", "rotator.service") == Said(0, "")
    assert packed.run("systemctl", "is-enabled", "rotator.service").text == "enabled\n"
    assert exposure(packed) <= WORST_EXPOSURE


def test_its_unit_is_the_installers_but_for_the_folder(packed: Root, tree: Path) -> None:
    ours = packed.at("/usr/lib/systemd/system/rotator.service").read_text().splitlines()
    theirs = (tree / "install/rotator.service").read_text().splitlines()
    changed = [new for old, new in zip(theirs, ours, strict=True) if old != new]
    assert [line.split("=")[0] for line in changed] == ["ExecStart", "ExecStopPost", "ExecStopPost"]
    (off_at_once,) = [line for line in changed if "off_at_once" in line]
    named = [word for word in off_at_once.strip("'").split() if word.startswith("/usr/lib")]
    assert all(packed.at(word).exists() or packed.run("test", "-e", word).code == 0 for word in named)


def test_the_profile_to_begin_with(empty: Root) -> None:
    apt(empty, "install", TODAY, ROTATOR_PROFILE="f1efw").check()
    text = empty.at(CONFIG).read_text()
    assert 'pty = "/run/rotator/bench"' in text
    assert text.count("[state]") == 1


def test_an_upgrade_keeps_configuration_and_state(packed: Root) -> None:
    before = write_of_ones_own(packed)
    apt(packed, "install", LATER).check()
    assert packed.run("rotator", "--version").check().text == "rotator 9.8.7\n"
    assert ones_own(packed) == before
    apt(packed, "--allow-downgrades", "install", TODAY).check()
    assert packed.run("rotator", "--version").check().text != "rotator 9.8.7\n"
    assert ones_own(packed) == before


MAKE_A_REPOSITORY = """
mkdir -p /tmp/repository /etc/apt/keyrings && cp /tmp/later.deb /tmp/repository && cd /tmp/repository
apt-ftparchive packages . >Packages && apt-ftparchive release . >Release
gpg --clearsign --output InRelease Release && gpg --export >/etc/apt/keyrings/rotator.gpg
"""
"""What docs/install.md says, for a person with several boxes. The key is made here."""


def test_updates_come_by_apt(packed: Root) -> None:
    packed.run(*APT, "update").check()
    packed.run(*APT, "install", "apt-utils", "gnupg").check()
    packed.run("gpg", "--batch", "--passphrase", "", "--quick-generate-key", "rotator@localhost").check()
    packed.shell(MAKE_A_REPOSITORY).check()
    packed.at("/etc/apt/sources.list").write_text(
        "deb [signed-by=/etc/apt/keyrings/rotator.gpg] file:/tmp/repository ./\n"
    )
    apt(packed, "update").check()
    apt(packed, "upgrade").check()
    assert packed.run("rotator", "--version").check().text == "rotator 9.8.7\n"


def test_removed_it_leaves_what_is_yours_and_takes_it_up_again(packed: Root) -> None:
    before = write_of_ones_own(packed)
    apt(packed, "remove", "gs232-rotator").check()
    assert not packed.at("/usr/lib/gs232-rotator").exists()
    assert not packed.at("/usr/bin/rotator").is_symlink()
    assert ones_own(packed) == before
    apt(packed, "install", TODAY).check()
    assert ones_own(packed) == before
    assert packed.run("systemctl", "is-enabled", "rotator.service").text == "enabled\n"


def test_purged_it_leaves_nothing_but_the_groups(empty: Root) -> None:
    before = empty.inventory(times=False)
    apt(empty, "install", TODAY).check()
    write_of_ones_own(empty)
    empty.shell(REFUSED_BY_THE_CARD).check()
    apt(empty, "purge", "gs232-rotator").check()
    assert not empty.at("/run/rotator").exists(), "an old stop, for the next box"
    left = {path for path, _ in before.items() ^ empty.inventory(times=False).items()}
    assert {path for path in left if not path.startswith(APTS_OWN)} == THE_GROUPS


def test_from_install_sh_to_the_package_and_back(installed: Root, debs: Debs) -> None:
    give(installed, debs)
    before = write_of_ones_own(installed)
    apt(installed, "install", TODAY).check()
    assert ones_own(installed) == before
    assert not installed.at("/opt/rotator").exists()
    assert not installed.at("/etc/systemd/system/rotator.service").exists()
    assert not installed.at("/usr/local/bin/rotator").is_symlink()
    assert installed.run("systemctl", "is-enabled", "rotator.service").text == "enabled\n"
    refused = installed.run("/src/install.sh", "--yes")
    assert refused.text == (
        "install.sh: the Debian package is installed; "
        "first: sudo apt remove gs232-rotator (configuration and state stay)\n"
    )
    apt(installed, "remove", "gs232-rotator").check()
    installed.run("/src/install.sh", "--yes").check()
    assert ones_own(installed) == before
    assert installed.run("readlink", "-f", "/usr/local/bin/rotator").text.startswith("/opt/rotator/versions/")
    assert installed.run("systemctl", "is-enabled", "rotator.service").text == "enabled\n"
    apt(installed, "purge", "gs232-rotator").check()
    assert ones_own(installed) == before, "it is install.sh's by now"


@pytest.mark.parametrize(
    ("beforehand", "said"),
    [
        ("useradd --create-home rotator", "there is another user rotator already, with the home /home/rotator"),
        ("touch /usr/local/bin/rotator", "there is another /usr/local/bin/rotator"),
    ],
)
def test_it_refuses_what_it_must_not_touch(empty: Root, beforehand: str, said: str) -> None:
    empty.shell(beforehand).check()
    refused = apt(empty, "install", TODAY)
    assert refused.code != 0
    assert f"gs232-rotator: {said}" in refused.text
    assert not empty.at("/usr/lib/gs232-rotator").exists()


def test_the_list_of_what_is_in_it_has_versions_and_licences(packed: Root) -> None:
    listed = json.loads(packed.at("/usr/share/doc/gs232-rotator/gs232-rotator.cdx.json").read_text())
    assert listed["bomFormat"] == "CycloneDX"
    parts = {part["name"]: part for part in listed["components"]}
    folders = packed.shell("cd /usr/lib/gs232-rotator/lib/python3/site-packages && ls -d *.dist-info").lines
    there = {folder.split("-")[0].lower().replace("_", "-") for folder in folders}
    assert {name.lower().replace("_", "-") for name in parts} == there - {"gs232-rotator"}
    assert all(part["version"] and part["licenses"] for part in parts.values())
    assert listed["metadata"]["component"]["version"]
