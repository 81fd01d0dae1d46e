"""Faults of a simulated rotor, by name: each can be injected, and cleared again.

Knows names, and that a part changes only after it has been brought up to the present moment. Knows no part.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SimFault:
    """One fault: what `inject` does to the simulated hardware, and what `clear` repairs."""

    inject: Callable[[], None]
    clear: Callable[[], None]


class Fallible:
    """A simulated rotor with a table of `faults` by name. Its parts change under its lock only."""

    faults: dict[str, SimFault]
    _lock: threading.RLock

    def inject(self, name: str) -> None:
        """Let that fault happen. Raises ValueError, with a list of the names, for an unknown one."""
        self._fault(name).inject()

    def clear(self, name: str) -> None:
        """Repair that fault. Raises ValueError for an unknown one."""
        self._fault(name).clear()

    def _advance(self) -> None:
        """Bring every part up to the present moment."""
        raise NotImplementedError

    def _fault(self, name: str) -> SimFault:
        if name not in self.faults:
            raise ValueError(f"no fault called {name!r}; there are: {', '.join(sorted(self.faults))}")
        return self.faults[name]

    def _fault_of(self, part: object, field: str, bad: object, good: object) -> SimFault:
        """A fault that is an attribute of a part: `bad` while injected, `good` when cleared."""

        def become(value: object) -> None:
            with self._lock:
                self._advance()
                setattr(part, field, value)

        return SimFault(lambda: become(bad), lambda: become(good))
