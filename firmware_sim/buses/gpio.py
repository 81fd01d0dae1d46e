"""Simulated GPIO chips in the shape of the `gpiod` module (libgpiod 2.x).

Knows which chips there are, and the user of each line. For simulated hardware and tests it offers a bench on the chip
with the pin header: put a level on a pin, read a pin, see the last 10,000 changes. Does not know what is wired to the
pins. Not simulated: `watch_line_info`, and requests made through a `Chip`.
"""

from __future__ import annotations

import errno
import os
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Self

from firmware_sim.buses.gpio_lines import LINE_COUNT, Bank
from firmware_sim.buses.gpio_request import (
    Config,
    RequestReleasedError,
    SimLineRequest,
    by_offset,
    check_offset,
    is_active,
)

__all__ = ["ChipInfo", "Edge", "LineInfo", "RequestReleasedError", "SimChip", "SimGpio", "SimLineRequest"]

EDGES_KEPT = 2_000
"""How many changes of the header's pins `edges` holds; older ones are dropped."""
DEFAULT_CHIPS = {"/dev/gpiochip0": "pinctrl-bcm2711"}

Listener = Callable[[float, Mapping[int, bool]], None]


@dataclass(frozen=True, slots=True)
class Edge:
    """A change of a pin: the moment, and the physical level from then on."""

    at_s: float
    offset: int
    level: bool


@dataclass(frozen=True, slots=True)
class ChipInfo:
    """In the shape of `gpiod.ChipInfo`."""

    name: str
    label: str
    num_lines: int


@dataclass(frozen=True, slots=True)
class LineInfo:
    """In the shape of `gpiod.LineInfo`."""

    offset: int
    name: str
    used: bool
    consumer: str


class SimGpio:
    """Takes the place of the module `gpiod`: `request_lines`, `Chip`, `is_gpiochip_device`.

    `level`, `edges`, `on_edges`, `on_look` and `drive_input` are for the chip with the pin header: the first one whose
    label begins with pinctrl-. `strict=True`: a released line becomes an input again, as in the mainline kernel. False:
    a released output stays driven, as in Raspberry Pi kernels without `dtparam=strict_gpiod`.
    """

    def __init__(
        self, clock: Callable[[], float], chips: Mapping[str, str] | None = None, *, strict: bool = False
    ) -> None:
        self.strict = strict
        self.edges: deque[Edge] = deque(maxlen=EDGES_KEPT)
        self.on_edges: list[Listener] = []
        """Called at each change with the moment and the new physical levels. The lines are locked during the call."""
        labels = DEFAULT_CHIPS if chips is None else chips
        self._banks = {path: Bank(path, label, clock) for path, label in labels.items()}
        banks = list(self._banks.values()) or [Bank("", "", clock)]
        self._header = next((bank for bank in banks if bank.label.startswith("pinctrl-")), banks[0])
        self._header.changed = self._record
        self.on_look = self._header.on_look
        """Called with the present moment before an input is read. Simulated hardware that moves without an order then
        calls `drive_input` for each change of its pins since the last call, oldest first. The lines are locked."""

    # --- gpiod

    def paths(self) -> list[str]:
        """The paths of the chips, as a search for /dev/gpiochip* finds them."""
        return list(self._banks)

    def is_gpiochip_device(self, path: str) -> bool:
        return path in self._banks

    def Chip(self, path: str) -> SimChip:  # noqa: N802 - gpiod's own name
        return SimChip(self._bank(path))

    def request_lines(
        self,
        path: str,
        config: Config,
        consumer: str | None = None,
        event_buffer_size: int | None = None,
        output_values: Mapping[int, Enum] | None = None,
    ) -> SimLineRequest:
        settings = by_offset(config)
        if output_values:  # libgpiod: these then hold for every line, and a line left out is INACTIVE
            outputs = {offset: is_active(output_values.get(offset)) for offset in settings}
        else:
            outputs = {offset: is_active(wanted.output_value) for offset, wanted in settings.items()}
        return SimLineRequest(
            self._bank(path),
            settings,
            outputs,
            consumer=consumer or "?",
            strict=self.strict,
            event_buffer_size=event_buffer_size,
        )

    def _bank(self, path: str) -> Bank:
        if path not in self._banks:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
        return self._banks[path]

    # --- the bench

    def level(self, offset: int) -> bool:
        """The physical level of a pin of the header."""
        if self._header.lines[offset].driven is None:
            self._header.look()
        return self._header.lines[offset].level

    def drive_input(self, offset: int, level: bool | None, at_s: float | None = None) -> None:
        """Put a level on a pin of the header from outside, now or from the earlier moment `at_s`; None: open."""
        line = self._header.lines[offset]
        if line.outside is level:  # most looks at a switch find it as it was
            return
        with self._header.instant([offset], at_s):
            line.outside = level

    def bury_process(self) -> None:
        """The process that held the header's lines has died: the kernel gives them back, and watches no edge for it."""
        lines = self._header.lines
        with self._header.instant([offset for offset, line in enumerate(lines) if line.consumer is not None]):
            for line in lines:
                if line.consumer is not None and self.strict:
                    line.driven = None
                line.consumer = None
            self._header.detectors.clear()

    def _record(self, at_s: float, changes: Mapping[int, bool]) -> None:
        self.edges.extend(Edge(at_s, offset, level) for offset, level in changes.items())
        for listener in self.on_edges:
            listener(at_s, changes)


class SimChip:
    """An open chip in the shape of `gpiod.Chip`: its name, its label and its lines' users."""

    def __init__(self, bank: Bank) -> None:
        self._bank = bank

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Does nothing: a simulated chip holds no file."""

    def get_info(self) -> ChipInfo:
        return ChipInfo(os.path.basename(self._bank.path), self._bank.label, LINE_COUNT)

    def get_line_info(self, offset: int) -> LineInfo:
        check_offset(offset)
        consumer = self._bank.lines[offset].consumer
        return LineInfo(offset, f"GPIO{offset}", consumer is not None, consumer or "")
