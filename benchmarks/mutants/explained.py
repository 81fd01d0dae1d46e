"""The file of survivors that are explained: changes which no test needs to see, each with its reason.

Knows the file's form. An entry names the file, the line as it stands, and the line as changed; an entry whose line no
longer stands in its file is stale; the command names it.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

from benchmarks.mutants.places import Mutant


@dataclass(frozen=True, slots=True)
class Explained:
    """`now` empty: every change of that line."""

    file: str
    was: str
    why: str
    now: str = ""

    def covers(self, file: str, mutant: Mutant) -> bool:
        return (file, mutant.was) == (self.file, self.was) and self.now in ("", mutant.now)


def read(path: Path) -> list[Explained]:
    """Raises ValueError, TypeError for a file that is damaged, OSError."""
    return [Explained(**entry) for entry in tomllib.loads(path.read_text(encoding="utf-8")).get("survivor", [])]


def stale(explained: list[Explained], checkout: Path) -> list[str]:
    """Entries whose line is no longer there."""
    found = []
    for each in explained:
        path = checkout / each.file
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        if each.was not in [line.strip() for line in lines]:
            found.append(f"{each.file}: {each.was}")
    return found
