"""Fifty browsers at once: `python -m benchmarks.page`, with `--seconds`, `--browsers`, `--stops`, `--crowds`.

Measures the box for a minute beside a pass: alone, with the browsers, alone again; after each minute some stops, by `S`
on a program's link and by STOP on the page; then crowds that come and go. Prints the table of docs/page.md, with the
promised limit beside each figure. The exit code is 1 where one is missed.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import statistics
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from benchmarks.page.box import Figures, MeasuredBox, measured_box, memory_mib
from benchmarks.page.chromium import CHROMIUM, in_chromium
from rotator.web import assets

LATE_MS, CORE_PERCENT, PAINT_MS, PACKED_KIB = 10.0, 15.0, 500.0, 100.0
MORE_MS, WORST_MORE_MS = 1.0, LATE_MS
"""So much later a stop may come with the browsers: the median, and the worst."""
STAY_S = 5.0
"""For so long each of the crowds stays that come and go for the sake of memory."""
MORE_MIB = 1.0
"""So much more memory the box may hold after as many crowds again: the first ones fill what is kept of the past."""
LEAST_HZ = 9.5
"""Fewer pictures than these are not ten a second."""


@dataclass(frozen=True, slots=True)
class Row:
    name: str
    limit: str
    told: tuple[str, ...]
    """Before, with the browsers, after."""
    kept: bool

    def __str__(self) -> str:
        return " | ".join((self.name, self.limit, *self.told)).rstrip("| ")


def rows_of(phases: Sequence[Figures]) -> list[Row]:
    before, during, _ = phases

    def each(show: Callable[[Figures], str]) -> tuple[str, ...]:
        return tuple(show(phase) for phase in phases)

    late = max(phase.late_p99_ms for phase in phases)
    return [
        Row("loop late, p99, ms", f"{LATE_MS:g}", each(lambda its: f"{its.late_p99_ms:.1f}"), late <= LATE_MS),
        Row(
            "of a core, %",
            f"{CORE_PERCENT:g}",
            each(lambda its: f"{its.core_percent:.0f}"),
            during.core_percent <= CORE_PERCENT,
        ),
        stops_row("`S`", each(lambda its: told(its.link_ms)), before.link_ms, during.link_ms),
        stops_row("STOP", each(lambda its: told(its.page_ms)), before.page_ms, during.page_ms),
        Row("memory, MiB", "", each(lambda its: f"{its.memory_mib:.1f}"), kept=True),
    ]


def stops_row(name: str, shown: tuple[str, ...], before_ms: list[float], during_ms: list[float]) -> Row:
    soon = statistics.median(during_ms) <= statistics.median(before_ms) + MORE_MS
    kept = soon and max(during_ms) <= max(before_ms) + WORST_MORE_MS
    return Row(f"{name} to relay, ms", f"+{MORE_MS:g} (+{WORST_MORE_MS:g})", shown, kept)


def told(values_ms: list[float]) -> str:
    return f"{statistics.median(values_ms):.1f} ({max(values_ms):.1f})"


async def begin(url: str, browsers: int) -> asyncio.subprocess.Process:
    """Returns when all of them look on."""
    pipe = asyncio.subprocess.PIPE
    command = (sys.executable, "-m", "benchmarks.page.browsers", url, str(browsers))
    crowd = await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe)
    assert crowd.stdout is not None
    assert await crowd.stdout.readline() == b"all are here\n"
    return crowd


async def end(crowd: asyncio.subprocess.Process) -> dict[str, Any]:
    """They leave, and tell what they have got."""
    # Some bytes, even none: without them Python 3.11 leaves the pipe open, and the crowd stays.
    out, _ = await crowd.communicate(b"")
    found: dict[str, Any] = json.loads(out)
    return found


async def memory_row(box: MeasuredBox, browsers: int, crowds: int) -> Row:
    """Of so many crowds that come and go, and of as many again."""
    held_mib = []
    for _ in range(2):
        for _ in range(crowds):
            crowd = await begin(box.url, browsers)
            await asyncio.sleep(STAY_S)
            await end(crowd)
        held_mib.append(memory_mib())
    told_mib = "", "", f"{held_mib[0]:.1f}, {held_mib[1]:.1f}"
    kept = held_mib[1] <= held_mib[0] + MORE_MIB
    return Row(f"memory after {crowds}, {2 * crowds} more such crowds, MiB", f"+{MORE_MIB:g}", told_mib, kept)


async def main(browsers: int, lasts_s: float, stops: int, crowds: int) -> int:
    with tempfile.TemporaryDirectory() as folder:
        async with measured_box(folder, 3.0 * (lasts_s + 4.0 * stops) + 60.0) as box:
            before = await box.figures(lasts_s, stops)
            crowd = await begin(box.url, browsers)
            during = await box.figures(lasts_s, stops)
            heard = await end(crowd)
            after = await box.figures(lasts_s, stops)
            rows = [*rows_of((before, during, after)), await memory_row(box, browsers, crowds)]
            if CHROMIUM.exists():
                paints_ms, touches_ms = await in_chromium(box)
                paint = Row("first paint, ms", f"{PAINT_MS:g}", (told(paints_ms),), max(paints_ms) <= PAINT_MS)
                rows += [paint, Row("finger to relay, ms", "", (told(touches_ms),), kept=True)]
    packed_kib = sum(len(asset.packed) for path, asset in assets.load().items() if path != "/") / 1024
    rows.append(Row("page packed, KiB", f"{PACKED_KIB:g}", (f"{packed_kib:.0f}",), packed_kib <= PACKED_KIB))
    print(f"median (worst) | limit | alone | {browsers} browsers | after\n--|--|--|--|--", *rows, sep="\n")
    print(f"each browser got {heard['rate_hz']:.2f} pictures a second or more; all got {heard['answers']} answers")
    missed = [row.name for row in rows if not row.kept]
    missed += [f"a browser: {fault}" for fault in heard["failed"]]
    missed += ["ten pictures a second"] if heard["rate_hz"] < LEAST_HZ else []
    print(*(f"missed: {name}" for name in missed), sep="\n")
    return 1 if missed else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--browsers", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--stops", type=int, default=20)
    parser.add_argument("--crowds", type=int, default=10)
    given = parser.parse_args()
    sys.exit(asyncio.run(main(given.browsers, given.seconds, given.stops, given.crowds)))
