"""Which boxes a user runs, and in which folders: so that `rotator stop` stops a box from any folder.

A box in the foreground leaves a small file while it runs: the path of its monitor's socket, its folder and its file.
Root finds every user's: with `sudo` a person means the box that runs, also another user's. Knows these files. Does not
connect: a box that was killed leaves its file, and the next start removes it. The service needs none, for its sockets
have a place of their own.
"""

from __future__ import annotations

import os
import pwd
import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from rotator.config.places import console_path

FOLDER = Path("gs232-rotator", "boxes")
STATE_OF_A_USER = Path(".local", "state")
LONGEST = 16384
"""More bytes than two paths and a folder can have."""


class Home(NamedTuple):
    """Another user's home folder."""

    folder: Path
    owner: int


class Announced(NamedTuple):
    monitor: Path
    folder: Path
    """The folder in which the box was started."""
    config: Path | None
    """Its configuration file; None: the simulated rotor."""

    @property
    def fields(self) -> dict[str, str | None]:
        """How a script finds it."""
        return {"folder": str(self.folder), "config": str(self.config) if self.config else None}

    @property
    def named(self) -> str:
        """How a person finds it."""
        return f"the box in {self.folder}" + (f" (--config {self.config})" if self.config else "")


@contextmanager
def announced(monitor: Path, config: Path | None) -> Iterator[None]:
    """Leave the file while the box runs. Where that cannot be, commands find the box from its own folder alone."""
    note = _folder() / str(os.getpid())
    lines = (monitor.absolute(), Path.cwd(), config.resolve() if config else "")
    with suppress(OSError):
        note.parent.mkdir(parents=True, exist_ok=True)
        _remove_old(note.parent)
        note.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    try:
        yield
    finally:
        with suppress(OSError):
            note.unlink(missing_ok=True)


def boxes(others: Sequence[Home] | None = None) -> list[Announced]:
    """The boxes of this user whose sockets are there. For root also those of `others`, which are all other users."""
    others = _other_homes() if others is None else others
    found = _boxes_in(_folder())
    for home in others:
        found += _boxes_in(home.folder / STATE_OF_A_USER / FOLDER, home.owner)
    return list(dict.fromkeys(found))


def _boxes_in(folder: Path, owner: int | None = None) -> list[Announced]:
    """`owner`: files and sockets of other users do not count, or this user could lead root to another one's box."""
    try:
        notes = sorted(folder.iterdir())
    except OSError:
        return []
    return [box for note in notes if (box := _read(note, owner)) is not None and _is_there(box, owner)]


def _is_there(box: Announced, owner: int | None) -> bool:
    try:
        socket_file = console_path(box.monitor).lstat()
    except OSError:
        return False
    return stat.S_ISSOCK(socket_file.st_mode) and owner in (None, socket_file.st_uid)


def _other_homes() -> list[Home]:
    """For root: of every user but root."""
    if os.geteuid() != 0:
        return []
    return [Home(Path(user.pw_dir), user.pw_uid) for user in pwd.getpwall() if user.pw_uid != 0]


def _read(note: Path, owner: int | None) -> Announced | None:
    try:
        # Another user may have put a link or a pipe there: it is not followed, and not waited for.
        file = os.open(note, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        with open(file, "rb") as opened:
            file_stat = os.fstat(file)
            if not stat.S_ISREG(file_stat.st_mode) or owner not in (None, file_stat.st_uid):
                return None
            monitor, folder, config = opened.read(LONGEST).decode("utf-8").splitlines()
        return Announced(Path(monitor), Path(folder), Path(config) if config else None)
    except (OSError, ValueError):
        return None


def _remove_old(folder: Path) -> None:
    for note in folder.iterdir():
        box = _read(note, None)
        if box is None or not _is_there(box, None):
            note.unlink(missing_ok=True)


def _folder() -> Path:
    state = os.environ.get("XDG_STATE_HOME") or Path(os.path.expanduser("~")) / STATE_OF_A_USER
    return Path(state) / FOLDER
