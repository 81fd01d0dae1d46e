"""How many files and connections the program may have open, and what it says when the system gives no more.

Each connection of a program or a browser is an open file. For those that it cannot take, asyncio itself would write a
hundred tracebacks a second, and fill the disk. Knows the system's limit, and an event loop's errors.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import resource
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rotator.runtime.log_limit import LogLimit

log = logging.getLogger(__name__)

ENOUGH_FILES = 8192
"""Thirty links with all their clients, and the page. The usual limit, 1024, is enough for six."""
NO_MORE = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
"""The errors that asyncio itself meets by waiting for a second."""


def allow_enough() -> None:
    """Raise the program's own limit, as far as the system lets it. Call it before a link opens."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = ENOUGH_FILES if hard == resource.RLIM_INFINITY else min(ENOUGH_FILES, hard)
    if soft == resource.RLIM_INFINITY or soft >= most:
        return
    with suppress(OSError, ValueError):  # a service may be kept from it
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))


def say_it_once(events: asyncio.AbstractEventLoop, clock: Callable[[], float] = time.monotonic) -> None:
    """From now on a connection that this event loop cannot take is a line in the log, once a minute."""
    limit = LogLimit(clock)

    def handle(_events: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        fault = context.get("exception")
        if not isinstance(fault, OSError) or fault.errno not in NO_MORE:
            events.default_exception_handler(context)
        elif line := limit.admit(f"a new connection has to wait: {os.strerror(fault.errno)}"):
            log.error("%s", line)

    events.set_exception_handler(handle)
