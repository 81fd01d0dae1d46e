"""A planted bug: a unified diff with a heading in words, and how it goes into a tree of source and out again.

Knows text and files. A hunk is found by its lines, not by its line numbers, so that a patch still fits when the file
has grown elsewhere; its lines must occur exactly once. Does not know what a bug does, nor what sees it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).parent
WRONG, JUDGES = "Wrong: ", "Seen by: "


class Misfit(ValueError):  # noqa: N818 - it tells about a patch and a tree, each of them good in itself
    """The patch does not fit the tree. The text says where."""


@dataclass(frozen=True, slots=True)
class Hunk:
    """So many lines of one file, before and after."""

    path: str
    before: tuple[str, ...]
    after: tuple[str, ...]

    @property
    def back(self) -> Hunk:
        return Hunk(self.path, self.after, self.before)


@dataclass(frozen=True, slots=True)
class Bug:
    name: str
    wrong: str
    """What is wrong, in a sentence."""
    judges: tuple[str, ...]
    """The judges of the campaign that may see it, the likeliest first."""
    hunks: tuple[Hunk, ...]

    @property
    def paths(self) -> tuple[str, ...]:
        """The files that it changes, each once."""
        return tuple(dict.fromkeys(hunk.path for hunk in self.hunks))


def bugs() -> dict[str, Bug]:
    """Every planted bug by name, in the order of their names."""
    return {path.stem: parse(path.stem, path.read_text(encoding="utf-8")) for path in sorted(FOLDER.glob("*.patch"))}


def parse(name: str, text: str) -> Bug:
    """Raises ValueError for a text that is no such patch."""
    heading, _, diff = text.partition("\n--- ")
    said = " ".join(line.strip() for line in heading.splitlines())
    if not said.startswith(WRONG) or JUDGES not in said or not diff:
        raise ValueError(f"{name}: a patch begins with {WRONG!r}, then {JUDGES!r}, then the diff")
    wrong, _, judges = said.removeprefix(WRONG).partition(JUDGES)
    named = tuple(judge.strip() for judge in judges.split(";"))
    return Bug(name, wrong.strip(), named, tuple(_hunks(name, ("--- " + diff).splitlines())))


def plant(bug: Bug, tree: Path) -> None:
    """Change the files of the tree. Raises Misfit, and changes nothing then."""
    _change(bug, tree, bug.hunks)


def take_back(bug: Bug, tree: Path) -> None:
    """Undo `plant`. Raises Misfit, and changes nothing then."""
    _change(bug, tree, tuple(hunk.back for hunk in reversed(bug.hunks)))


def _hunks(name: str, lines: list[str]) -> Iterator[Hunk]:
    path = ""
    before: list[str] = []
    after: list[str] = []
    for line in [*lines, "@@"]:
        if line.startswith(("--- ", "+++ ", "@@")):
            if before or after:
                yield Hunk(path, tuple(before), tuple(after))
                before, after = [], []
            if line.startswith("+++ "):
                path = line.removeprefix("+++ ").removeprefix("b/")
            continue
        kind, rest = line[:1], line[1:]
        if kind not in (" ", "+", "-", ""):
            raise ValueError(f"{name}: no line of a diff: {line!r}")
        if kind != "+":
            before.append(rest)
        if kind != "-":
            after.append(rest)


def _change(bug: Bug, tree: Path, hunks: tuple[Hunk, ...]) -> None:
    files = {path: (tree / path).read_text(encoding="utf-8").splitlines() for path in bug.paths}
    for hunk in hunks:
        lines, count = files[hunk.path], len(hunk.before)
        places = [at for at in range(len(lines) - count + 1) if tuple(lines[at : at + count]) == hunk.before]
        if len(places) != 1:
            found = f"{len(places)} times" if places else "nowhere"
            raise Misfit("\n".join([f"{bug.name}: {hunk.path} has these lines {found}:", *hunk.before]))
        lines[places[0] : places[0] + count] = hunk.after
    for path, lines in files.items():
        (tree / path).write_text("\n".join(lines) + "\n", encoding="utf-8")
