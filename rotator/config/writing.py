"""Puts a new text in the place of the configuration file: one at a time, whole, with the old one beside it.

Knows the file. Knows no TOML: a start of the box loads this, and not what writes TOML.
"""

from __future__ import annotations

import threading
from pathlib import Path

from rotator.store.whole import write_whole

WRITING = threading.Lock()
"""Held from reading the file to replacing it: a calibration and the page do not undo each other's change."""


def replace(path: Path, before: str, text: str) -> None:
    """Write the new text; the old one stays beside it as `.bak`. Raises OSError."""
    write_whole(path.with_name(path.name + ".bak"), before, like=path)
    write_whole(path, text)
