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
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or b"\0" in data[:4]:
        raise NoTextError(
            Mistake(
                'is saved as UTF-16 (as PowerShell\'s ">" and "Unicode" in Notepad do): save it as UTF-8, '
                f"or convert it: iconv -f UTF-16 -t UTF-8 {path} > new.toml"
            )
        )
    try:
        # Windows' editor begins a file with a byte order mark, which is no TOML.
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data[: fault.start].count(b"\n") + 1
        row = data.split(b"\n")[line - 1].decode("cp1252", "replace")
        raise NoTextError(
            Mistake(
                f"{row.strip()[:60]}: is not saved as UTF-8 (perhaps as ANSI or Latin-1): save the file as UTF-8",
                (line,),
            )
        ) from fault
