"""Saves while the box runs: calibrations taken over a link, learnt values of the motors, knowledge of the relays.

Knows when to save, and in which file. Other files do the writing. A failed write is logged, and never stops the box.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from pathlib import Path

from hw.ports import Axis
from rotator.config.load import ConfigError
from rotator.control.sky.offsets import Offsets
from rotator.runtime.loop import ControlLoop
from rotator.store.learnt import LearntFile, Motors
from rotator.store.relays import RelaysFile
from rotator.store.tries import TriesFile

log = logging.getLogger(__name__)

CALIBRATIONS_EVERY_S = 1.0
CALIBRATIONS_AGAIN_S = 10.0
"""The pause after a calibration that could not be saved."""
LEARNT_EVERY_S = 600.0
UNKEPT = (
    "the box cannot keep what it knows of the relays and motors: {trouble}. Look for a full or read-only card; "
    "look at the relays before the Pi starts again"
)


class Autosave:
    """`path`: the configuration file, if there is one. `run` while the box runs, `close` when its loop has ended.

    Raises nothing: a file that cannot be written is in the log.
    """

    def __init__(
        self,
        loop: ControlLoop,
        path: Path | None,
        offsets: Offsets,
        learnt: LearntFile,
        relays: RelaysFile | None = None,
        *,
        tries: TriesFile | None = None,
    ) -> None:
        """`relays`: the file of the relays; None: the rotor does not outlive the program, or has none. `tries`: the
        file of vain tries; None: the same."""
        self._loop = loop
        self._path = path
        self._offsets = offsets
        self._learnt = learnt
        self._relays = relays
        self._tries = tries
        self._saving = threading.Lock()
        """`close` may come while another thread still saves."""
        self._saved = {axis: loop.status.axis(axis).calibration for axis in Axis}
        self._troubles: dict[Axis, str] = {}
        """Why the latest calibration of an axis could not be saved."""
        learnt.note(self._motors())

    async def run(self) -> None:
        """Save again and again, until cancelled."""
        rounds = 0
        while True:
            await asyncio.sleep(CALIBRATIONS_EVERY_S)
            rounds += 1
            if not self._troubles or rounds * CALIBRATIONS_EVERY_S % CALIBRATIONS_AGAIN_S == 0:
                await asyncio.to_thread(self.keep_calibrations)
            await asyncio.to_thread(self.keep_relays)
            if rounds * CALIBRATIONS_EVERY_S % LEARNT_EVERY_S == 0:
                await asyncio.to_thread(self._keep_learnt, ending=False)

    def close(self) -> None:
        """Save the last changes. May be called twice."""
        self.keep_calibrations()
        self.keep_relays(ending=True)
        self._keep_learnt(ending=True)

    def keep_calibrations(self) -> None:
        """Save each calibration that was taken over a link (O, F) and is not saved yet."""
        with self._saving:
            self._keep_calibrations()

    def keep_relays(self, *, ending: bool = False) -> None:
        """Save the knowledge of the relays: before the first relay closes, at each suspicion, and at the end."""
        with self._saving:
            if self._relays:
                self._relays.save({axis: self._loop.status.axis(axis).trusts for axis in Axis}, ending=ending)
            files = [file for file in (self._relays, self._tries) if file and file.trouble]
            self._loop.unkept = tuple(UNKEPT.format(trouble=file.trouble) for file in files[:1])

    def _keep_learnt(self, *, ending: bool) -> None:
        with self._saving:
            self._learnt.save(self._motors(), ending=ending)

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
        from rotator.config.save import save_table  # noqa: PLC0415 - loads tomlkit, which a start can do without

        try:
            save_table(self._path, axis.value, calibration=self._offsets.own_scale(axis, points))
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
