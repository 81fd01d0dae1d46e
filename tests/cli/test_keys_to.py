"""Single keys of a terminal: a real one, whose other end may be closed while the box runs."""

from __future__ import annotations

import asyncio
import os
import signal
import sys

import pytest

from rotator.cli.screen import keys_to
from rotator.runtime.signals import SignalThread


@pytest.mark.parametrize("outlives", [False, True])
def test_keys_arrive_one_by_one_and_a_closed_terminal_ends_the_box_unless_it_is_to_outlive_it(
    monkeypatch: pytest.MonkeyPatch, outlives: bool
) -> None:
    """It is closed on `make run`: the kernel's signal goes to make alone. `nohup` has the signal ignored."""
    master, slave = os.openpty()
    pressed: list[str] = []
    ended: list[bool] = []

    async def box() -> None:
        loop, came = asyncio.get_running_loop(), asyncio.Event()

        def key(each: str) -> None:
            pressed.append(each)
            came.set()

        with SignalThread(lambda: ended.append(True)), keys_to(key):
            os.write(master, b"s")
            await came.wait()
            os.close(master)
            for _ in range(100):
                await asyncio.sleep(0)
            assert not loop.remove_reader(sys.stdin), "it still listens to a terminal that is gone"

    before = signal.signal(signal.SIGHUP, signal.SIG_IGN if outlives else signal.SIG_DFL)
    try:
        with open(slave, encoding="utf-8") as terminal:
            monkeypatch.setattr(sys, "stdin", terminal)
            asyncio.run(asyncio.wait_for(box(), 60))
    finally:
        signal.signal(signal.SIGHUP, before)
    assert (pressed, ended) == (["s"], [] if outlives else [True])
