"""Parts are closed in their order, and one that fails does not keep the next one from being closed."""

from __future__ import annotations

import asyncio
import logging
import threading

import pytest

from hw.ports import HardwareError
from rotator.runtime.closing import Part, closing


class Box:
    """Three parts that note when they are closed, some of which fail."""

    def __init__(self, **failures: BaseException) -> None:
        self.closed: list[str] = []
        self._failures = failures
        self.parts = [
            Part("first", self._close_first),
            Part.quick("second", lambda: self._close("second")),
            Part.blocking("third", lambda: self._close("third")),
        ]

    async def _close_first(self) -> None:
        self._close("first")

    def _close(self, name: str) -> None:
        self.closed.append(name)
        if name in self._failures:
            raise self._failures[name]

    async def run(self, failure: Exception | None = None) -> None:
        async with closing(self.parts):
            assert self.closed == []
            if failure is not None:
                raise failure


def test_in_the_order_that_was_said() -> None:
    box = Box()
    asyncio.run(box.run())
    assert box.closed == ["first", "second", "third"]


def test_those_that_fail_skip_nothing_and_the_first_failure_is_raised(caplog: pytest.LogCaptureFixture) -> None:
    box = Box(first=HardwareError("no line"), second=ZeroDivisionError("a bug"), third=OSError("no disk"))
    with pytest.raises(HardwareError, match="no line"):
        asyncio.run(box.run())
    assert box.closed == ["first", "second", "third"]
    said = [(record.getMessage(), record.exc_info is not None) for record in caplog.records]
    assert said == [
        ("first failed: no line", True),
        ("second failed: a bug", True),
        ("third failed: no disk", True),
    ], "each once, with a traceback"


def test_what_ended_the_body_comes_before_what_fails_afterwards(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.ERROR)
    box = Box(second=HardwareError("no line"))
    with pytest.raises(ValueError, match="the reason"):
        asyncio.run(box.run(ValueError("the reason")))
    assert box.closed == ["first", "second", "third"]
    assert "second failed: no line" in caplog.text


def test_a_failure_noted_before_is_not_noted_again(caplog: pytest.LogCaptureFixture) -> None:
    failure = HardwareError("no line")
    box = Box(first=failure, third=HardwareError("no bus"))

    async def run() -> None:
        async with closing(box.parts) as failures:
            failures.note("motion", failure)

    with pytest.raises(HardwareError, match="no line"):
        asyncio.run(run())
    assert [record.getMessage() for record in caplog.records] == ["motion failed: no line", "third failed: no bus"]
    assert caplog.records[0].exc_info is None, "a sentence says it all"


def test_cancelled_it_closes_everything() -> None:
    box = Box()

    async def run() -> None:
        async with closing(box.parts):
            await asyncio.Event().wait()

    async def cancel() -> None:
        task = asyncio.create_task(run())
        await asyncio.sleep(0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    asyncio.run(cancel())
    assert box.closed == ["first", "second", "third"]


def test_what_blocks_has_a_thread() -> None:
    threads: list[threading.Thread] = []

    async def run() -> None:
        async with closing([Part.blocking("slow", lambda: threads.append(threading.current_thread()))]):
            pass

    asyncio.run(run())
    assert threads != [threading.current_thread()]
