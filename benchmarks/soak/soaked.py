"""What a soak has seen of the box, what of that is wrong, and the figures for the table.

Knows the measurements and the log. Does not know how the box was run.
"""

from __future__ import annotations

import statistics
from collections import Counter
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path

from benchmarks.soak.box import Held
from benchmarks.soak.words import WORDS

SETTLES_S = 600.0
MOST_KIB_PER_H = 1024.0


@dataclass
class Soaked:
    """What was seen."""

    held: list[Held] = field(default_factory=list)
    found: list[str] = field(default_factory=list)
    """What is wrong."""
    lasted_s: float = 0.0
    answers: int = 0
    orders: int = 0
    relay_starts: int = 0
    saved: int = 0
    """How often the state file was written."""
    late: int = 0
    """How often axes were stopped because the box got no turn on a busy machine, as they should be."""

    @property
    def settled(self) -> list[Held]:
        """After the first ten minutes, or the first third of a short soak."""
        from_s = min(SETTLES_S, self.lasted_s / 3)
        return [each for each in self.held if each.at_s >= from_s]

    def growth_per_h(self, value: str) -> float:
        """The median of the slopes between all pairs of moments: a few odd moments do not matter."""
        pairs = combinations(self.settled, 2)
        slopes = [(getattr(b, value) - getattr(a, value)) / (b.at_s - a.at_s) * 3600 for a, b in pairs]
        return statistics.median(slopes) if slopes else 0.0


def read_log(path: Path, seen: Soaked) -> None:
    lines = path.read_text(errors="replace").splitlines() if path.exists() else []
    errors = [line for line in lines if " E " in line or "Traceback" in line or "protocol failed" in line]
    late = [line for line in errors if "late:" in line or "the event loop stands still" in line]
    seen.late = len(late)
    texts = Counter(line.partition(" E ")[2] or line for line in errors if line not in late)
    seen.found += [f"log, {count} times: {text}" for text, count in texts.items()]


def judge(seen: Soaked) -> None:
    settled = seen.settled
    if not settled:
        return
    first = settled[0]
    if (growth := seen.growth_per_h("private_kib")) > MOST_KIB_PER_H:
        seen.found.append(f"memory grew by {growth:.0f} KiB an hour")
    for each in settled:
        if each.own_threads != first.own_threads:
            before, now = Counter(first.own_threads), Counter(each.own_threads)
            seen.found.append(f"threads at {each.at_s:.0f} s: lost {sorted(before - now)}, new {sorted(now - before)}")
    for name, values in (
        ("file descriptors", [each.files for each in settled]),
        ("asyncio tasks", [each.tasks for each in settled]),
    ):
        if (early := _least(values, first=True)) < (late := _least(values, first=False)):
            seen.found.append(f"{name} grew from {early} to {late}")


def _least(values: list[int], *, first: bool) -> int:
    """Of the first or of the last third: a file may just be open while it is counted."""
    third = max(1, len(values) // 3)
    return min(values[:third] if first else values[-third:])


def figures(seen: Soaked) -> dict[str, str]:
    """The table's rows: a name and its figure."""
    settled = seen.settled or seen.held
    if not settled:
        return {}
    first, last = settled[0], settled[-1]
    return {
        "time on the running box": f"{seen.lasted_s / 3600:.2f} h",
        "links": f"{len(WORDS)} protocols",
        "questions answered": f"{seen.answers}",
        "orders of passes": f"{seen.orders}",
        "motor starts": f"{seen.relay_starts}",
        "state saved": f"{seen.saved} times",
        "private memory": f"{first.private_kib / 1024:.1f} MiB after {first.at_s / 60:.0f} minutes, "
        f"{last.private_kib / 1024:.1f} MiB at the end",
        "its growth": f"{seen.growth_per_h('private_kib'):+.0f} KiB an hour",
        "blocks of Python's memory": f"{first.blocks}, then {seen.growth_per_h('blocks'):+.0f} an hour",
        "file descriptors": f"{first.files}, then {last.files}",
        "threads": f"{len(first.threads)}, then {len(last.threads)}",
        "asyncio tasks": f"{first.tasks}, then {last.tasks}",
        "stops because the machine gave no turn": f"{seen.late}",
    }
