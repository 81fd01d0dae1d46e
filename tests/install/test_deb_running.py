"""The Debian package on a Debian that runs, with systemd: the box stops before its files go, and starts again after.

The box itself is the shipped simulated one, in its unit, shut in as on a Pi.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.install.boot import Booted
from tests.install.conftest import Debs
from tests.install.roots import Layer
from tests.install.visit import APT

PID = ("systemctl", "show", "--property=MainPID", "--value", "rotator.service")


@pytest.fixture
def running(amd64: Path, installed_layer: Layer, debs: Debs, layers: Callable[[], Layer]) -> Iterator[Booted]:
    """A Debian that started with the box that install.sh put there."""
    with Booted([installed_layer.upper, amd64], layers(), [debs.today, debs.later]) as machine:
        machine.run("systemctl", "start", "rotator.service").check()
        yield machine


def state(machine: Booted) -> str:
    return machine.run("systemctl", "is-active", "rotator.service").text.strip()


def program(machine: Booted) -> str:
    """What the running box was started from."""
    pid = machine.run(*PID).check().text.strip()
    return machine.run("cat", f"/proc/{pid}/cmdline").check().text.replace("\0", " ")


def test_over_an_upgrade_the_box_stops_opens_its_relays_and_starts_again(running: Booted, debs: Debs) -> None:
    assert "/opt/rotator/" in program(running)
    running.run(*APT, "install", f"/root/{debs.today.name}").check()
    assert state(running) == "active"
    assert "/usr/lib/gs232-rotator/" in program(running)
    before = running.run(*PID).text

    running.run(*APT, "install", f"/root/{debs.later.name}").check()
    assert state(running) == "active"
    assert running.run(*PID).text != before
    assert running.run("rotator", "where").check().text
    ended = running.run("journalctl", "--unit", "rotator.service", "--output", "cat").text
    assert ended.count("Stopped rotator.service") == 2, ended
    assert "status=" not in ended, "a stop that failed, or relays that could not be opened"

    running.run(*APT, "remove", "gs232-rotator").check()
    assert state(running) == "inactive"


def test_a_box_that_a_person_stopped_stays_stopped(running: Booted, debs: Debs) -> None:
    running.run("systemctl", "stop", "rotator.service").check()
    for package in (debs.today, debs.later):
        running.run(*APT, "install", f"/root/{package.name}").check()
        assert state(running) == "inactive", "a person may stand at the mast"


def test_an_upgrade_that_fails_leaves_the_old_box_running(running: Booted, debs: Debs) -> None:
    running.run(*APT, "install", f"/root/{debs.today.name}").check()
    version = running.run("rotator", "--version").text
    running.run(
        "bash", "-ec", "dpkg-deb -R /root/later*.deb /root/broken && echo 'exit 1' >>/root/broken/DEBIAN/preinst"
    ).check()
    running.run("dpkg-deb", "--build", "/root/broken", "/root/broken.deb").check()
    assert running.run(*APT, "install", "/root/broken.deb").code != 0
    assert running.run("rotator", "--version").text == version
    assert state(running) == "active"


def test_a_configuration_that_the_new_version_refuses_is_told_and_stays(running: Booted, debs: Debs) -> None:
    config = running.at("/etc/rotator/rotator.toml")
    config.write_text(config.read_text() + "nonsense = 1\n")
    before = config.read_text()
    said = running.run(*APT, "install", f"/root/{debs.today.name}").check().text
    assert "gs232-rotator: the service does not start: journalctl -eu rotator says why" in said
    assert "nonsense" in running.run("journalctl", "--unit", "rotator.service", "--output", "cat").text
    assert config.read_text() == before
    config.write_text(before.replace("nonsense = 1\n", ""))
    running.run("systemctl", "restart", "rotator.service").check()
    assert state(running) == "active"
