"""The files of the page, read once and compressed: serving them touches no disk.

Knows the folder, the types of its files, and the headers that say where they may come from. Does not know their
content.
"""

from __future__ import annotations

import gzip
import hashlib
import re
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).with_name("static")
HTML = "text/html; charset=utf-8"
SCRIPT = "text/javascript; charset=utf-8"
_TYPES = {
    ".html": HTML,
    ".css": "text/css; charset=utf-8",
    ".js": SCRIPT,
    ".mjs": SCRIPT,
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".webmanifest": "application/manifest+json",
}
_REMARK = re.compile(rb"^[ \t]*(?://.*|/\*\*(?:[^*]|\*(?!/))*\*/[ \t]*)$", re.MULTILINE)
"""Remarks on lines of their own are for who reads the source: they would be a twelfth of what is sent. STOP is sent as
it is written."""
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
        "manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
}
"""Headers of each answer. Nothing is loaded from elsewhere, and no other page may show this one in a frame."""


@dataclass(frozen=True, slots=True)
class Asset:
    kind: str
    plain: bytes
    packed: bytes
    tag: str


def load(folder: Path = FOLDER) -> dict[str, Asset]:
    """The files by path, `/app.js`; `/` is the page itself."""
    found = {}
    for file in sorted(folder.rglob("*")):
        if file.suffix in _TYPES:
            content = file.read_bytes()
            if file.suffix == ".js" and file.parent == folder and file.name != "stop.js":
                content = _REMARK.sub(b"", content)
            found[f"/{file.relative_to(folder).as_posix()}"] = packed(_TYPES[file.suffix], content)
    found["/"] = found["/index.html"]
    return found


def packed(kind: str, plain: bytes) -> Asset:
    tag = f'"{hashlib.sha256(plain).hexdigest()[:16]}"'
    return Asset(kind, plain, gzip.compress(plain, 9, mtime=0), tag)
