"""What drives with commands that expire share: the longest life of a command, and the sleep of the guard's thread.

Knows moments, in seconds. Knows no relay, motor, chip or angle.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable

from hw.ports import HardwareError

LONGEST_LEASE_S = 0.5
"""Longest life of a command, even if the caller asks for more: when the caller dies, the motor stops within 0.5 s."""


def wait_until(
    changed: threading.Condition, due_s: float | None, clock: Callable[[], float], patience_s: float
) -> None:
    """Sleep until `due_s` (None: nothing is due), until `changed`, or for `patience_s`. The caller holds `changed`."""
    left_s = patience_s if due_s is None else min(patience_s, due_s - clock())
    if left_s > 0:
        changed.wait(left_s)


def do_all(acts: Iterable[Callable[[], object]]) -> None:
    """Call each of them, also after a failure. Raises the first HardwareError."""
    failures: list[HardwareError] = []
    for act in acts:
        try:
            act()
        except HardwareError as failure:
            failures.append(failure)
    if failures:
        raise failures[0]
