"""Simulated GPIO chips in the shape of the `gpiod` module (libgpiod 2.x).

Knows which line belongs to whom, what level each pin is at and when it changed, where the pulls are at boot and what is
left when a program lets go of a line. Knows nothing of what hangs on the pins. Edge detection and open-drain outputs
are not built: asking for them raises NotImplementedError, because silence would pass for a contact that never closes.
"""

from __future__ import annotations

import errno
import os
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from typing import Any, Self

LINES = 58
PULLED_UP_AT_BOOT = range(9)  # BCM2835 ARM Peripherals, table 6-31: GPIO 0-8 up, 9-27 down
EDGES_KEPT = 10_000
DEFAULT_CHIPS = {"/dev/gpiochip0": "pinctrl-bcm2711"}

Settings = Any
"""A `gpiod.LineSettings`, told by its attributes; its enum members are told apart by name."""
Config = Mapping[Any, Settings]
"""An offset or a tuple of offsets -> what they shall be."""
Listener = Callable[[float, Mapping[int, bool]], None]


class RequestReleasedError(Exception):
    """A request was used after its release."""

    def __init__(self) -> None:
        super().__init__("GPIO lines have been released")


@dataclass(frozen=True, slots=True)
class Edge:
    """A physical level that changed."""

    at_s: float
    offset: int
    level: bool


@dataclass(frozen=True, slots=True)
class ChipInfo:
    name: str
    label: str
    num_lines: int


@dataclass(frozen=True, slots=True)
class LineInfo:
    offset: int
    name: str
    used: bool
    consumer: str


@dataclass(slots=True)
class _Line:
    pull: bool
    driven: bool | None = None
    """The level of an output; None: the line is an input."""
    outside: bool | None = None
    """The level somebody else puts on the pin; None: nobody does. A driven output wins."""
    consumer: str | None = None

    @property
    def level(self) -> bool:
        if self.driven is not None:
            return self.driven
        return self.pull if self.outside is None else self.outside


class _Bank:
    """The lines of one chip."""

    def __init__(self, path: str, label: str) -> None:
        self.path = path
        self.label = label
        self.changed: Callable[[Mapping[int, bool]], None] = lambda changes: None
        self.lines = [_Line(pull=offset in PULLED_UP_AT_BOOT) for offset in range(LINES)]
        self.lock = threading.RLock()

    @contextmanager
    def instant(self, offsets: Iterable[int]) -> Iterator[None]:
        """Whatever the body does to these lines happens to all of them at once."""
        with self.lock:
            before = {offset: self.lines[offset].level for offset in offsets}
            yield
            after = {offset: self.lines[offset].level for offset in before}
            if changes := {offset: level for offset, level in after.items() if level != before[offset]}:
                self.changed(changes)


class SimGpio:
    """Stands where the module `gpiod` stands: `request_lines`, `Chip`, `is_gpiochip_device`.

    `level`, `edges`, `on_edges` and `drive_input` are about the chip on the pin header: the first one whose label says
    pinctrl. `strict` is mainline's way with released lines: back to inputs. Raspberry Pi kernels leave them driven
    unless `dtparam=strict_gpiod` is set.
    """

    def __init__(
        self, clock: Callable[[], float], chips: Mapping[str, str] | None = None, *, strict: bool = False
    ) -> None:
        self.strict = strict
        self.edges: deque[Edge] = deque(maxlen=EDGES_KEPT)
        self.on_edges: list[Listener] = []
        """Called once an instant, in order, with every physical level that changed. The lines are locked meanwhile."""
        self._clock = clock
        labels = DEFAULT_CHIPS if chips is None else chips
        self._banks = {path: _Bank(path, label) for path, label in labels.items()}
        banks = list(self._banks.values()) or [_Bank("", "")]
        self._header = next((bank for bank in banks if bank.label.startswith("pinctrl-")), banks[0])
        self._header.changed = self._record

    # --- gpiod

    def paths(self) -> list[str]:
        """What a look for /dev/gpiochip* would find."""
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
        settings = _by_offset(config)
        if output_values:  # libgpiod: then it speaks for every line, and a line it leaves out is INACTIVE
            outputs = {offset: _active(output_values.get(offset)) for offset in settings}
        else:
            outputs = {offset: _active(wanted.output_value) for offset, wanted in settings.items()}
        return SimLineRequest(self._bank(path), settings, outputs, consumer or "?", self.strict)

    def _bank(self, path: str) -> _Bank:
        if path not in self._banks:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
        return self._banks[path]

    # --- the bench

    def level(self, offset: int) -> bool:
        """The physical level of a pin of the header."""
        return self._header.lines[offset].level

    def drive_input(self, offset: int, level: bool | None) -> None:
        """Put a level on a pin of the header from outside; None lets go of it."""
        with self._header.instant([offset]):
            self._header.lines[offset].outside = level

    def _record(self, changes: Mapping[int, bool]) -> None:
        now_s = self._clock()
        self.edges.extend(Edge(now_s, offset, level) for offset, level in changes.items())
        for listener in self.on_edges:
            listener(now_s, changes)


