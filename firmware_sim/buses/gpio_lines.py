"""The lines of one simulated GPIO chip: which program holds them, the level of each pin, and its changes.

Knows pull resistors, outputs, levels from outside, and the edge detectors on inputs. Knows neither the interface of
gpiod nor what is wired to the pins.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

from firmware_sim.buses.gpio_edges import EdgeDetector

LINE_COUNT = 58
"""Of a BCM2711, the chip of a Raspberry Pi 4."""
PULLED_UP_AT_BOOT = range(9)  # BCM2835 ARM Peripherals, table 6-31: GPIO 0-8 up, 9-27 down


@dataclass(slots=True)
class Line:
    """One line. `pull` is the level of its pull resistor."""

    pull: bool
    driven: bool | None = None
    """The level of an output; None: the line is an input."""
    outside: bool | None = None
    """The level that the hardware outside puts on the pin; None: open. A driven output wins."""
    consumer: str | None = None
    """The name of the program that holds the line; None: it is free."""

    @property
    def level(self) -> bool:
        """The physical level of the pin."""
        if self.driven is not None:
            return self.driven
        return self.pull if self.outside is None else self.outside


class Bank:
    """The lines of one chip, in order of their offsets. `clock` gives seconds. All state changes under `lock`."""

    def __init__(self, path: str, label: str, clock: Callable[[], float]) -> None:
        self.path = path
        self.label = label
        self.clock = clock
        self.changed: Callable[[float, Mapping[int, bool]], None] = lambda at_s, changes: None
        self.on_look: list[Callable[[float], None]] = []
        self.detectors: dict[int, EdgeDetector] = {}
        self.lines = [Line(pull=offset in PULLED_UP_AT_BOOT) for offset in range(LINE_COUNT)]
        self.lock = threading.RLock()

    def look(self) -> None:
        """Bring all inputs up to the present moment. Call it before reading an input."""
        with self.lock:
            now_s = self.clock()
            for catch_up in self.on_look:
                catch_up(now_s)
            self._settle(now_s)

    @contextmanager
    def instant(self, offsets: Iterable[int], at_s: float | None = None) -> Iterator[None]:
        """All changes of these lines in the `with` body count as simultaneous: now, or at the earlier moment `at_s`.

        At the end of the body the detectors and `changed` get the pins whose level is another one.
        """
        with self.lock:
            moment_s = self.clock() if at_s is None else at_s
            self._settle(moment_s)
            before = {offset: self.lines[offset].level for offset in offsets}
            yield
            self._report(moment_s, before)

    def drive(self, levels: Mapping[int, bool]) -> None:
        """Give these outputs their levels, all at once: `instant` for what is done most often."""
        with self.lock:
            moment_s, lines = self.clock(), self.lines
            self._settle(moment_s)
            before = {}
            for offset, level in levels.items():
                if lines[offset].driven is not level:
                    before[offset] = lines[offset].level
                    lines[offset].driven = level
            self._report(moment_s, before)

    def _report(self, moment_s: float, before: Mapping[int, bool]) -> None:
        """Tell the detectors and `changed` which of these pins have another level than before."""
        changes = {
            offset: self.lines[offset].level for offset, was in before.items() if self.lines[offset].level != was
        }
        if not changes:
            return
        for offset, level in changes.items():
            if offset in self.detectors:
                self.detectors[offset].change(moment_s, level)
        self.changed(moment_s, changes)

    def _settle(self, until_s: float) -> None:
        """End the debounce periods that are over by `until_s`, oldest first."""
        if not self.detectors:
            return
        due = [detector for detector in self.detectors.values() if detector.due_s <= until_s]
        for detector in sorted(due, key=lambda detector: detector.due_s):
            detector.settle()
