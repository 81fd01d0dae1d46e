"""Debian packages of a newer release, unpacked in a folder and run from there: nothing is installed on this machine.

Knows apt with a state of its own, which checks signatures and hashes, and how to start a program on the C library that
it was built for. Knows none of the programs.
"""

from __future__ import annotations

import fcntl
import os
import platform
import shutil
import subprocess
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tests.install.roots import MIRROR
from tests.kept import keep, kept

KEYS = Path("/usr/share/keyrings/debian-archive-keyring.gpg")
DEADLINE_S = 600.0
STALE_S = 86_400.0
"""A release may have a newer version of a package after a day."""


class NotHereError(Exception):
    """This machine cannot unpack it; the text says why."""


@dataclass(frozen=True, slots=True)
class Unpacked:
    """`folder` holds the files of a package and of all that it depends on, down to the C library."""

    folder: Path

    def command(self, program: str) -> list[str]:
        """The words that run one of its programs, by the path below the folder."""
        machine = f"{platform.machine()}-linux-gnu"
        places = [self.folder / where / machine for where in ("usr/lib", "lib")]
        (loader,) = [found for place in places for found in place.glob("ld-linux-*.so.*")][:1]
        return [str(loader), "--library-path", ":".join(map(str, places)), str(self.folder / program)]


def unpacked(package: str, release: str) -> Unpacked:
    """The package as `release` has it today, with its dependencies; kept for the next runs.

    Raises NotHereError without apt, Debian's keys or the network.
    """
    if shutil.which("apt-get") is None or not KEYS.exists():
        raise NotHereError("it needs apt and Debian's keys: sudo apt install debian-archive-keyring")
    clients = kept("clients")
    clients.mkdir(parents=True, exist_ok=True)
    newest = clients / f"{package}-{release}-{platform.machine()}.newest"
    with (clients / ".lock").open("w") as lock:
        # Of several tests at once, one asks the mirror.
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not newest.exists() or time.time() - newest.stat().st_mtime > STALE_S:
            with tempfile.TemporaryDirectory(dir=clients) as scratch:
                apt = _Apt(Path(scratch), release)
                name = f"{package}-{apt.version(package)}-{release}-{platform.machine()}"
                keep(clients / name, lambda half: apt.unpack(package, half))
            newest.write_text(name, encoding="utf-8")
    return Unpacked(clients / newest.read_text(encoding="utf-8"))


class _Apt:
    """apt with nothing installed, and one release to choose from."""

    def __init__(self, folder: Path, release: str) -> None:
        self._folder = folder
        for name in ("lists/partial", "archives/partial"):
            (folder / name).mkdir(parents=True)
        (folder / "status").touch()
        (folder / "sources.list").write_text(f"deb [signed-by={KEYS}] {MIRROR} {release} main\n", encoding="utf-8")
        configuration = {
            "Dir::State": folder,
            "Dir::State::lists": folder / "lists",
            "Dir::State::status": folder / "status",
            "Dir::Cache": folder,
            "Dir::Cache::archives": folder / "archives",
            "Dir::Etc::sourcelist": folder / "sources.list",
            "Dir::Etc::sourceparts": "/dev/null",
            "Acquire::Languages": "none",
            "APT::Sandbox::User": "",
            "APT::Install-Recommends": "false",
        }
        self._environment = {"APT_CONFIG": str(folder / "apt.conf")}
        lines = [f'{key} "{value}";\n' for key, value in configuration.items()]
        (folder / "apt.conf").write_text("".join(lines), encoding="utf-8")
        _run(["apt-get", "update", "-qq", "--error-on=any"], self._environment)

    def version(self, package: str) -> str:
        shown = _run(["apt-cache", "show", "--no-all-versions", package], self._environment)
        return next(line.removeprefix("Version: ") for line in shown.splitlines() if line.startswith("Version: "))

    def unpack(self, package: str, into: Path) -> None:
        _run(["apt-get", "install", "-qq", "--yes", "--download-only", package], self._environment)
        into.mkdir()
        for archive in sorted((self._folder / "archives").glob("*.deb")):
            _run(["dpkg-deb", "--extract", str(archive), str(into)], {})


def _run(command: list[str], environment: Mapping[str, str]) -> str:
    everything = {**os.environ, "LC_ALL": "C.UTF-8", **environment}
    done = subprocess.run(command, env=everything, capture_output=True, text=True, timeout=DEADLINE_S, check=False)
    if done.returncode != 0:
        raise NotHereError(f"{' '.join(command[:3])}: {done.stderr.strip()}")
    return done.stdout
