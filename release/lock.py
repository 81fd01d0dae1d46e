"""Writes install/lock: one version of each package, with the hashes of its files, for every Python we support.

Knows uv's command line, and what moteus declares without needing it. A file for the program itself, one for each set
that only some configurations need, and one for what builds the program from its sources.
"""

from __future__ import annotations

import re
import sys
import tempfile
import tomllib
from pathlib import Path

from release.environment import LOCK
from release.source import Source, run

NOT_NEEDED = ("scipy", "pyelftools", "pywin32")
"""moteus declares them for tools of its own, and for Windows."""
SETS = {"moteus": "moteus", "paho": "mqtt", "spidev": "spi"}
"""The name of a set in install.sh, and of the extra in pyproject.toml."""
HEAD = "# Which packages go in, in which versions: `make lock` writes this file anew.\n"
_BLOCK = re.compile(r"^([\w.-]+)==.*(?:\n    .*)*\n", re.MULTILINE)


def write(source: Source) -> Path:
    with tempfile.TemporaryDirectory() as scratch:
        asked, never, whole = (Path(scratch, name) for name in ("build.in", "never.txt", "whole.txt"))
        never.write_text("".join(f'{name}; python_version < "3"\n' for name in NOT_NEEDED))
        project = tomllib.loads((source.folder / "pyproject.toml").read_text("utf-8"))
        asked.write_text("\n".join(project["build-system"]["requires"]))

        def solved(extras: list[str], *more: str | Path) -> dict[str, str]:
            """Name → its lines, of what the program needs with these extras."""
            named = [word for extra in extras for word in ("--extra", extra)]
            return _solved(source, *named, "--overrides", never, "pyproject.toml", *more)

        # One solution for all, so that any of the sets go together.
        found = solved(list(SETS.values()), "--upgrade")
        whole.write_text("".join(re.sub(r" \\\n.*", "", lines, flags=re.DOTALL) + "\n" for lines in found.values()))
        base = solved([], "--constraints", whole)
        parts = {"base": base, "build": _solved(source, "--upgrade", asked)}
        for name, extra in SETS.items():
            with_it = solved([extra], "--constraints", whole)
            parts[name] = {package: lines for package, lines in with_it.items() if package not in base}
    for name, packages in parts.items():
        (LOCK / f"{name}.txt").write_text(HEAD + "".join(packages.values()), encoding="utf-8")
    return LOCK


def _solved(source: Source, *what: str | Path) -> dict[str, str]:
    text = run(
        *(sys.executable, "-m", "uv", "pip", "compile", "--quiet", "--universal", "--python-version", "3.11"),
        *("--generate-hashes", "--no-header", "--no-annotate", "--no-emit-index-url", *what),
        epoch_s=source.epoch_s,
        cwd=source.folder,
    )
    return {block[1]: block[0] for block in _BLOCK.finditer(text)}
