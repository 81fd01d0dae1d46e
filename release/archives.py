"""The wheel and the sdist, by PyPA's build. The wheel is made from the sdist, as by a person who has only that.

Knows build's command line. What is in them stands in pyproject.toml.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

from release.source import Source, run


def build(source: Source, into: Path) -> tuple[Path, Path]:
    """The sdist and the wheel in the folder `into`. Two builds of the same commit are the same to the byte."""
    into.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        tree, made = Path(scratch, "tree"), Path(scratch, "made")
        source.copy_to(tree)
        run(sys.executable, "-m", "build", "--no-isolation", "--outdir", made, tree, epoch_s=source.epoch_s)
        sdist, wheel = sorted(made.glob("*.tar.gz")) + sorted(made.glob("*.whl"))
        return Path(shutil.copy(sdist, into)), Path(shutil.copy(wheel, into))
