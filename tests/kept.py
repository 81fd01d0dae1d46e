"""Where things stand that take minutes to make and are the same for every clone: kernels, Debian roots.

Knows the folder of a kind, and how a thing gets there whole: made beside it, then renamed. Knows nothing of what they
are. A name must hold all that the thing depends on; what has another name is another thing.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path


def kept(kind: str) -> Path:
    """The folder of one kind, `$XDG_CACHE_HOME/gs232-rotator/KIND`. It may not be there yet."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "gs232-rotator" / kind


def keep(folder: Path, make: Callable[[Path], None]) -> Path:
    """`folder`, made by `make(half)` unless it stands. Half made it has another name, so that it is never trusted.

    `make` creates `half` itself, beside `folder`. What it raises is raised; nothing is left of the attempt then.
    """
    if folder.exists():
        return folder
    folder.parent.mkdir(parents=True, exist_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix=f"{folder.name}.half-", dir=folder.parent))
    try:
        half = scratch / folder.name
        make(half)
        try:
            half.rename(folder)
        except OSError:
            # Another clone was faster; its own is as good.
            if not folder.exists():
                raise
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return folder
