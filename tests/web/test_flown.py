"""The pictures of flown passes: one that cannot be drawn is lost, and the page goes on."""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from pathlib import Path

import pytest

from rotator.control.sky.mount import Mount, Range
from rotator.store.flown import FlownPasses
from rotator.views.trace import Sample
from rotator.web.flown import FlownPictures
from rotator.web.recorder import Record, Recorder
from tests.web.test_recorder import status

TRACE = tuple(Sample(float(t), 90.0 + t, 30.0, 91.0 + t, 30.0, 0, 0) for t in range(60))
NO_CLICKS: dict[str, list[float]] = {"azimuth": [], "elevation": []}
BEYOND_THE_CALENDAR_S = 1e20


def test_a_pass_without_a_date_is_not_drawn_and_the_next_one_is(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    moments_s = iter([BEYOND_THE_CALENDAR_S, 1.7e9])
    kept, recorder = FlownPasses(tmp_path), Recorder()
    mount = Mount(Range(0.0, 450.0), Range(0.0, 90.0))
    pictures = FlownPictures(kept, recorder, mount, lambda: status(700.0, None), lambda: next(moments_s))
    for name in ("ISS", "SO-50"):
        recorder.over(Record(name, 100.0, TRACE, NO_CLICKS, 0))

    async def until_one_is_kept() -> None:
        work = asyncio.create_task(pictures.run())
        while not kept.passes and not work.done():
            await asyncio.sleep(0)
        work.cancel()
        with suppress(asyncio.CancelledError):
            await work

    with caplog.at_level(logging.ERROR):
        asyncio.run(until_one_is_kept())
    assert [each.name for each in kept.passes] == ["SO-50"]
    assert "the picture of ISS cannot be drawn" in caplog.text
