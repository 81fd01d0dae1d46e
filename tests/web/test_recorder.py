"""A pass as the box flew it, from its statuses alone: samples, every click, how it ends, and its picture."""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from hw.ports import Direction
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.flight_order import AxisPlan, Fly
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.store.flown import FlownPasses
from rotator.views.pass_svg import Flown as Drawn
from rotator.views.pass_svg import draw
from rotator.views.trace import Sample
from rotator.web.flown import FlownPictures, policy
from rotator.web.recorder import EVERY_S, MOST_SAMPLES, Record, Recorder

PLAN = AxisPlan(0.0, (0.0,), ())
RISE_S, SET_S = 100.0, 700.0


def order(name: str = "ISS") -> Fly:
    return Fly(name, ((RISE_S, 90.0, 0.0), (400.0, 180.0, 60.0), (SET_S, 270.0, 0.0)), PLAN, PLAN)


def status(
    at_s: float, name: str | None = "ISS", *, starts: int | None = 0, off_deg: float = 2.0, rises_s: float = RISE_S
) -> Status:
    flown = None if name is None else Flown(name, rises_s, SET_S)
    azimuth = AxisStatus(0, 450, angle_deg=90.0 + (at_s - RISE_S) * 0.3 + off_deg, starts=starts)
    elevation = AxisStatus(0, 90, angle_deg=30.0, starts=starts)
    return Status(at_s, azimuth, elevation, flown=flown)


class Watched:
    def __init__(self) -> None:
        self.recorder = Recorder()
        self.over: list[Record] = []
        self.recorder.over = self.over.append
        self.recorder.note_order(order())

    def look(self, begin_s: float, end_s: float, **how: object) -> None:
        for step in range(round((end_s - begin_s) * 10)):
            self.recorder.look(status(begin_s + step / 10, **how))  # type: ignore[arg-type]


def test_a_pass_is_recorded_from_its_rise_to_its_end() -> None:
    watched = Watched()
    watched.look(50.0, SET_S)
    assert watched.over == []
    watched.recorder.look(status(SET_S, None))
    (record,) = watched.over
    assert record.name == "ISS"
    assert record.begin_s == pytest.approx(RISE_S, abs=0.2), "the wait for the rise is no part of it"
    assert len(record.trace) == pytest.approx((SET_S - RISE_S) / EVERY_S, rel=0.25)
    middle = min(record.trace, key=lambda sample: abs(sample.t - 300.0))
    assert (middle.target_az, middle.target_el) == pytest.approx((180.0, 60.0), abs=0.2)
    assert 5.0 < record.rms_deg < 40.0
    assert record.relay_starts == 0


def test_a_target_that_was_up_before_the_antenna_was_there_is_recorded_from_then_on() -> None:
    watched = Watched()
    watched.look(RISE_S - 50.0, SET_S, rises_s=RISE_S - 100.0)
    watched.recorder.look(status(SET_S, None))
    (record,) = watched.over
    assert record.begin_s == pytest.approx(RISE_S, abs=0.2)


def test_every_click_is_in_it_though_it_came_between_two_looks() -> None:
    watched = Watched()
    watched.look(RISE_S, RISE_S + 30.0, starts=4)
    for count in range(5, 25):
        watched.recorder.look(status(RISE_S + 30.0 + count / 10, starts=count))
    watched.recorder.look(status(RISE_S + 40.0, None))
    (record,) = watched.over
    assert {axis: len(clicks) for axis, clicks in record.clicks_s.items()} == {"azimuth": 20, "elevation": 20}
    drawing = draw("ISS <&>", [Drawn("the antenna", "blue", record.trace, record, record.clicks_s)])
    assert "20 clicks" in drawing
    assert "ISS &lt;&amp;&gt;" in drawing


def test_a_motor_that_runs_when_it_begins_has_clicked_once() -> None:
    watched = Watched()
    first = status(RISE_S, starts=7)
    watched.recorder.look(replace(first, azimuth=replace(first.azimuth, drive=Direction.MINUS)))
    watched.look(RISE_S + 0.1, RISE_S + 30.0, starts=7)
    watched.recorder.end()
    assert watched.over[0].clicks_s == {"azimuth": [0.0], "elevation": []}


def test_a_short_part_and_another_targets_order_leave_nothing() -> None:
    watched = Watched()
    watched.look(RISE_S, RISE_S + 10.0)
    watched.recorder.look(status(RISE_S + 10.0, None))
    watched.look(RISE_S, RISE_S + 100.0, name="SO-50")
    watched.recorder.look(status(RISE_S + 100.0, None))
    assert watched.over == []


@pytest.mark.long
def test_a_target_that_stays_up_for_days_takes_no_more_memory() -> None:
    watched = Watched()
    for step in range(MOST_SAMPLES * 5):
        watched.recorder.look(status(RISE_S + step * EVERY_S, starts=step))
    watched.recorder.end()
    (record,) = watched.over
    assert MOST_SAMPLES / 4 < len(record.trace) < MOST_SAMPLES
    assert max(map(len, record.clicks_s.values())) <= 2000


def test_a_picture_is_allowed_its_own_style_alone() -> None:
    watched = Watched()
    watched.look(RISE_S, RISE_S + 60.0)
    watched.recorder.end()
    record = watched.over[0]
    allowed = policy(draw("ISS", [Drawn("the antenna", "blue", record.trace, record)]))
    assert "default-src 'none'; style-src 'sha256-" in allowed
    assert "unsafe" not in allowed


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
