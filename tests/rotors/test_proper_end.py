"""A proper end of the whole box on every kind of rotor, in real time: no failure, no warning, and the files written."""

from __future__ import annotations

import asyncio
import json
import logging
import threading
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import pytest

from hw.ports import AngleSource, Axis
from rotator.assembly.station import Station
from rotator.box.app import App
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.exchange.orders import Aim
from rotator.rotors.counts_writer import COUNTS_THREAD
from rotator.store.counts import FILE_NAME, CountsFile, Standing
from tests.rotors.rig import KINDS, Kind, configured

pytestmark = pytest.mark.quiet

PATIENCE_S = 60.0
LOOK_S = 0.02
WITHIN_DEG = 8.0
"""Nearer than that it stands after a move, though its motors are not what the file says."""


async def until(done: Callable[[], bool]) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while not done():
            await asyncio.sleep(LOOK_S)


def quick(kind: Kind, folder: Path) -> Config:
    """Runs faster than the file says, so that there is something to learn within seconds."""
    tables: dict[str, dict[str, object]] = {"state": {"path": f"{folder}/state.json"}}
    if kind.profile in ("g5500", "g1000", "ham4", "u100"):
        tables |= {"azimuth": {"speed_dps": 25.0}, "sim": {"azimuth": {"speed_dps": 30.0}}}
    if kind.profile == "u100":
        tables |= {"pulses": {"debounce_s": 0.005}}
    link = parse(f'[[link]]\nprotocol = "gs232b"\npty = "{folder}/gs232"\n', "test").link
    return configured(kind.profile, **tables).model_copy(update={"link": link})


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.profile)
def test_a_proper_end_is_without_a_word_and_keeps_what_was_found_out(
    kind: Kind, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    config = quick(kind, tmp_path)
    file = tmp_path / FILE_NAME
    counting = [axis for axis in Axis if config.counts(axis)]
    cams = config.kind.cams(counting)
    for axis, angle_deg in zip(counting, kind.start_deg, strict=False):
        before = CountsFile(file, cams)
        before.load()
        before.home(axis, angle_deg)
    app = App(config, station=Station(config, time.monotonic, time.sleep, kind.start_deg, counts=file))
    begun_with = app.loop.status.azimuth.learnt

    def knows_where_it_is() -> bool:
        return app.loop.status.azimuth.angle_deg is not None and not app.loop.status.faults

    def stands_at(target_deg: float) -> bool:
        angle_deg = app.loop.status.azimuth.angle_deg
        there = angle_deg is not None and abs(angle_deg - target_deg) < WITHIN_DEG and not app.loop.status.moving
        return there and (not counting or CountsFile(file, cams).load()[Axis.AZIMUTH].standing is Standing.KNOWN)

    async def go_to(target_deg: float) -> None:
        app.console.order(Aim(target_deg, None))
        await until(lambda: app.loop.status.moving)
        await until(lambda: stands_at(target_deg))

    async def run() -> None:
        stop = asyncio.Event()
        task = asyncio.create_task(app.run(stop))
        await until(knows_where_it_is)
        caplog.clear()
        way_deg = 12.0 if begun_with is None or kind.source is AngleSource.MODELLED else 90.0
        for target_deg in (kind.start_deg[0] + way_deg, kind.start_deg[0]):
            await go_to(target_deg)
            if begun_with is None or app.loop.status.azimuth.learnt != begun_with:
                break
        stop.set()
        await asyncio.wait_for(task, PATIENCE_S)

    asyncio.run(run())
    assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []
    assert not [thread for thread in threading.enumerate() if thread.name.startswith(COUNTS_THREAD)]
    learnt = app.loop.status.azimuth.learnt
    assert not counting or not config.rotor.switched or kind.source is AngleSource.MODELLED or learnt != begun_with
    if learnt is not None and learnt != begun_with:
        kept = json.loads((tmp_path / "state.json").read_text())["learnt"]["axes"]["azimuth"]
        assert (kept["plus"], kept["minus"]) == (asdict(learnt[0]), asdict(learnt[1]))
    if counting:
        place = CountsFile(file, cams).load()[Axis.AZIMUTH]
        assert place.standing is Standing.KNOWN
        assert place.angle_deg == pytest.approx(app.loop.status.azimuth.angle_deg, abs=1.0)
