"""Ctrl-C, SIGTERM and a closed terminal arrive at once, also while the main thread is stuck in C and runs no Python."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

import pytest

from rotator.runtime.signals import ENDINGS, SignalThread

PATIENCE_S = 20.0
STUCK = """
import ctypes, os
from rotator.runtime.signals import SignalThread
mutex, libc = ctypes.create_string_buffer(64), ctypes.CDLL(None)
with SignalThread(lambda: os._exit(7)):
    print("ready", flush=True)
    libc.pthread_mutex_lock(mutex)
    libc.pthread_mutex_lock(mutex)
"""
"""A lock that the main thread takes twice: it waits for itself for ever, and no signal wakes it."""


@pytest.mark.parametrize("signum", ENDINGS)
def test_the_main_thread_is_stuck(signum: signal.Signals) -> None:
    with subprocess.Popen([sys.executable, "-c", STUCK], stdout=subprocess.PIPE) as stuck:
        assert stuck.stdout is not None
        assert stuck.stdout.readline() == b"ready\n"
        stuck.send_signal(signum)
        try:
            assert stuck.wait(PATIENCE_S) == 7
        finally:
            stuck.kill()


def test_each_signal_calls_and_nothing_is_left_behind() -> None:
    before = [signal.getsignal(signum) for signum in ENDINGS]
    called = threading.Semaphore(0)
    with SignalThread(called.release):
        for signum in ENDINGS:
            os.kill(os.getpid(), signum)
            assert called.acquire(timeout=PATIENCE_S)
    assert [signal.getsignal(signum) for signum in ENDINGS] == before
    assert signal.set_wakeup_fd(-1) == -1


def test_another_signal_does_not_call() -> None:
    called = threading.Semaphore(0)
    before = signal.signal(signal.SIGUSR1, lambda *_: None)
    try:
        with SignalThread(called.release):
            os.kill(os.getpid(), signal.SIGUSR1)
            os.kill(os.getpid(), signal.SIGTERM)
            assert called.acquire(timeout=PATIENCE_S)
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert not called.acquire(blocking=False)
