"""The lines of one simulated GPIO chip: who has them, what level each pin is at, and when that changes.

Knows pulls, outputs, what somebody outside puts on a pin, and the detectors that watch inputs. Knows nothing of the
interface of gpiod, nor of what hangs on the pins.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

from firmware_sim.buses.gpio_edges import EdgeDetector

LINES = 58
PULLED_UP_AT_BOOT = range(9)  # BCM2835 ARM Peripherals, table 6-31: GPIO 0-8 up, 9-27 down


@dataclass(slots=True)
class Line:
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


class Bank:
    """The lines of one chip. `clock` gives seconds."""

    def __init__(self, path: str, label: str, clock: Callable[[], float]) -> None:
        self.path = path
        self.label = label
        self.clock = clock
        self.changed: Callable[[float, Mapping[int, bool]], None] = lambda at_s, changes: None
        self.on_look: list[Callable[[float], None]] = []
        self.detectors: dict[int, EdgeDetector] = {}
        self.lines = [Line(pull=offset in PULLED_UP_AT_BOOT) for offset in range(LINES)]
        self.lock = threading.RLock()

    def look(self) -> None:
        """Before an input is looked at: what should have happened to it by now happens."""
        with self.lock:
            now_s = self.clock()
            for catch_up in self.on_look:
                catch_up(now_s)
            self._settle(now_s)

    @contextmanager
    def instant(self, offsets: Iterable[int], at_s: float | None = None) -> Iterator[None]:
        """Whatever the body does to these lines happens to all of them at once: now, or at that earlier moment."""
        with self.lock:
            moment_s = self.clock() if at_s is None else at_s
            self._settle(moment_s)
            before = {offset: self.lines[offset].level for offset in offsets}
            yield
            after = {offset: self.lines[offset].level for offset in before}
            changes = {offset: level for offset, level in after.items() if level != before[offset]}
            if not changes:
                return
            for offset, level in changes.items():
                if offset in self.detectors:
                    self.detectors[offset].change(moment_s, level)
            self.changed(moment_s, changes)

    def _settle(self, until_s: float) -> None:
        """Let every debounce period that is over by then end, in order of time."""
        due = [detector for detector in self.detectors.values() if detector.due_s <= until_s]
        for detector in sorted(due, key=lambda detector: detector.due_s):
            detector.settle()