class SimChip:
    """An opened chip, as `gpiod.Chip`, to be looked at."""

    def __init__(self, bank: _Bank) -> None:
        self._bank = bank

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Nothing to let go of."""

    def get_info(self) -> ChipInfo:
        return ChipInfo(os.path.basename(self._bank.path), self._bank.label, LINES)

    def get_line_info(self, offset: int) -> LineInfo:
        _check_offset(offset)
        consumer = self._bank.lines[offset].consumer
        return LineInfo(offset, f"GPIO{offset}", consumer is not None, consumer or "")


class SimLineRequest:
    """Lines that are ours until released, as `gpiod.LineRequest`. Values come in the caller's own enum."""

    def __init__(
        self, bank: _Bank, settings: Mapping[int, Settings], outputs: Mapping[int, bool], consumer: str, strict: bool
    ) -> None:
        self._bank = bank
        self._settings = settings
        self._strict = strict
        self._live = True
        with bank.instant(settings):
            if any(bank.lines[offset].consumer is not None for offset in settings):
                raise OSError(errno.EBUSY, os.strerror(errno.EBUSY))
            for offset, wanted in settings.items():
                line = bank.lines[offset]
                line.consumer = consumer
                match wanted.direction.name:
                    case "OUTPUT":
                        line.driven = outputs[offset] != wanted.active_low
                    case "INPUT":
                        line.driven = None
                match wanted.bias.name:
                    case "PULL_UP":
                        line.pull = True
                    case "PULL_DOWN" | "DISABLED":  # a floating pin has to read as something
                        line.pull = False

    def __enter__(self) -> Self:
        self._check_live()
        return self

    def __exit__(self, *error: object) -> None:
        self.release()

    def release(self) -> None:
        with self._bank.instant(self._settings):
            if not self._live:
                return
            self._live = False
            for offset in self._settings:
                line = self._bank.lines[offset]
                line.consumer = None
                if self._strict:
                    line.driven = None

    def set_value(self, line: int, value: Enum) -> None:
        self.set_values({line: value})

    def set_values(self, values: Mapping[int, Enum]) -> None:
        self._check_live()
        self._check_ours(values)
        with self._bank.instant(values):
            if any(self._bank.lines[offset].driven is None for offset in values):
                raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))  # an input cannot be set
            for offset, value in values.items():
                self._bank.lines[offset].driven = _active(value) != self._settings[offset].active_low

    def get_value(self, line: int) -> Any:
        return self.get_values([line])[0]

    def get_values(self, lines: Iterable[int] | None = None) -> list[Any]:
        self._check_live()
        offsets = list(lines or self._settings)
        self._check_ours(offsets)
        with self._bank.lock:
            return [self._logical(offset) for offset in offsets]

    def _logical(self, offset: int) -> Any:
        settings = self._settings[offset]
        active = self._bank.lines[offset].level != settings.active_low
        return type(settings.output_value)["ACTIVE" if active else "INACTIVE"]

    def _check_live(self) -> None:
        if not self._live:
            raise RequestReleasedError

    def _check_ours(self, offsets: Iterable[int]) -> None:
        if not set(offsets) <= self._settings.keys():
            raise ValueError(errno.EINVAL, os.strerror(errno.EINVAL))


def _active(value: Enum | None) -> bool:
    return value is not None and value.name == "ACTIVE"


def _by_offset(config: Config) -> dict[int, Settings]:
    settings: dict[int, Settings] = {}
    for key, wanted in config.items():
        for offset in (key,) if isinstance(key, int) else key:
            _check_offset(offset)
            if offset in settings:
                raise ValueError(f"line must be configured exactly once - offset {offset} repeats")
            if wanted.edge_detection.name != "NONE" or wanted.drive.name != "PUSH_PULL":
                raise NotImplementedError("edge detection and open outputs are not simulated")
            settings[offset] = wanted
    return settings


def _check_offset(offset: int) -> None:
    if not 0 <= offset < LINES:
        raise ValueError("line offset of out range")
