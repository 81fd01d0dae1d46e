"""Debian roots: made by debootstrap once a machine, entered through an overlay that is thrown away after each test.

Knows how to make one, run a command in it, and take down all that stands in it. Knows nothing of what is installed.
Every mount is in a namespace of its own, which ends with the process that holds it, whatever becomes of the tests.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import stat
import subprocess
import threading
import urllib.request
from collections import defaultdict
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import TracebackType

from tests.kept import keep

MIRROR = "http://deb.debian.org/debian"
PACKAGES = "systemd,python3-venv"
ENVIRONMENT = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C"}
PRIVATE = ("unshare", "--mount", "--propagation", "private")
"""debootstrap mounts /proc in what it makes: unseen from here, so that clearing away half a root never reaches it."""
THE_WAY_OUT = ("/etc/resolv.conf", "/etc/ssl/certs/ca-certificates.crt", "/etc/pip.conf")
"""How this machine reaches the network; a root in it has to go the same way."""
PASSING = (
    *("/proc", "/dev", "/sys", "/run", "/tmp", "/src", "/newer", "/wheels"),
    *("/var/cache/apt", "/var/cache/debconf", "/var/log"),
)
"""Where things come and go: not part of what an installer leaves."""


_RECIPE = hashlib.sha256(f"{MIRROR} {PACKAGES}".encode()).hexdigest()[:8]


_seen: dict[tuple[int, ...], str] = {}


def _contents(path: Path, changed: tuple[int, ...]) -> str:
    """Its hash, which is taken once: nobody sets a file's ctime, and most files of all roots are the same."""
    if changed not in _seen:
        _seen[changed] = hashlib.sha256(path.read_bytes()).hexdigest()
    return _seen[changed]


def can_run_arm64() -> bool:
    return os.uname().machine == "aarch64" or Path("/proc/sys/fs/binfmt_misc/qemu-aarch64").exists()


_making: defaultdict[str, threading.Lock] = defaultdict(threading.Lock)


def debian(release: str, arch: str, kept_in: Path) -> Path:
    """The folder of a bare Debian with Python and systemd, of the mirror's version of that release (12.11, say); made
    unless it is there. May be asked from any thread."""
    with _making[f"{release}-{arch}"]:
        name = f"{release}-{_point_release(release)}-{arch}-{_RECIPE}"
        return keep(kept_in / name, lambda half: _make(half, release, arch))


@cache
def _point_release(release: str) -> str:
    """What the mirror has today. An older root would lack its updates."""
    with urllib.request.urlopen(f"{MIRROR}/dists/{release}/Release", timeout=60) as answer:
        found = re.search(rb"^Version: ([\d.]+)$", answer.read(4096), re.MULTILINE)
    assert found, f"{MIRROR} does not say its version of {release}"
    return found[1].decode()


def _make(half: Path, release: str, arch: str) -> None:
    made = subprocess.run(
        [
            *PRIVATE,
            "debootstrap",
            "--variant=minbase",
            f"--arch={arch}",
            f"--include={PACKAGES}",
            release,
            half,
            MIRROR,
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert made.returncode == 0, f"debootstrap {release} {arch}: {made.stdout[-2000:]}{made.stderr[-500:]}"


@dataclass(frozen=True, slots=True)
class Said:
    """How a command ended and what it printed, errors among it."""

    code: int
    text: str

    def check(self) -> Said:
        assert self.code == 0, self.text
        return self

    @property
    def lines(self) -> list[str]:
        return self.text.splitlines()


def said(command: list[str], environment: dict[str, str]) -> Said:
    """Run a command that reads nothing, with `ENVIRONMENT` and these variables."""
    done = subprocess.run(
        command,
        env=ENVIRONMENT | environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return Said(done.returncode, done.stdout)


@dataclass(frozen=True, slots=True)
class Layer:
    """Where the changes to a root go."""

    folder: Path

    @property
    def upper(self) -> Path:
        return self.folder / "upper"


class Root:
    """`lowers`: the layers below, the topmost first. Once closed, its layer may be a lower of another."""

    def __init__(self, lowers: list[Path], layer: Layer) -> None:
        for name in ("upper", "work", "merged"):
            (layer.folder / name).mkdir()
        merged = layer.folder / "merged"
        options = f"lowerdir={':'.join(map(str, lowers))},upperdir={layer.upper},workdir={layer.folder / 'work'}"
        script = f"""
            mount -t overlay overlay -o '{options}' '{merged}'
            mount -t proc proc '{merged}/proc'
            mount --rbind /dev '{merged}/dev'
            mount -t tmpfs tmpfs '{merged}/run'
            exec chroot '{merged}' cat
        """
        self._holder = subprocess.Popen(
            [*PRIVATE, "sh", "-ec", script],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        assert self._holder.stdin is not None
        assert self._holder.stdout is not None
        # `cat` answers once it stands in the root; from then on its root is ours.
        self._holder.stdin.write(b"in\n")
        self._holder.stdin.flush()
        assert self._holder.stdout.readline() == b"in\n"
        self.merged = Path(f"/proc/{self._holder.pid}/root")
        for name in THE_WAY_OUT:
            if Path(name).exists():
                self.at(name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(name, self.at(name))

    def __enter__(self) -> Root:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Its mounts go with the process that holds them; the layer stays as it is."""
        assert self._holder.stdin is not None
        assert self._holder.stdout is not None
        self._holder.stdin.close()
        self._holder.wait(30)
        self._holder.stdout.close()

    def at(self, path: str) -> Path:
        """Where the tests see a file of the root. Not for following links within."""
        return self.merged / path.lstrip("/")

    def run(self, *command: str, **environment: str) -> Said:
        """In the root, as its root."""
        pid = str(self._holder.pid)
        return said(["nsenter", "--target", pid, "--mount", "--root", "--wd", *command], environment)

    def shell(self, script: str) -> Said:
        return self.run("bash", "-ec", script)

    def receive(self, folder: Path, path: str) -> None:
        shutil.copytree(folder, self.at(path), symlinks=True)

    def inventory(self, *, times: bool) -> dict[str, tuple[object, ...]]:
        """Everything that stands there: kind, mode, owner and contents, with `times` the moment of its last change."""
        found: dict[str, tuple[object, ...]] = {}
        for folder, folders, files in os.walk(self.merged):
            where = "/" + os.path.relpath(folder, self.merged).removeprefix(".").lstrip("/")
            folders[:] = [name for name in folders if os.path.join(where, name) not in PASSING]
            for name in (*folders, *files):
                path = Path(folder, name)
                inside = os.path.join(where, name)
                # The copies that useradd and groupadd keep of their files.
                if inside.startswith("/etc/") and name.endswith("-"):
                    continue
                has = path.lstat()
                what: str = ""
                if stat.S_ISLNK(has.st_mode):
                    what = os.readlink(path)
                elif stat.S_ISREG(has.st_mode):
                    what = _contents(path, (has.st_ino, has.st_size, has.st_mtime_ns, has.st_ctime_ns))
                found[inside] = (has.st_mode, has.st_uid, has.st_gid, what, has.st_mtime_ns if times else None)
        return found
