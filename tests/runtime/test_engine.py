"""The control thread and the rotor's guard start together, and what has not started holds up no end."""

from __future__ import annotations

import asyncio
import logging
import time

import pytest

from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.runtime.engine import Engine
from rotator.runtime.loop import ControlLoop


def built(station: Station) -> Engine:
    return Engine(ControlLoop(build_controller(Config()), station.rotor, time.monotonic, 0.05), station.rotor)


def test_a_rotor_that_cannot_start_is_closed_at_once(caplog: pytest.LogCaptureFixture) -> None:
    """Its guard runs already here, and no thread starts twice."""
    caplog.set_level(logging.INFO)
    station = Station(Config(), time.monotonic, time.sleep, (100.0, 20.0))
    station.rotor.start()
    engine = built(station)

    async def start_and_halt() -> None:
        with pytest.raises(RuntimeError, match="only be started once"):
            engine.start()
        assert await engine.halt() is None
        assert await engine.halt() is None

    asyncio.run(start_and_halt())
    assert "does not end" not in caplog.text, "no control thread has started"
    assert {station.rotor.driven(axis) for axis in Axis} == {Direction.OFF}
    station.close()


def test_an_engine_that_was_never_started_is_halted_too() -> None:
    station = Station(Config(), time.monotonic, time.sleep, (100.0, 20.0))
    assert asyncio.run(built(station).halt()) is None
    station.close()


def test_started_it_runs_until_it_is_halted() -> None:
    station = Station(Config(), time.monotonic, time.sleep, (100.0, 20.0))
    engine = built(station)

    async def start_and_halt() -> None:
        ended = engine.start()
        assert not ended.done()
        assert await engine.halt() is None
        assert ended.done()

    asyncio.run(start_and_halt())
    station.close()
