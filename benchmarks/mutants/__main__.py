"""Run `python -m benchmarks.mutants [--sample N] [--seed S] [FILES]`: do the tests see a change of the source?

Each place of a file is changed once, in a way that the seed chooses, and the tests that look at the file must fail.
Prints the share that was killed of each file and every survivor that tests/mutants/survivors.toml does not explain.
Exit code 1 when fewer than 85 of 100 are killed, an entry of that file is stale, or tests fail without a change.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from benchmarks.mutants.places import Mutant, mutants
from benchmarks.mutants.trial import Copy, Outcome, Ran

CHECKOUT = Path(__file__).parents[2]
SURVIVORS = CHECKOUT / "tests" / "mutants" / "survivors.toml"
FILES = (
    *("hw/drives/*.py", "hw/safety/*.py", "hw/buses/gpio.py", "hw/moteus/*.py", "hw/sensors/*.py"),
    *("rotator/control/**/*.py", "rotator/rotors/*.py", "rotator/store/*.py"),
)
LEAST_KILLED = 0.85


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


class TestsFail(Exception):  # noqa: N818 - a sentence about the tests
    """The tests of a file fail although nothing is changed."""


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sample", type=int, help="places a file; left out, all")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    parser.add_argument("--near", action="store_true", help="only the tests that mirror or import a file: much quicker")
    parser.add_argument("files", nargs="*", default=FILES, help="files or patterns; left out, the rooms that matter")
    given = parser.parse_args()
    files = sorted(
        {
            str(path.relative_to(CHECKOUT))
            for each in given.files
            for path in CHECKOUT.glob(each)
            if path.stem != "__init__"
        }
    )
    explained = read(SURVIVORS)
    print(f"seed {given.seed}", flush=True)
    killed = tried = 0
    failed: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Copy(CHECKOUT, Path(folder))
        for file in files:
            tests = copy.tests_of(file)
            chance = random.Random(f"{given.seed} {file}")
            rounds = (tests.own,) if given.near else (tests.own, tests.others)
            try:
                counts = _try(copy, file, rounds, mutants(_text(file), given.sample, chance), explained)
            except TestsFail as reason:
                print(reason, flush=True)
                failed.append(file)
                continue
            killed += counts[Outcome.KILLED] + counts[Outcome.TIMEOUT]
            tried += counts.total()
    old = stale(explained, CHECKOUT)
    print("".join(f"explained, but no longer there: {each}\n" for each in old), end="")
    share = killed / tried if tried else 1.0
    print(f"{killed} of {tried} killed: {share:.1%}")
    sys.exit(share < LEAST_KILLED or bool(old or failed))


def _text(file: str) -> str:
    return (CHECKOUT / file).read_text(encoding="utf-8")


def _try(
    copy: Copy, file: str, rounds: tuple[tuple[str, ...], ...], chosen: list[Mutant], explained: list[Explained]
) -> Counter[Outcome]:
    """All chosen mutants of one file, each in rounds of tests until one fails. An explained survivor is not counted."""
    counts: Counter[Outcome] = Counter()
    limits: dict[tuple[str, ...], Ran] = {}
    for mutant in chosen:
        outcome = Outcome.SURVIVED
        for each in rounds:
            if each and outcome is Outcome.SURVIVED:
                copy.with_source(file, None)
                limits[each] = limits.get(each) or _right(copy, file, each)
                copy.with_source(file, mutant.source)
                outcome = copy.run(each, limits[each]).outcome
        if outcome is Outcome.SURVIVED and any(each.covers(file, mutant) for each in explained):
            continue
        counts[outcome] += 1
        if outcome is Outcome.SURVIVED:
            print(f"    {mutant.line}: {mutant.was}\n      -> {mutant.now}  ({mutant.operator})", flush=True)
    copy.with_source(file, None)
    dead = counts.total() - counts[Outcome.SURVIVED]
    print(f"{file}: {dead} of {counts.total()} killed, {sum(map(len, rounds))} test files", flush=True)
    return counts


def _right(copy: Copy, file: str, tests: tuple[str, ...]) -> Ran:
    """How these tests run on the right file. Raises TestsFail when they do so twice: one may be bad luck."""
    for _ in range(2):
        right = copy.run(tests)
        if right.outcome is Outcome.SURVIVED:
            return right
    raise TestsFail(f"{file}: its tests fail without a change:\n{copy.said()}")


if __name__ == "__main__":
    main()
