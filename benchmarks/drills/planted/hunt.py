"""Runs the campaign on a copy of the source with one planted bug in it: what it finds, and after how many hours.

Knows folders and processes. The checkout itself is never changed. A find counts only if its script shows nothing on the
source without the planted bug: else the campaign has found a real bug, and the hunt goes on.
"""

from __future__ import annotations

import compileall
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.drills.accusations import TABLE
from benchmarks.drills.planted.patch import FOLDER, Bug, plant
from benchmarks.drills.script import Drill

ROOT = Path(__file__).parents[3]
PACKAGES = ("rotator", "hw", "firmware_sim", "benchmarks")
NOTHING, FOUND = 0, 1
"""The campaign's exit codes."""


@dataclass(frozen=True, slots=True)
class Find:
    kind: str
    after_h: float
    """Simulated hours played until then."""


@dataclass(frozen=True, slots=True)
class Hunt:
    bug: Bug
    hours: float
    """Simulated hours played in all."""
    find: Find | None
    also_without: tuple[str, ...]
    """The drills of finds that show on the source without the bug too, and so do not count."""


class CampaignError(Exception):
    """The campaign itself has failed. The text is its output."""


@contextmanager
def copied(root: Path = ROOT) -> Iterator[Path]:
    """A copy of the source in a temporary folder, with its bytecode: a bug costs only its own file anew."""
    with tempfile.TemporaryDirectory(prefix="planted-") as folder:
        for package in PACKAGES:
            shutil.copytree(root / package, Path(folder) / package)
            compileall.compile_dir(Path(folder) / package, quiet=2)
        yield Path(folder)


def hunt(bug: Bug, sound: Path, *, hours: float, seed: int, kind: str = "") -> Hunt:
    """`sound`: a tree without the bug. `kind`: of the rotor; empty: the one of the bug's own script.

    Raises CampaignError, Misfit.
    """
    played_h = 0.0
    also_without: list[str] = []
    kind = kind or Drill.from_json(_script(bug)).kind
    with copied(sound) as tree:
        plant(bug, tree)
        while played_h < hours:
            result = _campaign(tree, ["--seed", str(seed), "--hours", f"{hours - played_h:g}", "--first"], kind)
            played_h += sum(float(tally["hours"]) for tally in result["kinds"].values())
            for found in result["found"]:
                drawn_from = str(found["drawn_from"])
                # An exception is no find: a planted bug moves a motor, it does not end the program.
                if found["judge"] in TABLE and not _replay(sound, found["script"]):
                    find = Find(drawn_from.partition("/")[2], played_h)
                    return Hunt(bug, played_h, find, tuple(also_without))
                also_without.append(drawn_from)
            seed += 1
    return Hunt(bug, played_h, None, tuple(also_without))


def seen(chosen: Sequence[Bug]) -> Iterator[tuple[Bug, str]]:
    """Each bug with the judge that sees it in its own script; empty: none of its judges does. Raises CampaignError."""
    # Threads: each waits for processes of its own, of which there are as many at once as there are cores.
    with copied() as sound, ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for bug, judge in zip(chosen, pool.map(partial(scripted, sound=sound), chosen), strict=True):
            yield bug, judge if judge in bug.judges else ""


def scripted(bug: Bug, sound: Path) -> str:
    """What the bug's own script shows with it, and does not show without it; empty: nothing. Raises CampaignError."""
    script = _script(bug)
    with copied(sound) as tree:
        plant(bug, tree)
        shown = _replay(tree, script)
        return shown if shown and not _replay(sound, script, folder=tree) else ""


def _script(bug: Bug) -> str:
    return (FOLDER / f"{bug.name}.json").read_text(encoding="utf-8")


def _campaign(tree: Path, arguments: list[str], kind: str) -> dict[str, Any]:
    result = _run(tree, [*arguments, "--kind", kind, "--json"])
    try:
        content: dict[str, Any] = json.loads(result.stdout)
    except ValueError as fault:
        raise CampaignError(result.stdout + result.stderr) from fault
    return content


def _replay(tree: Path, script: str, folder: Path | None = None) -> str:
    """The judge that this script calls on that source; empty: none. `folder`: where the script is put; None: there."""
    path = (folder or tree) / "script.json"
    path.write_text(script, encoding="utf-8")
    result = _run(tree, ["--replay", str(path)])
    if result.returncode not in (NOTHING, FOUND):
        raise CampaignError(result.stdout + result.stderr)
    if result.returncode == NOTHING:
        return ""
    lines = result.stdout.splitlines()
    return next((judge for line in reversed(lines) for judge in TABLE if line.startswith(judge)), lines[-1])


def _run(tree: Path, arguments: list[str]) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "benchmarks.drills", *arguments]
    # The tree comes before the installed program, which is the checkout.
    environment = os.environ | {"PYTHONPATH": str(tree), "PYTHONHASHSEED": "0"}
    return subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, check=False)
