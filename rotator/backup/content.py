"""The content of a backup of the box: its configuration and what it has learnt, in one file; and the check of it.

Knows which sections of the state belong to a backup, and how each is checked; and that an earlier version put a file
for each of them into it. Does not know how a backup is put in place: `restore` does.

Left out on purpose: counts, because the antenna has moved since; doubts about relays, because a relay does not mend
itself; pairings, because a revoked pairing must stay revoked.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from rotator import __version__
from rotator.config.load import ConfigError, parse
from rotator.config.model import Config
from rotator.exchange.foreign import json_of
from rotator.store import learnt
from rotator.store.favourites import FAVOURITES
from rotator.store.json_file import Form, LaterFormError, decode, encode
from rotator.store.learnt import COMPASS, KNOBS
from rotator.store.plain import read_plain
from rotator.store.priorities import PRIORITIES
from rotator.store.state import EARLIER, Sections, State
from rotator.store.state import FORM as STATE_FORM

FORM = Form("rotator backup")
ABOUT, CONFIGURATION, STATE = "backup.json", "rotator.toml", "state.json"
CHECKS: Mapping[str, Callable[[Any], object]] = {
    learnt.LEARNT.name: learnt.check,
    **{section.name: section.parse for section in (COMPASS, FAVOURITES, KNOBS, PRIORITIES)},
}
"""The sections of the state that belong to a backup. Each check raises as a section's `parse` does."""
FORMS = {STATE: STATE_FORM, **{f"{name}.json": form for name, form in EARLIER.items() if name in CHECKS}}
"""The files that may be in it beside the configuration."""
MOST_BYTES = 1_000_000
LARGEST_PART = 300_000


class BackupError(ValueError):
    """The file is no backup that this box can use. The text says why."""


@dataclass(frozen=True, slots=True)
class Backup:
    """A checked backup. `parts`: of the state."""

    made: str
    program: str
    text: str
    """The configuration file."""
    config: Config
    parts: Sections


def pack(path: Path, config: Config | None, utc_s: float) -> bytes:
    """A backup of the present files. `config` tells where the state is; None: the file cannot be used.

    Raises OSError if the configuration cannot be read.
    """
    texts = {CONFIGURATION: read_plain(path)}
    if config is not None:
        sections = State(Path(config.state.path)).sections
        parts = {name: content for name, content in sections.items() if name in CHECKS and not _damage(name, content)}
        if parts:
            texts[STATE] = encode(STATE_FORM, parts).encode()
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
        about = FORM.brought_up(json_of(texts[ABOUT]))
    except LaterFormError as fault:
        raise BackupError(f"{fault}. Update this box first") from fault
    except ValueError as fault:
        raise BackupError(f"this is no backup of a rotator: {ABOUT}: {fault}") from fault
    try:
        config = parse(texts[CONFIGURATION], f"{CONFIGURATION} of the backup")
    except ConfigError as fault:
        raise BackupError(str(fault)) from fault
    parts: dict[str, Any] = {}
    for name in FORMS.keys() & texts.keys():
        parts |= _parts(name, texts[name])
    return Backup(
        str(about.get("made", ""))[:40], str(about.get("program", ""))[:40], texts[CONFIGURATION], config, parts
    )


def _parts(name: str, text: str) -> Sections:
    """The sections that a file of the backup has. Raises BackupError."""

    def checked(content: dict[str, Any]) -> dict[str, Any]:
        found = {key: each for key, each in content.items() if key != "format"}
        parts = found if name == STATE else {name.removesuffix(".json"): found}
        for key, each in parts.items():
            if key not in CHECKS:
                raise ValueError(f"{key[:40]!a} belongs to no backup")
            CHECKS[key](each)
        return parts

    try:
        return decode(FORMS[name], text, checked)
    except ValueError as fault:
        raise BackupError(f"{name} of the backup: {fault}") from fault


def _damage(name: str, content: Any) -> bool:
    try:
        CHECKS[name](content)
    except (ValueError, KeyError, TypeError, AttributeError):
        return True
    return False


def _unpacked(data: bytes) -> dict[str, str]:
    """The texts in the zip, by name. Only names of a backup count, so none of them leads anywhere else.

    Raises BackupError.
    """
    known = (ABOUT, CONFIGURATION, *FORMS)
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
                    # The size that a zip names is not believed: a small zip can hold a very large file.
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
