"""Saves while the box runs: calibrations taken over a link, learnt values of the motors, and modelled angles.

Knows when to save, and in which file. Other files do the writing. A failed write is logged, and never stops the box.
`state_thread` writes what must outlive a killed program.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from functools import partial
from pathlib import Path

from hw.ports import AngleSource, Axis
from rotator.config.load import ConfigError
from rotator.control.sky.offsets import Offsets
from rotator.runtime.loop import ControlLoop
from rotator.runtime.own_thread import aside
from rotator.store.counts import CountsFile
from rotator.store.hanging import within
from rotator.store.learnt import KeptMotors, Motors

log = logging.getLogger(__name__)

AUTOSAVE_THREAD = "autosave"
CLOSES_S = 2.0
"""The end of the program waits for this time at most: a card may hang."""
CALIBRATIONS_EVERY_S = 1.0
CALIBRATIONS_AGAIN_S = 10.0
"""The pause after a calibration that could not be saved."""
LEARNT_EVERY_S = 600.0


class Autosave:
    """`path`: the configuration file, if there is one. `modelled`: the file of the angles that only a model knows.
    `run` while the box runs, `close` when its loop has ended.

    Raises nothing: a file that cannot be written is in the log.
    """

    def __init__(
        self,
        loop: ControlLoop,
        path: Path | None,
        offsets: Offsets,
        learnt: KeptMotors,
        modelled: CountsFile | None = None,
    ) -> None:
        self._loop = loop
        self._path = path
        self._offsets = offsets
        self._learnt = learnt
        self._saving = threading.Lock()
        """`close` may come while another thread still saves."""
        self._saved = {axis: loop.status.axis(axis).calibration for axis in Axis}
        self._troubles: dict[Axis, str] = {}
        """Why the latest calibration of an axis could not be saved."""
        learnt.note(self._motors())
        self._modelled = modelled
        if modelled:
            modelled.load()

    async def run(self) -> None:
        """Save again and again, until cancelled."""
        rounds = 0
        while True:
            await asyncio.sleep(CALIBRATIONS_EVERY_S)
            rounds += 1
            if not self._troubles or rounds * CALIBRATIONS_EVERY_S % CALIBRATIONS_AGAIN_S == 0:
                await aside(self.keep_calibrations, AUTOSAVE_THREAD)
            if self._modelled:
                await aside(self.keep_modelled, AUTOSAVE_THREAD)
            if rounds * CALIBRATIONS_EVERY_S % LEARNT_EVERY_S == 0:
                await aside(partial(self._keep_learnt, ending=False), AUTOSAVE_THREAD)

    def close(self, patience_s: float = CLOSES_S) -> None:
        """Save the last changes. Returns after this time, also while the card hangs. May be called twice."""
        within(patience_s, self._close, AUTOSAVE_THREAD)

    def _close(self) -> None:
        self.keep_calibrations()
        self._keep_learnt(ending=True)
        self.keep_modelled(ending=True)

    def keep_calibrations(self) -> None:
        """Save each calibration that was taken over a link (O, F) and is not saved yet."""
        with self._saving:
            self._keep_calibrations()

    def _keep_learnt(self, *, ending: bool) -> None:
        with self._saving:
            self._learnt.save(self._motors(), ending=ending)

    def keep_modelled(self, *, ending: bool = False) -> None:
        """Save the angles that only a model knows: of each axis at rest; at the end of the program of any."""
        for axis in Axis:
            each = self._loop.status.axis(axis)
            known = each.source is AngleSource.MODELLED and (ending or not each.moving)
            if self._modelled and known and each.angle_deg is not None:
                with self._saving:
                    self._modelled.rest(axis, round(each.angle_deg - self._offsets.deg(axis), 1))

    def _keep_calibrations(self) -> None:
        for axis in Axis:
            points = self._loop.status.axis(axis).calibration
            if points is not None and points != self._saved[axis] and self._keep_calibration(axis, points):
                self._saved[axis] = points

    def _keep_calibration(self, axis: Axis, points: tuple[tuple[float, float], ...]) -> bool:
        """False: not saved, try again. The log has each new reason once."""
        if self._path is None:
            log.warning("%s: new calibration, lost at the end: run with --config to keep it", axis.value)
            return True
        try:
            from rotator.config.save import save_tables  # noqa: PLC0415 - loads tomlkit, which a start can do without

            save_tables(self._path, {axis.value: {"calibration": self._offsets.own_scale(axis, points)}})
        except (OSError, ConfigError) as fault:
            if self._troubles.get(axis) != str(fault):
                log.error("%s: calibration cannot be saved, it is tried again: %s", axis.value, fault)
            self._troubles[axis] = str(fault)
            return False
        self._troubles.pop(axis, None)
        log.info("%s: calibration saved in %s", axis.value, self._path)
        return True

    def _motors(self) -> dict[Axis, Motors]:
        learnt = {axis: self._loop.status.axis(axis).learnt for axis in Axis}
        return {axis: motors for axis, motors in learnt.items() if motors is not None}
