"""One heap for all threads, as glibc reports it after many threads have asked for memory at once; and what the
collector of garbage looks at."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

MANY_THREADS = """
import ctypes, threading
from rotator.runtime.memory import use_one_heap
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


LOADED = """
import gc
from rotator.runtime.memory import loading
with loading():
    assert not gc.isenabled()
    import {module}
print(gc.isenabled(), gc.get_freeze_count() > 0)
"""


@pytest.mark.parametrize(("module", "kept"), [("fractions", True), ("gc", False)])
def test_the_collector_leaves_what_new_modules_have_made(module: str, *, kept: bool) -> None:
    told = subprocess.check_output([sys.executable, "-c", LOADED.format(module=module)], text=True, timeout=60)
    assert told.split() == ["True", str(kept)]
