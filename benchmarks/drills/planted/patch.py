"""A planted bug: a unified diff with a heading in words, and how it goes into a tree of source.

Knows text. `git apply` finds the lines of a hunk by their words, also where the file has grown elsewhere, and takes
them out again with `-R`. Does not know what a bug does, nor what sees it.
"""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).parent
HEADING = re.compile(r"Wrong: (?P<wrong>.+?)\s+Seen by: (?P<judges>.+?)\s*\n--- ", re.DOTALL)


class Misfit(ValueError):  # noqa: N818 - it tells about a patch and a tree, each of them good in itself
    """The patch does not fit the tree. The text says where."""


@dataclass(frozen=True, slots=True)
class Bug:
    name: str
    wrong: str
    """What is wrong, in a sentence."""
    judges: tuple[str, ...]
    """The judges of the campaign that may see it, the likeliest first."""
    paths: tuple[str, ...]
    """The files that it changes."""


def bugs() -> dict[str, Bug]:
    """Every planted bug by name, in the order of their names. Raises ValueError for a text that is no such patch."""
    return {path.stem: parse(path.stem, path.read_text(encoding="utf-8")) for path in sorted(FOLDER.glob("*.patch"))}


def parse(name: str, text: str) -> Bug:
    found = HEADING.match(text)
    if found is None:
        raise ValueError(f"{name}: a patch begins with 'Wrong: ', then 'Seen by: ', then the diff")
    judges = tuple(" ".join(judge.split()) for judge in found["judges"].split(";"))
    paths = tuple(re.findall(r"^\+\+\+ b/(\S+)$", text, re.MULTILINE))
    return Bug(name, " ".join(found["wrong"].split()), judges, paths)


def plant(bug: Bug, tree: Path, *, back: bool = False) -> None:
    """Change the files of the tree, or change them back. Raises Misfit, and changes nothing then."""
    command = ["git", "apply", *(["-R"] if back else []), str(FOLDER / f"{bug.name}.patch")]
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Misfit(f"{bug.name}: {done.stderr}")
