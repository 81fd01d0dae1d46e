"""The sources as they are handed out: which files, of which version, of which moment.

Knows git, and a folder without git, as unpacked from an sdist. Knows nothing of archives. Two builds of one commit must
give the same bytes: so each file comes from git's own list, with one mode and one time; the builder's folder, clock
and umask have no part in it.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

VERSION = re.compile(r'^__version__ = "(.+)"$', re.MULTILINE)


class ReleaseError(Exception):
    """Why nothing was built, as a sentence."""


@dataclass(frozen=True, slots=True)
class Source:
    """`epoch_s`: the moment of the last commit, in seconds since 1970. Every time in what is built is this one."""

    folder: Path
    epoch_s: int

    @classmethod
    def at(cls, folder: Path) -> Source:
        said = os.environ.get("SOURCE_DATE_EPOCH") or _git(folder, "log", "-1", "--format=%ct")
        # An unpacked sdist: its files have the moment with which it was made.
        return cls(folder, int(said) if said else int((folder / "pyproject.toml").stat().st_mtime))

    @property
    def version(self) -> str:
        found = VERSION.search((self.folder / "rotator/__init__.py").read_text(encoding="utf-8"))
        if found is None:
            raise ReleaseError("rotator/__init__.py has no line __version__")
        return found[1]

    @property
    def is_tagged(self) -> bool:
        """Whether the last commit is the release of this version: it has the tag v0.1.0, say."""
        return f"v{self.version}" in _git(self.folder, "tag", "--points-at", "HEAD").split()

    def copy_to(self, folder: Path) -> None:
        """The files of the project, as they are now, with the modes and the time that they have everywhere."""
        names = _git(self.folder, "ls-files", "-z").split("\0")[:-1]
        if names:
            for name in names:
                if (self.folder / name).is_file():
                    (folder / name).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy2(self.folder / name, folder / name)
        else:
            made = shutil.ignore_patterns("__pycache__", ".venv", ".*_cache", ".hypothesis")
            shutil.copytree(self.folder, folder, dirs_exist_ok=True, ignore=made)
            for name in ("dist", "run"):
                shutil.rmtree(folder / name, ignore_errors=True)
            (folder / "PKG-INFO").unlink(missing_ok=True)  # the sdist's own, made anew
        settle(folder, self.epoch_s)


def settle(folder: Path, epoch_s: int) -> None:
    """One mode and one time for everything below: rw-r--r--, and x where the owner has it."""
    for path in (*folder.rglob("*"), folder):
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o100 else 0o644)
        os.utime(path, (epoch_s, epoch_s), follow_symlinks=False)


def run(*command: str | Path, epoch_s: int, cwd: Path | None = None) -> str:
    """What the program prints. Raises ReleaseError with its last words if it fails."""
    environment = os.environ | {"SOURCE_DATE_EPOCH": str(epoch_s), "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "0"}
    try:
        done = subprocess.run(
            list(map(str, command)), cwd=cwd, env=environment, capture_output=True, text=True, check=False
        )
    except FileNotFoundError as fault:
        raise ReleaseError(f"{command[0]} is missing") from fault
    if done.returncode != 0:
        raise ReleaseError(f"{Path(command[0]).name} failed: {done.stderr.strip()[-2000:] or done.stdout[-2000:]}")
    return done.stdout


def _git(folder: Path, *words: str) -> str:
    """What git says of this folder; nothing where it is no work tree, or only lies in another one."""
    if not (folder / ".git").exists():
        return ""
    done = subprocess.run(["git", "-C", folder, *words], capture_output=True, text=True, check=False)
    return done.stdout.strip(" \n") if done.returncode == 0 else ""
