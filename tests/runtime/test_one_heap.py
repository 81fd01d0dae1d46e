"""One heap for all threads: glibc reports one arena, also after many threads have asked for memory at once."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

MANY_THREADS = """
import ctypes, threading
from rotator.runtime.one_heap import use_one_heap
if {one}:
    use_one_heap()
start = threading.Barrier(8)
def work():
    start.wait()
    kept = [bytes(2000 + number) for number in range(2000)]
    start.wait()
threads = [threading.Thread(target=work) for _ in range(8)]
for each in threads: each.start()
for each in threads: each.join()
ctypes.CDLL(None).malloc_stats()
"""


def arenas(*, one: bool) -> int:
    ran = subprocess.run(
        [sys.executable, "-c", MANY_THREADS.format(one=one)], capture_output=True, text=True, check=True, timeout=60
    )
    return ran.stderr.count("Arena ")


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="needs glibc, the C library of Debian")
def test_all_threads_share_one_heap() -> None:
    assert arenas(one=True) == 1
    assert arenas(one=False) > 1
