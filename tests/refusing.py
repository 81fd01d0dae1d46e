"""A card that refuses to write a file, as a full or read-only one does: for the tests of the files on it.

Knows how a file is replaced: its new content is first written beside it. Knows nothing of the content.
"""

from __future__ import annotations

from pathlib import Path

from rotator.store.whole import NEW


def refuse(path: Path) -> Path:
    """From now on this file cannot be replaced, until the folder that is returned is removed.

    The folder stands where the new content would be written.
    """
    blocked = path.with_name(path.name + NEW)
    blocked.mkdir(parents=True, exist_ok=True)
    return blocked
