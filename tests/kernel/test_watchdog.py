"""The kernel's watchdog: quiet while it is fed, and it fires when nobody feeds it any more."""

from __future__ import annotations

import time

from tests.kernel.bench.waiting import until
from tests.kernel.bench.watchdog import Watchdog

TIMEOUT_S = 1


def test_it_fires_when_it_is_no_longer_fed() -> None:
    with Watchdog(TIMEOUT_S) as watchdog:
        fed_until_s = time.monotonic() + 2.5 * TIMEOUT_S
        while time.monotonic() < fed_until_s:
            watchdog.feed()
            assert not watchdog.fired()
        until(watchdog.fired, "the watchdog's last words")


def test_closed_properly_it_sleeps() -> None:
    with Watchdog(TIMEOUT_S) as watchdog:
        watchdog.feed()
    woken_s = time.monotonic() + 2 * TIMEOUT_S
    until(lambda: time.monotonic() > woken_s, "two timeouts")
    assert not watchdog.fired()
