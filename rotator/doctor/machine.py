"""The computer that the doctor checks, as a value: its file tree, programs, packages, user and chips.

Reads files and runs programs. Does not judge what it reads, and writes nothing.
"""

from __future__ import annotations

import itertools
import os
import pwd
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rotator.assembly.chips import Chips, real_chips
from rotator.doctor.finding import Finding, fine, wrong

PATIENCE_S = 5.0
"""A program that takes longer does not answer, in seconds."""
SERVICE_USER = "rotator"
SERVICE_FOLDERS = (Path("/run/rotator"), Path("/var/lib/rotator"))
"""The service manager makes these for the service whenever it starts."""
UNITS = ("/etc/systemd/system/rotator.service", "/usr/lib/systemd/system/rotator.service")


@dataclass(frozen=True, slots=True)
class Silent:
    """A box runs, and does not answer."""

    why: str


@dataclass(frozen=True, slots=True)
class Machine:
    root: Path
    """The root of its file tree."""
    programs: str
    """The folders of its programs, as in PATH."""
    packages: tuple[str, ...]
    """The folders of its Python packages, as in `sys.path`."""
    python: tuple[int, int, int]
    pointer_bits: int
    """32 or 64, of that Python."""
    kernel: tuple[str, str]
    """Release and machine, as in `uname`."""
    user: str
    """The user who runs the doctor; under sudo, the user who called sudo."""
    free_bytes: Callable[[Path], int]
    """Free bytes on the disk with that file."""
    chips: Chips
    ask_box: Callable[[], dict[str, Any] | Silent | str | None] = lambda: None
    """The status of the running box, as an object; or why it cannot be asked; None: no box runs."""
    utc_s: Callable[[], float] = time.time
    """The clock of this machine."""

    def at(self, path: str | Path) -> Path:
        """A file of this machine; a relative path starts in the working folder, as the program's does."""
        path = Path(path)
        return self.root / path.relative_to("/") if path.is_absolute() else path

    def text(self, path: str | Path) -> str | None:
        """The text of a file, without the white space and NUL around it; None where it cannot be read."""
        try:
            return self.at(path).read_text(encoding="utf-8", errors="replace").strip(" \t\r\n\0")
        except OSError:
            return None

    def opens(self, device: str, group: str, absent: str) -> Finding:
        """Whether the user may read and write a device, which this group may. `absent`: what to do if there is none."""
        path = self.at(device)
        if not path.exists():
            return wrong(f"{device} is not there", absent)
        if not os.access(path, os.R_OK | os.W_OK):
            return wrong(f"{device}: you may not open it", f"sudo usermod -aG {group} {self.user}, then log in again.")
        return fine(f"{device} is there and may be opened")

    def glob(self, pattern: str) -> list[Path]:
        """The files that match an absolute pattern, as this machine names them, sorted."""
        return [Path("/", path.relative_to(self.root)) for path in sorted(self.root.glob(pattern.removeprefix("/")))]

    def says(self, program: str, *arguments: str) -> str | None:
        """The output of a program; None where it is missing, fails or hangs."""
        path = shutil.which(program, path=self.programs)
        if path is None:
            return None
        try:
            asked = subprocess.run(
                [path, *arguments],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=PATIENCE_S,
                check=True,
                env={"PATH": self.programs, "LC_ALL": "C"},
            )
        except (OSError, subprocess.SubprocessError):
            return None
        return asked.stdout.decode("utf-8", "replace").strip()

    @property
    def listening(self) -> set[str]:
        """The paths of the Unix sockets on which programs listen, as they named them."""
        rows = [line.split(maxsplit=7) for line in (self.text("/proc/net/unix") or "").splitlines()[1:]]
        return {row[7] for row in rows if len(row) == 8}

    def holder(self, opened: set[str]) -> list[str] | None:
        """The command line of a program that has one of these files open; None: no program, or this user may not see
        it.
        """
        for descriptor in self.glob("/proc/[0-9]*/fd/*"):
            try:
                target = os.readlink(self.at(descriptor))
            except OSError:
                continue
            if target in opened:
                return (self.text(descriptor.parents[1] / "cmdline") or "a process without a name").split("\0")
        return None

    @property
    def model(self) -> str:
        """The name of the board, such as `Raspberry Pi 4 Model B Rev 1.4`; empty on a PC."""
        # The service does not see the first of the two.
        return self.text("/proc/device-tree/model") or self.text("/sys/firmware/devicetree/base/model") or ""

    @property
    def is_pi(self) -> bool:
        return self.model.startswith("Raspberry Pi")

    @property
    def unit(self) -> str | None:
        """The service's unit file; None where the service is not installed."""
        return next((text for path in UNITS if (text := self.text(path)) is not None), None)

    def may_write_in(self, folder: Path) -> bool:
        """Whether the user, or an installed service, may write there. For a missing folder its parent counts."""
        if self.unit is not None and any(folder.is_relative_to(made) for made in SERVICE_FOLDERS):
            return True
        place = nearest(self.at(folder))
        return place.is_dir() and os.access(place, os.W_OK | os.X_OK)


def shown(command: Sequence[str]) -> str:
    """A program's command line without its options, which may hold a password: the program, and what it runs."""
    words = list(itertools.takewhile(lambda word: not word.startswith("-"), command))[:2]
    return " ".join(words or command[:1])


def nearest(path: Path) -> Path:
    """The path itself if it is there, else the nearest folder above it that is."""
    path = path.absolute()
    return next(place for place in (path, *path.parents) if place.exists())


def this_machine() -> Machine:
    uname = os.uname()
    return Machine(
        root=Path("/"),
        programs=os.pathsep.join((os.environ.get("PATH", os.defpath), "/usr/sbin", "/sbin")),
        packages=tuple(sys.path),
        python=sys.version_info[:3],
        pointer_bits=64 if sys.maxsize > 2**32 else 32,
        kernel=(uname.release, uname.machine),
        user=os.environ.get("SUDO_USER") or _name(os.getuid()),
        free_bytes=lambda path: shutil.disk_usage(path).free,
        chips=real_chips(),
    )


def _name(uid: int) -> str:
    try:
        return pwd.getpwuid(uid).pw_name
    except KeyError:
        return str(uid)
