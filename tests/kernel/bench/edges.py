"""Every level that anybody sets on a GPIO line, with its moment, from the kernel's own tracing.

Knows the trace events gpio_value and gpio_direction. Nothing is missed however short, which no amount of looking at
pins can say. What a line falls back to when it is let go of is not traced: look at its level.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from tests.kernel.bench.gpio import GpioChip

TRACING = Path("/sys/kernel/tracing")
EVENT = re.compile(r" (?P<at>\d+\.\d+): gpio_value: (?P<number>\d+) set (?P<level>[01])")


@dataclass(frozen=True, slots=True)
class Edge:
    at_s: float
    """On the clock of time.monotonic()."""
    offset: int
    level: bool


class EdgeRecorder:
    """Records from its making on. One at a time: the trace is the machine's."""

    def __init__(self, chip: GpioChip) -> None:
        self._first = chip.first_number()
        self._levels: dict[int, bool] = {}
        self._chip = chip
        self._rest = ""
        (TRACING / "trace_clock").write_text("mono")
        (TRACING / "trace").write_text("")
        (TRACING / "events/gpio/gpio_value/enable").write_text("1")
        self._pipe = os.open(TRACING / "trace_pipe", os.O_RDONLY | os.O_NONBLOCK)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def know(self, *offsets: int) -> None:
        """Take the present levels for known: setting a line to what it is already will then be no edge."""
        self._levels |= {offset: self._chip.level(offset) for offset in offsets}

    def edges(self) -> Iterator[Edge]:
        """What has changed since anybody asked, in order. A line's first setting counts as an edge, unless known."""
        while data := self._read():
            *lines, self._rest = (self._rest + data).split("\n")
            for line in lines:
                if found := EVENT.search(line):
                    offset, level = int(found["number"]) - self._first, found["level"] == "1"
                    if self._levels.get(offset) is not level:
                        self._levels[offset] = level
                        yield Edge(float(found["at"]), offset, level)

    def close(self) -> None:
        (TRACING / "events/gpio/gpio_value/enable").write_text("0")
        os.close(self._pipe)

    def _read(self) -> str:
        try:
            return os.read(self._pipe, 65536).decode()
        except BlockingIOError:
            return ""
