"""The text of a configuration file: read, with the reason why a file has none; and replaced, whole.

Knows encodings, and that one changes the file at a time. Does not know TOML: a start of the box loads this, and not
what writes TOML.
"""

from __future__ import annotations

import codecs
import threading
from pathlib import Path

from rotator.config.mistake import ConfigError, Mistake
from rotator.store.plain import read_plain
from rotator.store.whole import write_whole

WRITING = threading.Lock()
"""Held from reading the file to replacing it: a calibration and the page do not undo each other's change."""


def replace(path: Path, before: str, text: str) -> None:
    """Write the new text; the old one stays beside it as `.bak`. Raises OSError."""
    write_whole(path.with_name(path.name + ".bak"), before, like=path)
    write_whole(path, text)


def read(path: Path) -> str:
    """Raises OSError; ConfigError for a file that holds no text."""
    data = read_plain(path)
    is_utf16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if b"\0" in data and not is_utf16 and not _every_second_is_zero(data):
        raise _no_text(path, _damaged(path))
    if b"\0" in data or is_utf16:
        raise _no_text(
            path,
            'is saved as UTF-16 (as PowerShell\'s ">" and "Unicode" in Notepad do): save it as UTF-8, '
            f"or convert it: iconv -f UTF-16 -t UTF-8 {path} > new.toml",
        )
    try:
        # Windows' editor begins a file with a byte order mark, which is no TOML.
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data[: fault.start].count(b"\n") + 1
        row = data.split(b"\n")[line - 1].decode("cp1252", "replace").strip()
        why = f"{row[:60]}: is not saved as UTF-8 (perhaps as ANSI or Latin-1): save the file as UTF-8"
        raise _no_text(path, why, line) from fault
    if begins_as := _OTHERS.get(text.lstrip()[:1]):
        raise _no_text(path, f"{begins_as}: `rotator config --list` shows the shipped files, and how to get one")
    return text


_OTHERS = {
    "{": "is JSON, and this file is TOML, with lines such as min_deg = 0",
    "<": "is a web page (HTML) that was saved in place of the file behind its link",
}


def _no_text(path: Path, why: str, *lines: int) -> ConfigError:
    return ConfigError(str(path), [Mistake(why, lines)])


def _every_second_is_zero(data: bytes) -> bool:
    """UTF-16 and UTF-32 without a byte order mark have a zero beside each plain character."""
    return data.count(0) * 3 >= len(data) and data.strip(b"\0") != b"" and b"\0\0\0\0" not in data


def _damaged(path: Path) -> str:
    copies = [path.with_name(path.name + ".bak"), *path.parent.glob(f"{path.name}.before-rotator-*")]
    there = [copy for copy in copies if copy.is_file() and b"\0" not in copy.read_bytes()[:4096]]
    newest = max(there, key=lambda copy: copy.stat().st_mtime, default=None)
    cure = f"take its copy: cp {newest} {path}" if newest else "write it anew: `rotator config --ask --to FILE`"
    return f"is damaged: it holds zero bytes, as a power cut leaves them: {cure}"
