"""Faults of simulated hardware, by name: each can be injected and cleared.

Knows the table of names, and how a fault changes a part. Knows no part. Two faults that set the same attribute exclude
each other: the later one replaces the earlier one, and clearing either of them repairs the part. The tables of faults
name these pairs.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

from firmware_sim.sporadic import Sporadic


@dataclass(frozen=True, slots=True)
class SimFault:
    """One fault: `inject` breaks the simulated hardware, `clear` repairs it."""

    inject: Callable[[], None]
    clear: Callable[[], None]
    each: Callable[[int], None] | None = None
    """Injects a fault that strikes now and then, each n-th time; None: the fault does not take a number."""


class Fallible:
    """Simulated hardware with a table of `faults` by name.

    A fault changes a part under the lock, after `_advance`: until then the part worked without the fault.
    """

    faults: dict[str, SimFault]
    _lock: threading.RLock

    def inject(self, name: str) -> None:
        """Begin the fault `name`, or `name:7` where it strikes each seventh time.

        Raises ValueError for an unknown name, with the names of all faults, and for a number that is not taken.
        """
        name, colon, number = name.partition(":")
        fault = self._fault(name)
        if not colon:
            fault.inject()
        elif fault.each is None or not number.isdecimal() or int(number) < 1:
            raise ValueError(f"the fault {name} does not strike each {number!r}th time")
        else:
            fault.each(int(number))

    def clear(self, name: str) -> None:
        """Repair the fault `name`. Raises ValueError, with the names of all faults, for an unknown name."""
        self._fault(name.partition(":")[0]).clear()

    def _advance(self) -> None:
        """Bring every part up to the present moment."""
        raise NotImplementedError

    def _fault(self, name: str) -> SimFault:
        if name not in self.faults:
            raise ValueError(f"no fault called {name!r}; there are: {', '.join(sorted(self.faults))}")
        return self.faults[name]

    def _fault_of(self, part: object, field: str, bad: object, good: object) -> SimFault:
        """A fault that is an attribute of a part: `bad` while injected, `good` when cleared."""
        return self._fault_by(lambda: setattr(part, field, bad), lambda: setattr(part, field, good))

    def _single_fault(self, happen: Callable[[], None]) -> SimFault:
        """A fault of one moment, as a dip of a supply. There is nothing to clear."""
        return SimFault(lambda: self._change(happen), lambda: None)

    def _fault_by(self, break_part: Callable[[], None], repair_part: Callable[[], None]) -> SimFault:
        """A fault that calls one of these two functions, under the lock and after `_advance`."""
        return SimFault(lambda: self._change(break_part), lambda: self._change(repair_part))

    def _sporadic_fault(self, sporadic: Sporadic, each: int) -> SimFault:
        """A fault that strikes now and then: each `each`-th time, unless another number is asked for."""

        def begin(every: int) -> None:
            self._change(lambda: setattr(sporadic, "every", every))

        return SimFault(lambda: begin(each), lambda: begin(0), begin)

    def _change(self, change_part: Callable[[], None]) -> None:
        with self._lock:
            self._advance()
            change_part()
