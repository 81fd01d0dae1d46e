"""Lines held by a program, in the shape of `gpiod.LineRequest`.

Knows a line's settings, its value, its edge events with the wait for them, and its state after release. It reads
settings by their attributes and enum members by their names, so that the real ones of the gpiod package fit without an
import. Does not know what is wired to a line, nor the other requests of a program.

Not simulated: open-drain and open-source outputs, other event clocks. A request for them raises NotImplementedError,
so that a missing feature is not taken for a broken wire. A request cannot be reconfigured.
"""

from __future__ import annotations

import errno
import os
import select
import time
from collections.abc import Iterable, Mapping
from datetime import timedelta
from enum import Enum
from typing import Any, Self

from firmware_sim.buses.gpio_edges import LARGEST_BUFFER, EdgeDetector, EdgeEvent, EventQueue
from firmware_sim.buses.gpio_lines import LINE_COUNT, Bank

Settings = Any
"""A `gpiod.LineSettings`."""
Config = Mapping[Any, Settings]
"""Settings by offset, or by a tuple of offsets."""
EVENTS_A_READ = 64
LOOK_EVERY_S = 0.005
"""Simulated contacts move only when a program reads them. A wait for events therefore reads this often."""


class RequestReleasedError(Exception):
    """A request was used after its release."""

    def __init__(self) -> None:
        super().__init__("GPIO lines have been released")


class SimLineRequest:
    """Holds its lines until `release`. Values are members of the caller's own enum.

    Raises OSError (EBUSY) if another request holds one of the lines.
    """

    def __init__(
        self,
        bank: Bank,
        settings: Mapping[int, Settings],
        outputs: Mapping[int, bool],
        *,
        consumer: str,
        strict: bool,
        event_buffer_size: int | None,
    ) -> None:
        self._bank = bank
        self._settings = settings
        self._active_low = {offset: bool(wanted.active_low) for offset, wanted in settings.items()}
        self._strict = strict
        self._live = True
        self._events = EventQueue(len(settings), event_buffer_size)
        self._events_a_read = min(event_buffer_size or EVENTS_A_READ, LARGEST_BUFFER)
        with bank.lock:  # no edge may come between the two steps, and another thread must not see one without the other
            bank.look()
            self._take_lines(outputs, consumer)
            self._watch_edges()

    def _take_lines(self, outputs: Mapping[int, bool], consumer: str) -> None:
        bank = self._bank
        with bank.instant(self._settings):
            if any(bank.lines[offset].consumer is not None for offset in self._settings):
                raise OSError(errno.EBUSY, os.strerror(errno.EBUSY))
            for offset, wanted in self._settings.items():
                line = bank.lines[offset]
                line.consumer = consumer
                # libgpiod: edge detection makes a line an input, even if its direction says output.
                if wanted.edge_detection.name != "NONE" or wanted.direction.name == "INPUT":
                    line.driven = None
                elif wanted.direction.name == "OUTPUT":
                    line.driven = outputs[offset] != wanted.active_low
                match wanted.bias.name:
                    case "PULL_UP":
                        line.pull = True
                    case "PULL_DOWN" | "DISABLED":  # a floating pin must have some level; here it is low
                        line.pull = False

    def _watch_edges(self) -> None:
        for offset, wanted in self._settings.items():
            if wanted.edge_detection.name != "NONE" or wanted.debounce_period:
                self._bank.detectors[offset] = EdgeDetector(
                    offset,
                    self._bank.lines[offset].level,
                    self._events,
                    edges=wanted.edge_detection.name,
                    active_low=wanted.active_low,
                    debounce_s=wanted.debounce_period.total_seconds(),
                )

    def __enter__(self) -> Self:
        self._check_live()
        return self

    def __exit__(self, *error: object) -> None:
        self.release()

    def release(self) -> None:
        """Release the lines. A second call does nothing, as in gpiod."""
        with self._bank.instant(self._settings):
            if not self._live:
                return
            self._live = False
            self._events.close()
            for offset in self._settings:
                line = self._bank.lines[offset]
                line.consumer = None
                self._bank.detectors.pop(offset, None)
                if self._strict:
                    line.driven = None

    # --- levels

    def set_value(self, line: int, value: Enum) -> None:
        self.set_values({line: value})

    def set_values(self, values: Mapping[int, Enum]) -> None:
        self._check_live()
        self._check_ours(values)
        with self._bank.lock:
            if any(self._bank.lines[offset].driven is None for offset in values):
                raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))  # an input cannot be set
            self._bank.drive({each: is_active(value) != self._active_low[each] for each, value in values.items()})

    def get_value(self, line: int) -> Any:
        return self.get_values([line])[0]

    def get_values(self, lines: Iterable[int] | None = None) -> list[Any]:
        self._check_live()
        offsets = list(lines or self._settings)
        self._check_ours(offsets)
        with self._bank.lock:
            self._bank.look()
            return [self._logical(offset) for offset in offsets]

    # --- edges

    @property
    def fd(self) -> int:
        self._check_live()
        return self._events.fd

    def fileno(self) -> int:
        return self.fd

    def wait_edge_events(self, timeout: timedelta | float | None = None) -> bool:
        """Whether there are events. Waits for the first, at most `timeout` seconds of real time (None: without end)."""
        self._check_live()
        seconds = timeout.total_seconds() if isinstance(timeout, timedelta) else timeout
        until_s = float("inf") if seconds is None else time.monotonic() + seconds
        while not self._waiting():
            left_s = until_s - time.monotonic()
            if left_s <= 0:
                return False
            select.select([self.fd], [], [], min(left_s, LOOK_EVERY_S))
        return True

    def read_edge_events(self, max_events: int | None = None) -> list[EdgeEvent]:
        """The oldest events, in order. Waits for the first, as the kernel does."""
        self.wait_edge_events(None)
        with self._bank.lock:
            return self._events.take(min(max_events or self._events_a_read, self._events_a_read))

    def _waiting(self) -> bool:
        self._bank.look()
        return len(self._events) > 0

    def _logical(self, offset: int) -> Any:
        settings, detector = self._settings[offset], self._bank.detectors.get(offset)
        level = detector.level if detector else self._bank.lines[offset].level
        return type(settings.output_value)["ACTIVE" if level != settings.active_low else "INACTIVE"]

    def _check_live(self) -> None:
        if not self._live:
            raise RequestReleasedError

    def _check_ours(self, offsets: Iterable[int]) -> None:
        if not set(offsets) <= self._settings.keys():
            raise ValueError(errno.EINVAL, os.strerror(errno.EINVAL))


