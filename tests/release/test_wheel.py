"""The wheel, put into an empty environment in an empty folder by an ordinary user: the program works, and goes again.

No extra is installed, and nothing of the sources is in reach. Where the tests run as root, and other users can reach
that Python, the program runs as nobody.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.boxes import free_port
from tests.release.conftest import Archives, python_of

PASS = "t,az,el\n0,200,0\n60,190,20\n90,180,33\n120,160,45\n150,130,35\n180,110,20\n240,100,0\n"
MINORS = (11, 12, 13)


@dataclass(frozen=True, slots=True)
class Place:
    """An environment in a folder, and the user who has it."""

    folder: Path
    user: str | None

    def start(self, *command: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [self.folder / "env/bin" / command[0], *command[1:]],
            cwd=self.folder / "empty",
            env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder), "LC_ALL": "C.UTF-8"},
            user=self.user,
            group="nogroup" if self.user else None,
            extra_groups=[] if self.user else None,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def run(self, *command: str, code: int = 0) -> str:
        with self.start(*command) as process:
            said, _ = process.communicate(timeout=300)
        assert process.returncode == code, said
        return said


@pytest.fixture(params=MINORS, scope="module")
def place(request: pytest.FixtureRequest, built: Archives) -> Iterator[Place]:
    python = python_of(request.param)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        folder.chmod(0o755)
        subprocess.run([python, "-m", "venv", folder / "env"], check=True)
        pip = [f"{folder}/env/bin/pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*pip, str(built.wheel)], cwd=folder, check=True)
        (folder / "empty").mkdir()
        user = "nobody" if is_reached_by_nobody(folder / "env/bin/python") else None
        if user:
            shutil.chown(folder / "empty", "nobody", "nogroup")
        yield Place(folder, user)


def is_reached_by_nobody(python: Path) -> bool:
    if os.geteuid() != 0:
        return False
    try:
        return subprocess.run([python, "-V"], user="nobody", capture_output=True, check=False).returncode == 0
    except PermissionError:
        return False


@pytest.fixture(scope="module")
def station(place: Place) -> str:
    """The shipped file, with a free port in place of 4533, where another box may listen."""
    port = free_port()
    text = place.run("rotator", "config").replace(":4533", f":{port}")
    (place.folder / "rotator.toml").write_text(text)
    return str(place.folder / "rotator.toml")


def test_it_has_what_it_ships(place: Place) -> None:
    assert place.run("rotator", "--version").startswith("rotator ")
    assert "doctor" in place.run("rotator", "--help")
    names = [line.split()[0] for line in place.run("rotator", "config", "--list").splitlines()]
    assert len(names) > 5
    assert "[rotor]" in place.run("rotator", "config", names[-1])


def test_it_runs_and_ends(place: Place, station: str) -> None:
    with place.start("rotator", "run", "--plain", "--config", station) as box:
        assert box.stdout is not None
        said = [next(box.stdout)]
        while "run/gs232" not in said[-1]:
            said.append(next(box.stdout))
        assert place.run("rotator", "where", "--config", station)
        box.send_signal(signal.SIGTERM)
        rest = box.stdout.read()
    assert box.returncode == 0, "".join(said) + rest


def test_doctor_finds_all_that_it_needs(place: Place, station: str) -> None:
    said = place.run("rotator", "doctor", "--config", station, "--json")
    assert json.loads(said)


def test_a_pass_is_rehearsed(place: Place) -> None:
    (place.folder / "empty/pass.csv").write_text(PASS)
    summary = json.loads(place.run("rotator", "rehearse", "pass.csv", "--json"))
    assert summary["rms_deg"] < 5.0


def test_the_pages_to_which_messages_point_are_in_it(place: Place) -> None:
    assert place.run("rotator", "help", "pot-open-or-shorted").startswith("### pot open or shorted\n")


def test_a_moteus_rotor_says_what_it_lacks(place: Place) -> None:
    """The extras are not here: a sentence says so, no traceback."""
    text = place.run("rotator", "config", "isel")
    (place.folder / "isel.toml").write_text(text)
    said = place.run("rotator", "run", "--plain", "--config", str(place.folder / "isel.toml"), code=1)
    assert "Traceback" not in said
    assert "moteus" in said


def test_uninstalled_nothing_is_left(place: Place) -> None:
    subprocess.run([place.folder / "env/bin/pip", "uninstall", "--quiet", "--yes", "gs232-rotator"], check=True)
    left = [path for path in (place.folder / "env").rglob("*") if path.name in ("rotator", "hw", "firmware_sim")]
    assert left == []
    assert not list((place.folder / "env").rglob("gs232_rotator*"))
