"""Fixtures that begin a calibration in simulated time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from hw.ports import Axis
from rotator.config.load import parse
from tests.calibrating.rig import QUIET, Calibration, NorthCalibration


@pytest.fixture
def calibration() -> Callable[..., Calibration]:
    """Begins a calibration of the azimuth (or the axis given) on a simulated rotor that stands near its low stops: at
    30° and 15°."""

    def start(text: str = "", axis: Axis = Axis.AZIMUTH, **rest: Any) -> Calibration:
        return Calibration(parse(text + QUIET, "test"), axis, **{"start_deg": (30.0, 15.0)} | rest)

    return start


@pytest.fixture
def swift(calibration: Callable[..., Calibration]) -> Callable[..., Calibration]:
    """Begins one with an azimuth motor of 30°/s, so that the whole range takes 8 presses. `sim`: more of that table."""

    def start(text: str = "", sim: str = "") -> Calibration:
        return calibration(f"{text}[sim.azimuth]\nspeed_dps = 30\n{sim}")

    return start


@pytest.fixture
def north_calibration() -> Callable[..., NorthCalibration]:
    def start(text: str, **rest: Any) -> NorthCalibration:
        return NorthCalibration(parse(text + QUIET, "test"), **rest)

    return start
