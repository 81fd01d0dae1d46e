"""Keeps what a running box finds out: calibrations taken over a link, and what its motors have taught.

Knows when to look and where it goes. Knows nothing of how files are written, and never lets a full disk stop the box.
"""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path

from hw.ports import Axis
from rotator.config.load import ConfigError
from rotator.config.save import save_axis
from rotator.control.sky.offsets import Offsets
from rotator.runtime.loop import ControlLoop
from rotator.store.learnt import LearntFile, Motors

log = logging.getLogger(__name__)

CALIBRATIONS_EVERY_S = 1.0
LEARNT_EVERY_S = 600.0


class Autosave:
    """`path`: the configuration file, if there is one. `run` while the box runs, `close` when its loop has ended."""

    def __init__(self, loop: ControlLoop, path: Path | None, offsets: Offsets, learnt: LearntFile) -> None:
        self._loop = loop
        self._path = path
        self._offsets = offsets
        self._learnt = learnt
        self._points = {axis: loop.status.axis(axis).calibration for axis in Axis}
        learnt.note(self._motors())

    async def run(self) -> None:
        looks = 0
        while True:
            await asyncio.sleep(CALIBRATIONS_EVERY_S)
            await asyncio.to_thread(self.keep_calibrations)
            looks += 1
            if looks * CALIBRATIONS_EVERY_S % LEARNT_EVERY_S == 0:
                await asyncio.to_thread(self._learnt.save, self._motors(), ending=False)

    def close(self) -> None:
        self.keep_calibrations()
        self._learnt.save(self._motors(), ending=True)

    def keep_calibrations(self) -> None:
        """Save a calibration taken over a link (O, F) as soon as it is there."""
        for axis in Axis:
            points = self._loop.status.axis(axis).calibration
            if points is None or points == self._points[axis]:
                continue
            self._points[axis] = points
            if self._path is None:
                log.warning("%s: new calibration, lost at the end: run with --config to keep it", axis.value)
                continue
            try:
                save_axis(self._path, axis.value, calibration=self._offsets.own_scale(axis, points))
                log.info("%s: calibration saved in %s", axis.value, self._path)
            except (OSError, ConfigError) as fault:
                log.error("%s: calibration cannot be saved: %s", axis.value, fault)

    def _motors(self) -> dict[Axis, Motors]:
        learnt = {axis: self._loop.status.axis(axis).learnt for axis in Axis}
        return {axis: motors for axis, motors in learnt.items() if motors is not None}
