"""Puts a backup in place at the next start of the box.

A restored backup is checked, then waits beside the configuration until the box starts again. Then all of it is put in
place before anything is loaded, and the old files are kept as a backup of their own. A power cut at any time leaves the
old box or the new one. Knows the files that wait, and the order of writing. `content` knows what is in a backup.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rotator.backup.content import Backup, BackupError, check, pack
from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.store.json_file import encode
from rotator.store.plain import read_plain
from rotator.store.state import FORM, State
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

WAITING, UNDER_WAY, FAILED, BEFORE = ".restore", ".restoring", ".restore-failed", ".before-restore.zip"
"""The endings of the names beside the configuration's."""

Write = Callable[[Path, str | bytes], None]


def stage(path: Path, data: bytes) -> None:
    """Have the next start restore this backup. Raises BackupError, OSError: then nothing has changed."""
    check(data)
    write_whole(_beside(path, WAITING), data)


def complete(path: Path, utc_s: float, write: Write = write_whole) -> bool:
    """At the start, before anything is loaded: put in place what waits. Returns whether something was restored.

    Raises nothing: a box that cannot restore starts as it was, and says so.
    """
    waiting, under_way = _beside(path, WAITING), _beside(path, UNDER_WAY)
    source = under_way if under_way.exists() else waiting
    try:
        data = read_plain(source)
    except FileNotFoundError:
        return False
    except OSError as fault:
        log.error("%s: not restored: %s", source, fault)
        return False
    try:
        backup = check(data)
        if source is waiting:
            write(_beside(path, BEFORE), pack(path, _usable(path), utc_s))
            # From here on a power cut leads to the new box, and the old one is whole in its backup.
            waiting.replace(under_way)
        _put(path, backup, write)
        under_way.unlink()
    except (BackupError, OSError) as fault:
        log.error("%s: not restored, the box is as it was: %s", source, fault)
        with suppress(OSError):
            _give_up(path)
        return False
    log.warning("%s: restored from the backup of %s; %s%s has what was there", path, backup.made, path.name, BEFORE)
    return True


def _put(path: Path, backup: Backup, write: Write) -> None:
    """All of it, or nothing. What a backup does not have of the state stays, a latched stop above all. Raises OSError,
    BackupError."""
    state = State(Path(backup.config.state.path))
    if state.later:
        raise BackupError(f"{state.path}: {state.later}")
    kept = encode(FORM, {**state.sections, **backup.parts})
    before: dict[Path, bytes | None] = {}
    try:
        # The configuration last: it decides which box starts.
        for file, text in ((state.path, kept), (path, backup.text)):
            file.parent.mkdir(parents=True, exist_ok=True)
            before[file] = read_plain(file) if file.exists() else None
            write(file, text)
    except OSError:
        for file, old in before.items():
            if old is None:
                file.unlink(missing_ok=True)
            else:
                write(file, old)
        raise
    state.forget_earlier()


def _give_up(path: Path) -> None:
    """Set aside a backup that could not be put in place, so that no later start tries it again."""
    for ending in (WAITING, UNDER_WAY):
        with suppress(FileNotFoundError):
            _beside(path, ending).replace(_beside(path, FAILED))


def _usable(path: Path) -> Config | None:
    try:
        return parse(read_plain(path).decode("utf-8-sig"), str(path))
    except (ConfigError, UnicodeDecodeError):
        return None


def _beside(path: Path, ending: str) -> Path:
    # Also of a path without a name, such as a folder: the loader says what is wrong with it.
    return path.parent / (path.name + ending)
