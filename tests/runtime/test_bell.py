"""The bell that wakes the control thread: a ring is never lost, and never heard twice."""

from __future__ import annotations

import signal
import threading
from concurrent.futures import ThreadPoolExecutor

from rotator.runtime.bell import Bell

LONG_S = 60.0


def test_a_moment_that_has_passed_is_no_wait() -> None:
    assert not Bell().wait(-1.0)


def test_a_ring_before_the_wait_is_heard_once() -> None:
    bell = Bell()
    bell.ring()
    assert bell.wait(0.0)
    assert not bell.wait(0.0)


def test_a_ring_of_another_thread_ends_the_wait() -> None:
    bell = Bell()
    with ThreadPoolExecutor(1) as pool:
        heard = pool.submit(bell.wait, LONG_S)
        bell.ring()
        assert heard.result()


def test_after_the_last_ring_of_many_threads_one_is_heard() -> None:
    """Each round of readings and each order rings; the last of them must reach the control thread."""
    bell, posted, taken = Bell(), [0], 0
    lock = threading.Lock()

    def post() -> None:
        for _ in range(500):
            with lock:
                posted[0] += 1
            bell.ring()

    with ThreadPoolExecutor(4) as pool:
        for _ in range(4):
            pool.submit(post)
        while taken < 2000:
            assert bell.wait(LONG_S)
            taken = posted[0]


def test_a_signal_may_ring_in_the_middle_of_a_ring() -> None:
    """SIGTERM interrupts the main thread anywhere, also while that thread posts an order."""
    bell, left = Bell(), [200]

    def again(_number: int, _frame: object) -> None:
        bell.ring()
        left[0] -= 1

    before = signal.signal(signal.SIGALRM, again)
    signal.setitimer(signal.ITIMER_REAL, 1e-4, 1e-4)
    try:
        while left[0] > 0:
            bell.ring()
            bell.wait(0.0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
