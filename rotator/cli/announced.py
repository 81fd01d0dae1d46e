"""Which boxes a user runs, and in which folders: so that `rotator stop` stops a box from any folder.

A box in the foreground leaves a small file while it runs: the path of its monitor's socket, its folder and its file.
Knows these files. Does not connect: a box that was killed leaves its file, and the next start removes it. The service
needs none, for its sockets have a place of their own.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from rotator.config.places import console_path

FOLDER = Path("gs232-rotator", "boxes")


class Announced(NamedTuple):
    monitor: Path
    folder: Path
    """Where it was started."""
    config: Path | None
    """Its configuration file; None: the simulated rotor."""

    @property
    def named(self) -> str:
        """How a person finds it."""
        return f"the box in {self.folder}" + (f" (--config {self.config})" if self.config else "")


@contextmanager
def announced(monitor: Path, config: Path | None, environment: Mapping[str, str] = os.environ) -> Iterator[None]:
    """Leave the file while the box runs. Where that cannot be, commands find the box from its own folder alone."""
    note = _folder(environment) / str(os.getpid())
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


def boxes(environment: Mapping[str, str] = os.environ) -> list[Announced]:
    """The boxes of this user whose sockets are there."""
    try:
        notes = sorted(_folder(environment).iterdir())
    except OSError:
        return []
    return [box for note in notes if (box := _read(note)) is not None and console_path(box.monitor).is_socket()]


def _read(note: Path) -> Announced | None:
    try:
        monitor, folder, config = note.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return None
    return Announced(Path(monitor), Path(folder), Path(config) if config else None)


def _remove_old(folder: Path) -> None:
    for note in folder.iterdir():
        box = _read(note)
        if box is None or not console_path(box.monitor).is_socket():
            note.unlink(missing_ok=True)


def _folder(environment: Mapping[str, str]) -> Path:
    state = environment.get("XDG_STATE_HOME") or os.path.expanduser("~/.local/state")
    return Path(state) / FOLDER
