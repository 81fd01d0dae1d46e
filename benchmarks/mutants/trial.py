"""Runs tests on a changed file, in a copy of the tree: the source of the checkout is never written.

Knows which tests look at a file. A test that starts a program of ours starts the changed one, for the copy is where it
runs.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

COPIED = ("rotator", "hw", "firmware_sim", "tests", "benchmarks", "docs", "install")
ROOMS = ("control", "hw", "rotors", "store", "runtime", "contract", "calibrating")
"""Rooms of the tests where one that imports a file is looked for: none of these waits for a foreign program."""
SLOW = ("real_time", "proper_end_process", "test_following", "test_moving", "test_bad_luck", "test_lost_and_found")
"""Parts of the names of tests that run for longer than a minute, or in real time; a file's own tests are always run."""
LOG = "run.log"
PATIENCE, LEAST_S = 8, 30.0
WITHOUT_LIMIT_S = 3600.0


class Outcome(Enum):
    SURVIVED = "survived"
    KILLED = "killed"
    TIMEOUT = "killed: it does not end"


@dataclass(frozen=True, slots=True)
class Ran:
    outcome: Outcome
    took_s: float


@dataclass(frozen=True, slots=True)
class Tests:
    """The test files that look at one file: those that mirror it, then others, which only a survivor of these meets."""

    own: tuple[str, ...]
    others: tuple[str, ...]


class Copy:
    """A copy of the tree in `folder`."""

    def __init__(self, checkout: Path, folder: Path) -> None:
        self._checkout, self._folder = checkout, folder
        unwanted = shutil.ignore_patterns("__pycache__", ".hypothesis")
        for name in COPIED:
            shutil.copytree(checkout / name, folder / name, ignore=unwanted)
        shutil.copy(checkout / "pyproject.toml", folder)

    def tests_of(self, file: str) -> Tests:
        path, tests = Path(file), self._folder / "tests"
        mirror = Path(*path.parent.parts[1:]) if path.parts[0] == "rotator" else path.parent
        own = sorted((tests / mirror).glob(f"test_{path.stem}*.py"))
        module = ".".join(path.with_suffix("").parts)
        asked = [each for room in ROOMS for each in sorted((tests / room).rglob("test_*.py"))]
        quick = [each for each in asked if not any(part in each.name for part in SLOW)]
        asking = [each for each in quick if f"from {module} import" in each.read_text(encoding="utf-8")]
        room = [each for each in quick if each.is_relative_to(tests / mirror)]
        first = own or asking or room
        others = [each for each in dict.fromkeys((*asking, *room)) if each not in first]
        named = [[str(each.relative_to(self._folder)) for each in some] for some in (first, others)]
        return Tests(tuple(named[0]), tuple(named[1]))

    def run(self, tests: Sequence[str], limit: Ran | None = None) -> Ran:
        """Run these tests until one fails. `limit`: how long they take when nothing is changed."""
        most_s = max(LEAST_S, PATIENCE * limit.took_s) if limit else WITHOUT_LIMIT_S
        # A changed file is compiled anew, also with an old time stamp; a program that a test starts finds the copy too.
        environment = os.environ | {"PYTHONPATH": str(self._folder), "PYTHONDONTWRITEBYTECODE": "1"}
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", *tests]
        began_s = time.monotonic()
        with (self._folder / LOG).open("w") as log:
            try:
                done = subprocess.run(
                    command, cwd=self._folder, env=environment, stdout=log, stderr=log, timeout=most_s, check=False
                )
                outcome = Outcome.KILLED if done.returncode else Outcome.SURVIVED
            except subprocess.TimeoutExpired:
                outcome = Outcome.TIMEOUT
        return Ran(outcome, time.monotonic() - began_s)

    def said(self) -> str:
        """What the last run printed."""
        return (self._folder / LOG).read_text(encoding="utf-8", errors="replace")

    def with_source(self, file: str, source: str | None) -> None:
        """Put a changed file in place; None: the right one."""
        text = source if source is not None else (self._checkout / file).read_text(encoding="utf-8")
        (self._folder / file).write_text(text, encoding="utf-8")
