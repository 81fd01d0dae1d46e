"""Writes release/packages.txt: one version of each package, with the hashes of its files, for every Python we support.

Knows uv's command line, and what moteus declares without needing it.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from release.environment import LOCK
from release.source import Source, run

NOT_NEEDED = ("scipy", "pyelftools", "pywin32")
"""moteus declares them for tools of its own, and for Windows."""
HEAD = "# Which package goes into the Debian package, in which version: `make lock` writes this file anew.\n"


def write(source: Source) -> Path:
    with tempfile.TemporaryDirectory() as scratch:
        never = Path(scratch, "never.txt")
        never.write_text("".join(f'{name}; python_version < "3"\n' for name in NOT_NEEDED))
        text = run(
            *(sys.executable, "-m", "uv", "pip", "compile", "--quiet", "--universal", "--python-version", "3.11"),
            *("--upgrade", "--generate-hashes", "--no-header", "--no-annotate", "--no-emit-index-url"),
            *("--extra", "moteus", "--extra", "mqtt", "--overrides", never, "pyproject.toml"),
            epoch_s=source.epoch_s,
            cwd=source.folder,
        )
    LOCK.write_text(HEAD + text, encoding="utf-8")
    return LOCK
