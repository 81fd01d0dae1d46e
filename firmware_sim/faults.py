"""What can be made to go wrong in a simulated rotor, by name, and put right again.

Knows names and when a part may be changed: after it has been brought up to this moment. Knows no part.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SimFault:
    """Something that can be made to go wrong, and put right again."""

    inject: Callable[[], None]
    clear: Callable[[], None]


class Fallible:
    """A simulated rotor with a table of `faults`. Its parts change under its lock only."""

    faults: dict[str, SimFault]
    _lock: threading.RLock

    def inject(self, name: str) -> None:
        """Let something go wrong, by name. Raises ValueError that lists the names."""
        self._fault(name).inject()

    def clear(self, name: str) -> None:
        self._fault(name).clear()

    def _advance(self) -> None:
        """Bring every part up to this moment."""
        raise NotImplementedError

    def _fault(self, name: str) -> SimFault:
        if name not in self.faults:
            raise ValueError(f"no fault called {name!r}; there are: {', '.join(sorted(self.faults))}")
        return self.faults[name]

    def _fault_of(self, part: object, field: str, bad: object, good: object) -> SimFault:
        """A fault that is a property of a part."""

        def become(value: object) -> None:
            with self._lock:
                self._advance()
                setattr(part, field, value)

        return SimFault(lambda: become(bad), lambda: become(good))
