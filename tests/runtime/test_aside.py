"""A job beside the event loop: its failure comes back, and one that hangs is waited for by no end."""

from __future__ import annotations

import asyncio
import threading

import pytest

from rotator.runtime.autosave import aside


def test_the_event_loop_goes_on_while_the_job_works() -> None:
    free = threading.Event()

    async def both() -> None:
        waits = asyncio.create_task(aside(free.wait, "job"))
        await asyncio.sleep(0)
        assert not waits.done()
        free.set()
        await waits

    asyncio.run(both())


def test_what_the_job_raises_is_raised() -> None:
    def fails() -> None:
        raise OSError("full")

    with pytest.raises(OSError, match="full"):
        asyncio.run(aside(fails, "job"))


def test_a_job_that_hangs_holds_up_no_end() -> None:
    free = threading.Event()

    async def cancelled() -> None:
        waits = asyncio.create_task(aside(free.wait, "hangs"))
        await asyncio.sleep(0)
        waits.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waits

    asyncio.run(cancelled())
    (left,) = [thread for thread in threading.enumerate() if thread.name == "hangs"]
    assert left.daemon
    free.set()
    left.join()
