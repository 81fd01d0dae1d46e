"""A backup of the box: its configuration and what it has learnt, in one file; and the way back.

A restored backup is checked, then waits beside the configuration until the box starts again. Then all of it is put in
place before anything is loaded, and the old files are kept as a backup of their own. A power cut at any time leaves the
old box or the new one. Knows which files belong to a backup, and how each is checked.

Left out on purpose: counts, because the antenna has moved since; doubts about relays, because a relay does not mend
itself; pairings, because a revoked pairing must stay revoked.
"""

from __future__ import annotations

import io
import json
import logging
import zipfile
import zlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from rotator import __version__
from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.store import compass, knobs, learnt, priorities
from rotator.store.forms import Form, LaterFormError
from rotator.store.plain import read_plain
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FORM = Form("rotator backup")
ABOUT, CONFIGURATION, LEARNT = "backup.json", "rotator.toml", "state.json"
CHECKS: Mapping[str, Callable[[str], object]] = {
    LEARNT: learnt.decode,
    compass.FILE_NAME: compass.decode,
    knobs.FILE_NAME: knobs.decode,
    priorities.FILE_NAME: priorities.decode,
}
"""The files that may be in it beside the configuration. Each check raises ValueError."""
MOST_BYTES = 1_000_000
LARGEST_PART = 300_000
WAITING, UNDER_WAY, FAILED, BEFORE = ".restore", ".restoring", ".restore-failed", ".before-restore.zip"
"""The endings of the names beside the configuration's."""

Write = Callable[[Path, str | bytes], None]


class BackupError(ValueError):
    """The file is no backup that this box can use. The text says why."""


@dataclass(frozen=True, slots=True)
class Backup:
    """A checked backup. `parts`: the texts of the state's files, by name."""

    made: str
    program: str
    text: str
    """The configuration file."""
    config: Config
    parts: Mapping[str, str]


def pack(path: Path, config: Config | None, utc_s: float) -> bytes:
    """A backup of the present files. `config` tells where the state is; None: the file cannot be used.

    Raises OSError if the configuration cannot be read.
    """
    texts = {CONFIGURATION: read_plain(path)}
    if config is not None:
        for name in CHECKS:
            with suppress(OSError):  # this box has learnt nothing of it
                texts[name] = read_plain(_place(config, name))
    made = datetime.fromtimestamp(utc_s, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    about = {"format": FORM.today, "made": made, "program": __version__}
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in ((ABOUT, json.dumps(about, indent=1).encode() + b"\n"), *texts.items()):
            file.writestr(name, data)
    return packed.getvalue()


def check(data: bytes) -> Backup:
    """Everything in it, checked as the start of the box checks it. Raises BackupError."""
    if len(data) > MOST_BYTES:
        raise BackupError(f"this file has more than {MOST_BYTES // 1_000_000} MB: it is no backup of a rotator")
    texts = _unpacked(data)
    if missing := [name for name in (ABOUT, CONFIGURATION) if name not in texts]:
        raise BackupError(f"this is no backup of a rotator: {missing[0]} is not in it")
    try:
        about = FORM.brought_up(json.loads(texts[ABOUT]))
    except LaterFormError as fault:
        raise BackupError(f"{fault}. Update this box first") from fault
    except (ValueError, RecursionError) as fault:
        raise BackupError(f"this is no backup of a rotator: {ABOUT}: {fault}") from fault
    try:
        config = parse(texts[CONFIGURATION], f"{CONFIGURATION} of the backup")
    except ConfigError as fault:
        raise BackupError(str(fault)) from fault
    parts = {name: text for name, text in texts.items() if name in CHECKS}
    for name, text in parts.items():
        try:
            CHECKS[name](text)
        except ValueError as fault:
            raise BackupError(f"{name} of the backup: {fault}") from fault
    return Backup(
        str(about.get("made", ""))[:40], str(about.get("program", ""))[:40], texts[CONFIGURATION], config, parts
    )


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
    """All of it, or nothing. Raises OSError."""
    files = {_place(backup.config, name): text for name, text in backup.parts.items()}
    before: dict[Path, bytes | None] = {}
    try:
        # The configuration last: it decides which box starts.
        for file, text in (*files.items(), (path, backup.text)):
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


def _give_up(path: Path) -> None:
    """It is not tried at each start."""
    for ending in (WAITING, UNDER_WAY):
        with suppress(FileNotFoundError):
            _beside(path, ending).replace(_beside(path, FAILED))


def _usable(path: Path) -> Config | None:
    try:
        return parse(read_plain(path).decode("utf-8-sig"), str(path))
    except (ConfigError, UnicodeDecodeError):
        return None


def _place(config: Config, name: str) -> Path:
    state = Path(config.state.path)
    return state if name == LEARNT else state.with_name(name)


def _beside(path: Path, ending: str) -> Path:
    # Also of a path without a name, such as a folder: the loader says what is wrong with it.
    return path.parent / (path.name + ending)


def _unpacked(data: bytes) -> dict[str, str]:
    """The texts in the zip, by name. Only names of a backup count, so none of them leads anywhere else.

    Raises BackupError.
    """
    known = (ABOUT, CONFIGURATION, *CHECKS)
    texts: dict[str, str] = {}
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as file:
            for info in file.infolist():
                name = info.filename
                if name not in known or name in texts:
                    raise BackupError(f"this is no backup of a rotator: it holds {name[:60]!a}")
                if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                    # The others ask for as much memory as the file says, and fail in ways of their own.
                    raise BackupError(f"this is no backup of a rotator: {name} is packed in another way")
                with file.open(info) as part:
                    # What it says of its size is not believed: a small zip can hold a very large file.
                    content = part.read(LARGEST_PART + 1)
                if len(content) > LARGEST_PART:
                    raise BackupError(
                        f"{name} of the backup has more than {LARGEST_PART // 1000} kB: it is none of ours"
                    )
                texts[name] = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise BackupError("this backup is damaged: a file in it is no text") from None
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError, ValueError) as fault:
        if isinstance(fault, BackupError):
            raise
        raise BackupError(f"this is no backup of a rotator, or it is damaged: {fault}") from fault
    return texts
