"""install.sh on a bare Debian 12: what it puts there, that it does nothing twice, and that nothing is left of it."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.install.roots import Layer, Root, Said
from tests.install.visit import REFUSED_BY_THE_CARD, WORST_EXPOSURE, exposure

CONFIG = "/etc/rotator/rotator.toml"


def newer(root: Root, *, version: str, spoilt: bool = False) -> None:
    """A later state of the sources, in /newer."""
    root.shell(
        f"cp -r /src /newer && sed -i 's/^__version__ = .*/__version__ = \"{version}\"/' /newer/rotator/__init__.py"
    )
    if spoilt:
        root.shell("echo 'raise SystemExit(\"spoilt\")' >>/newer/rotator/cli/main.py").check()


def installed_version(root: Root) -> str:
    return root.run("rotator", "--version").check().text.strip()


def test_a_dry_run_says_everything_and_changes_nothing(bare: Root) -> None:
    before = bare.inventory(times=True)
    said = bare.run("/src/install.sh", "--dry-run").check()
    assert "  makes the user rotator, who cannot log in" in said.lines
    assert "  writes /etc/systemd/system/rotator.service" in said.lines
    assert said.lines[-1] == "Nothing has been changed: this was --dry-run."
    assert bare.inventory(times=True) == before


NO_TERMINAL = "install.sh: without a terminal to ask at it needs --yes; nothing has been changed"


def at_a_terminal(root: Root, command: str, *, answer: str) -> Said:
    return root.shell(f"echo {answer} | script --quiet --return --command {command!r} /dev/null")


def test_without_options_it_says_everything_before_it_asks(bare: Root) -> None:
    before = bare.inventory(times=True)
    would = bare.run("/src/install.sh", "--dry-run").check().lines[:-1]
    assert bare.run("/src/install.sh").lines == ["This is what it would do:", *would, NO_TERMINAL]
    refused = at_a_terminal(bare, "/src/install.sh", answer="n")
    assert refused.code == 1
    assert refused.lines[-1].endswith("Do this? [y/N] install.sh: nothing has been changed")
    assert [line for line in refused.lines if line.startswith("  ")] == would
    assert bare.inventory(times=True) == before
    agreed = at_a_terminal(bare, "/src/install.sh", answer="y").check().text.partition("Do this? [y/N] ")[2]
    *done, last = agreed.splitlines()
    assert done == would
    assert last.startswith("Done: rotator ")


def test_user_groups_and_folders(installed: Root) -> None:
    assert installed.run("getent", "passwd", "rotator").text.split(":")[5:] == [
        "/var/lib/rotator",
        "/usr/sbin/nologin\n",
    ]
    assert set(installed.run("id", "-nG", "rotator").text.split()) == {"rotator", "gpio", "i2c", "spi", "dialout"}
    assert installed.run("stat", "-c", "%U %a", "/etc/rotator", "/var/lib/rotator").lines == ["rotator 755"] * 2


def test_the_service_user_can_run_it(installed: Root) -> None:
    as_user = ("runuser", "-u", "rotator", "--")
    assert re.fullmatch(r"rotator \d+\.\d+\.\d+\n", installed.run(*as_user, "rotator", "--version").check().text)
    assert "[rotor]" in installed.run(*as_user, "rotator", "config").check().text


def test_the_unit_is_sound_enabled_and_shut_in(installed: Root) -> None:
    assert installed.run("systemd-analyze", "verify", "rotator.service") == Said(0, "")
    assert installed.run("systemctl", "is-enabled", "rotator.service").text == "enabled\n"
    assert exposure(installed) <= WORST_EXPOSURE


def test_the_configuration_uses_the_places_of_a_service(bare: Root) -> None:
    bare.run("/src/install.sh", "--profile", "f1efw", "--yes").check()
    text = bare.at(CONFIG).read_text()
    assert 'path = "/var/lib/rotator/state.json"' in text
    assert 'pty = "/run/rotator/bench"' in text
    assert text.count("[state]") == 1


def test_a_second_run_changes_nothing(installed: Root) -> None:
    before = installed.inventory(times=True)
    said = installed.run("/src/install.sh", "--yes").check()
    assert len(said.lines) == 1
    assert said.text.startswith("Nothing to do")
    assert installed.inventory(times=True) == before


def test_a_newer_version_keeps_the_configuration_and_can_be_rolled_back(installed: Root) -> None:
    old = installed_version(installed)
    installed.shell(f"echo '# mine' >>{CONFIG}").check()
    newer(installed, version="9.8.7")
    installed.run("/newer/install.sh", "--profile", "g5500", "--yes").check()
    assert installed_version(installed) == "rotator 9.8.7"
    assert installed.at(CONFIG).read_text().endswith("# mine\n")
    installed.run("/newer/install.sh", "--rollback", "--yes").check()
    assert installed_version(installed) == old
    installed.run("/newer/install.sh", "--rollback", "--yes").check()
    assert installed_version(installed) == "rotator 9.8.7"


def test_a_version_that_does_not_start_never_replaces_one_that_does(installed: Root) -> None:
    before = installed.inventory(times=False)
    newer(installed, version="9.8.7", spoilt=True)
    said = installed.run("/newer/install.sh", "--yes")
    assert said.code == 1
    assert said.lines[-1].endswith("does not work here, it says why above; nothing has been changed")
    assert installed.inventory(times=False) == before


def test_a_configuration_that_the_new_version_refuses_stops_the_update(installed: Root) -> None:
    installed.shell(f"echo 'nonsense = 1' >>{CONFIG}").check()
    newer(installed, version="9.8.7")
    said = installed.run("/newer/install.sh", "--yes")
    assert said.code == 1
    assert "nonsense" in said.text
    assert installed_version(installed) != "rotator 9.8.7"


def test_removed_nothing_is_left(bare: Root) -> None:
    before = bare.inventory(times=False)
    bare.run("/src/install.sh", "--yes").check()
    assert bare.inventory(times=False) != before
    bare.shell(REFUSED_BY_THE_CARD).check()
    bare.run("/src/install.sh", "--remove", "--yes").check()
    assert bare.inventory(times=False) == before
    assert not bare.at("/run/rotator").exists(), "an old stop, for the next box"
    assert bare.run("/src/install.sh", "--remove", "--yes").check().text.startswith("Nothing to do")


def test_remove_says_what_is_lost_and_wants_a_yes(installed: Root) -> None:
    before = installed.inventory(times=True)
    said = installed.run("/src/install.sh", "--remove")
    assert said.code == 1
    assert said.lines[1].startswith("This deletes your configuration and calibrations in /etc/rotator")
    assert said.lines[-1] == NO_TERMINAL
    assert installed.inventory(times=True) == before


def test_what_was_kept_is_taken_up_again(installed: Root) -> None:
    installed.shell(f"echo '# mine' >>{CONFIG}; touch /var/lib/rotator/state.json").check()
    installed.shell(REFUSED_BY_THE_CARD).check()
    installed.run("/src/install.sh", "--remove", "--keep", "--yes").check()
    assert installed.at("/run/rotator/state.json").exists(), "it is newer than what the card has"
    assert installed.run("stat", "-c", "%U", CONFIG, "/var/lib/rotator/state.json").lines == ["root", "root"]
    assert installed.run("getent", "passwd", "rotator").code != 0
    installed.run("/src/install.sh", "--yes").check()
    assert installed.at(CONFIG).read_text().endswith("# mine\n")
    assert installed.run("stat", "-c", "%U", CONFIG, "/var/lib/rotator/state.json").lines == ["rotator", "rotator"]


@pytest.mark.parametrize(
    ("address", "announced"), [("127.0.0.1:4533", False), ("0.0.0.0:4599", True), ("[::]:4599", True)]
)
def test_only_what_is_open_to_the_network_is_announced(installed: Root, address: str, announced: bool) -> None:
    installed.run("mkdir", "-p", "/etc/avahi/services").check()
    installed.run("sed", "-i", f's/"127.0.0.1:4533"/"{address}"/', CONFIG).check()
    installed.run("/src/install.sh", "--yes").check()
    service = installed.at("/etc/avahi/services/rotator.service")
    assert service.exists() == announced
    if announced:
        assert "<port>4599</port>" in service.read_text()


def test_offline_from_wheels(bare: Root, wheels: Path) -> None:
    bare.receive(wheels, "/wheels")
    said = bare.run("unshare", "--net", "/wheels/install.sh", "--wheels", "/wheels", "--yes").check()
    assert said.lines[-1].startswith("Done: rotator")
    assert bare.run("unshare", "--net", "/wheels/install.sh", "--wheels", "/wheels", "--yes").text.startswith(
        "Nothing to do"
    )


def test_a_moteus_rotor_brings_its_library_and_can_go_again(installed: Root) -> None:
    python = "/opt/rotator/current/bin/python"
    assert installed.run(python, "-c", "import moteus").code != 0
    installed.run("sed", "-i", '/^\\[rotor\\]/,/^$/s/^type = .*/type = "moteus"/', CONFIG).check()
    assert "with moteus in" in installed.run("/src/install.sh", "--yes").check().text
    installed.run(python, "-c", "import moteus, can, importlib_metadata, packaging").check()
    assert installed.run(python, "-c", "import scipy").code != 0
    assert installed.run("/src/install.sh", "--yes").check().text.startswith("Nothing to do")
    said = installed.run("/src/install.sh", "--rollback", "--yes")
    assert said.code == 1
    assert said.lines[-1].endswith(
        "the version before does not accept /etc/rotator/rotator.toml; nothing has been changed"
    )


@pytest.fixture(scope="session")
def wheels(
    amd64: Path,
    tree: Path,
    layers: Callable[[], Layer],
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    """Fetched on another Debian, by a person who is not root."""
    here = tmp_path_factory.mktemp("fetched") / "wheels"
    with Root([amd64], layers()) as root:
        root.receive(tree, "/src")
        root.shell("runuser -u nobody -- /src/install.sh --fetch-wheels /tmp/wheels && mv /tmp/wheels /wheels").check()
        shutil.copytree(root.at("/wheels"), here)
    return here
