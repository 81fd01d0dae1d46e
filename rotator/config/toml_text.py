"""The text of a configuration file, and why a file has none.

Knows encodings. Does not know TOML.
"""

from __future__ import annotations

import codecs
from pathlib import Path

from rotator.config.mistake import Mistake
from rotator.store.plain import read_plain


class NoTextError(Exception):
    """The file holds no text that can be read. `mistake` says why."""

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake)
        self.mistake = mistake


def read(path: Path) -> str:
    """Raises OSError, NoTextError."""
    data = read_plain(path)
    is_utf16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if b"\0" in data and not is_utf16 and not _every_second_is_zero(data):
        raise NoTextError(Mistake(_damaged(path)))
    if b"\0" in data or is_utf16:
        raise NoTextError(
            Mistake(
                'is saved as UTF-16 (as PowerShell\'s ">" and "Unicode" in Notepad do): save it as UTF-8, '
                f"or convert it: iconv -f UTF-16 -t UTF-8 {path} > new.toml"
            )
        )
    try:
        # Windows' editor begins a file with a byte order mark, which is no TOML.
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data[: fault.start].count(b"\n") + 1
        row = data.split(b"\n")[line - 1].decode("cp1252", "replace")
        raise NoTextError(
            Mistake(
                f"{row.strip()[:60]}: is not saved as UTF-8 (perhaps as ANSI or Latin-1): save the file as UTF-8",
                (line,),
            )
        ) from fault
    if begins_as := next((kind for mark, kind in _OTHERS if text.lstrip()[:1] == mark), None):
        raise NoTextError(Mistake(f"{begins_as}: `rotator config --list` shows the shipped files, and how to get one"))
    return text


_OTHERS = (
    ("{", "is JSON, and this file is TOML, with lines such as min_deg = 0"),
    ("<", "is a web page (HTML) that was saved in place of the file behind its link"),
)


def _every_second_is_zero(data: bytes) -> bool:
    """UTF-16 and UTF-32 without a byte order mark have a zero beside each plain character."""
    return data.count(0) * 3 >= len(data) and data.strip(b"\0") != b"" and b"\0\0\0\0" not in data


def _damaged(path: Path) -> str:
    copies = [path.with_name(path.name + ".bak"), *path.parent.glob(f"{path.name}.before-rotator-*")]
    there = [copy for copy in copies if copy.is_file() and b"\0" not in copy.read_bytes()[:4096]]
    newest = max(there, key=lambda copy: copy.stat().st_mtime, default=None)
    cure = f"take its copy: cp {newest} {path}" if newest else "write it anew: `rotator config --ask --to FILE`"
    return f"is damaged: it holds zero bytes, as a power cut leaves them: {cure}"
