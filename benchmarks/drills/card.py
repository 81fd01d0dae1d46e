"""The memory card of the box of a drill, which refuses to be written for a while, as a full or read-only one does.

Knows the names of the files in its state folder, and how a file is replaced. What can be read stays readable.
"""

from __future__ import annotations

from pathlib import Path

from rotator.store import counts, knobs, latch, relays, tries
from rotator.store.whole import NEW

NAMES = ("state.json", counts.FILE_NAME, knobs.FILE_NAME, latch.FILE_NAME, relays.FILE_NAME, tries.FILE_NAME)


def refuse(folder: Path, *, refuses: bool) -> None:
    """From now on no file in the folder can be replaced; `refuses` False: every file can again."""
    for name in NAMES:
        # A folder takes the name under which the new content would first be written.
        where = folder / (name + NEW)
        if refuses:
            where.mkdir(exist_ok=True)
        elif where.is_dir():
            where.rmdir()