def is_active(value: Enum | None) -> bool:
    return value is not None and value.name == "ACTIVE"


def by_offset(config: Config) -> dict[int, Settings]:
    """The settings of each line.

    Raises ValueError or OSError for settings that libgpiod or Linux refuses, NotImplementedError for those that are not
    simulated.
    """
    settings: dict[int, Settings] = {}
    for key, wanted in config.items():
        for offset in (key,) if isinstance(key, int) else key:
            check_offset(offset)
            if offset in settings:
                # libgpiod's own words, as in `check_offset`
                raise ValueError(f"line must be configured exactly once - offset {offset} repeats")
            if wanted.drive.name != "PUSH_PULL":
                raise NotImplementedError("open-drain and open-source outputs are not simulated")
            if wanted.event_clock.name != "MONOTONIC":
                raise NotImplementedError("event clocks other than MONOTONIC are not simulated")
            detected = wanted.edge_detection.name != "NONE"
            if wanted.debounce_period and not detected and wanted.direction.name != "INPUT":
                raise OSError(errno.EINVAL, os.strerror(errno.EINVAL))  # Linux: debounce needs an explicit input
            settings[offset] = wanted
    return settings


def check_offset(offset: int) -> None:
    """Raises ValueError for an offset that the chip does not have."""
    if not 0 <= offset < LINE_COUNT:
        raise ValueError("line offset of out range")  # libgpiod's own words, with its slip
