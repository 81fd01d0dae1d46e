"""Runs tests on a changed file: in a copy of the tree, each time in a forked process that has pytest loaded already.

Knows which tests look at a file. The source of the checkout is never written. A test that starts a program of ours
starts the changed one, for the copy is where it runs.
"""

from __future__ import annotations

import compileall
import os
import py_compile
import resource
import shutil
import signal
import sys
import time
import traceback
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import hypothesis
import hypothesis.strategies
import pytest

COPIED = ("rotator", "hw", "firmware_sim", "tests", "benchmarks", "docs", "install")
QUICK = (
    "tests/control",
    "tests/hw",
    "tests/rotors",
    "tests/store",
    "tests/runtime",
    "tests/contract",
    "tests/calibrating",
)
"""Where a test that imports a file is looked for: none of these rooms waits for a foreign program."""
ROOMS = {
    "rotator/control/sky": (
        "tests/control/sky",
        "tests/control/test_controller.py",
        "tests/control/test_movements_parking.py",
    ),
    "rotator/control/axis": (
        "tests/control/axis",
        "tests/control/test_controller.py",
        "tests/control/test_controller_faults.py",
    ),
    "rotator/control": ("tests/control",),
    "rotator/store": ("tests/store",),
    "rotator/rotors": ("tests/rotors/test_counting_rotor.py", "tests/runtime"),
    "hw/drives": ("tests/hw/drives", "tests/hw/safety/test_guard.py"),
    "hw/safety": ("tests/hw/safety",),
    "hw/moteus": ("tests/hw/moteus", "tests/rotors/test_moteus_rotor.py"),
    "hw/sensors": ("tests/hw/sensors", "tests/rotors/test_counting_rotor.py"),
}
"""Further tests of the files in a room."""
SLOW = ("real_time", "proper_end_process", "test_following", "test_moving", "test_bad_luck", "test_lost_and_found")
"""Parts of the names of tests that run for longer than a minute, or in real time; a file's own tests are always run."""
LOG = "run.log"
PATIENCE = 8
LEAST_S = 30.0


class Outcome(Enum):
    SURVIVED = "survived"
    KILLED = "killed"
    TIMEOUT = "killed: it does not end"


@dataclass(frozen=True, slots=True)
class Ran:
    outcome: Outcome
    took_s: float
    cpu_s: float


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
        # Bytecode that is checked by the source's hash: a changed file is compiled anew, also with an old time stamp.
        compileall.compile_dir(folder, quiet=2, invalidation_mode=py_compile.PycInvalidationMode.CHECKED_HASH)

    def tests_of(self, file: str) -> Tests:
        path = Path(file)
        own = sorted((self._folder / "tests").glob(f"{_mirror(path)}/test_{path.stem}*.py"))
        module = ".".join(path.with_suffix("").parts)
        asked = [each for room in QUICK for each in sorted((self._folder / room).rglob("test_*.py"))]
        asking = [each for each in asked if f"from {module} import" in each.read_text(encoding="utf-8")]
        nearest = max((room for room in ROOMS if file.startswith(room + "/")), key=len, default="")
        further = [self._folder / name for name in ROOMS.get(nearest, ())]
        rooms = [
            each for place in further for each in (sorted(place.rglob("test_*.py")) if place.is_dir() else [place])
        ]
        quick = [each for each in dict.fromkeys((*asking, *rooms)) if not any(part in each.name for part in SLOW)]
        first = own or [each for each in asking if each in quick] or quick
        return Tests(self._named(first), self._named(each for each in quick if each not in first))

    def _named(self, paths: Iterable[Path]) -> tuple[str, ...]:
        return tuple(str(path.relative_to(self._folder)) for path in paths)

    def run(self, tests: Sequence[str], limit: Ran | None = None) -> Ran:
        """Run these tests until one fails. `limit`: how long they take when nothing is changed."""
        began_s = time.monotonic()
        pid = os.fork()
        if not pid:
            code = 1
            try:
                code = self._child(tests, limit)
            except BaseException:
                traceback.print_exc()
            finally:
                os._exit(code)  # nothing of the parent's may be done twice
        ends_s = began_s + (max(LEAST_S, PATIENCE * limit.took_s) if limit else 3600.0)
        while True:
            done, code, used = os.wait4(pid, os.WNOHANG)
            took_s = time.monotonic() - began_s
            if done:
                break
            if took_s > ends_s - began_s:
                with suppress(ProcessLookupError):
                    os.killpg(pid, signal.SIGKILL)
                _, code, used = os.wait4(pid, 0)
                break
            time.sleep(0.02)
        outcome = Outcome.TIMEOUT if os.WIFSIGNALED(code) else Outcome.KILLED if code else Outcome.SURVIVED
        return Ran(outcome, took_s, used.ru_utime + used.ru_stime)

    def said(self) -> str:
        """What the last run printed."""
        return (self._folder / LOG).read_text(encoding="utf-8", errors="replace")

    def with_source(self, file: str, source: str | None) -> None:
        """Put a changed file in place; None: the right one."""
        text = source if source is not None else (self._checkout / file).read_text(encoding="utf-8")
        (self._folder / file).write_text(text, encoding="utf-8")

    def _child(self, tests: Sequence[str], limit: Ran | None) -> int:
        os.setsid()
        os.chdir(self._folder)
        sys.path.insert(0, str(self._folder))
        # A program that a test starts must find the copy too.
        os.environ["PYTHONPATH"] = str(self._folder)
        os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
        sys.dont_write_bytecode = True
        if limit:
            most_s = int(PATIENCE * limit.cpu_s + LEAST_S)
            resource.setrlimit(resource.RLIMIT_CPU, (most_s, most_s))
        quiet = os.open(LOG, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        own = ("rotator", "hw", "firmware_sim", "tests", "benchmarks")
        for name in [name for name in sys.modules if name.partition(".")[0] in own]:
            del sys.modules[name]
        hypothesis.settings.register_profile("mutants", database=None, derandomize=True)
        hypothesis.settings.load_profile("mutants")
        # Hypothesis is loaded before pytest could rewrite its assertions, which no trial needs.
        loaded = ("-W", "ignore::pytest.PytestAssertRewriteWarning")
        return int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", *loaded, *tests]))


def _mirror(path: Path) -> str:
    """The folder under `tests` that mirrors a file's."""
    parts = path.parent.parts
    return "/".join(parts[1:] if parts[0] == "rotator" else parts)
