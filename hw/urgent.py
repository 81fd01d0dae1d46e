"""Threads that go before the other work of this computer: those that stop a motor, or see where it is.

Knows the kernel's real-time scheduling of the calling thread. Knows no motor. A thread that runs away must not hang the
computer: it is urgent only where somebody, the service's unit for one, has limited how long such a thread may compute
without a pause (RLIMIT_RTTIME: the kernel ends the program then, and the sentinel opens the relays). Elsewhere, and
where the system forbids it, nothing changes.
"""

from __future__ import annotations

import os
import resource
from contextlib import suppress

PRIORITY = 1
"""The lowest of the real-time priorities: before all ordinary programs, and behind all that the kernel itself does."""


def hurry() -> None:
    """Let the calling thread go before ordinary ones. What it starts goes with them again."""
    if resource.getrlimit(resource.RLIMIT_RTTIME)[0] == resource.RLIM_INFINITY:
        return
    with suppress(OSError):
        os.sched_setscheduler(0, os.SCHED_RR | os.SCHED_RESET_ON_FORK, os.sched_param(PRIORITY))
