"""Reads the compass on the boom about ten times a second, and keeps its corrections in a file.

Knows the compass's port and that file. In real time it has a thread of its own, because a chip that boots or is missing
takes a second to answer. Decides nothing.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

from hw.ports import Compass, HardwareError
from rotator.calibrating.bearing import CompassReading
from rotator.runtime.own_thread import OwnThread
from rotator.store.learnt import COMPASS
from rotator.store.state import State

READ_EVERY_S = 0.1
JOIN_S = 3.0


class CompassReader(OwnThread):
    """Call `read` now and then, or `start` a thread that does. `latest` may be read from any thread."""

    def __init__(self, compass: Compass, clock: Callable[[], float], corrections: State | None) -> None:
        """`corrections`: what remembers the compass's own; None: they are not kept."""
        super().__init__("compass", JOIN_S)
        self.latest: CompassReading | None = None
        self.messages: deque[str] = deque()
        """For the operator: whether the corrections were restored or saved."""
        self._compass = compass
        self._clock = clock
        self._corrections = corrections
        self._restored = False
        self.save_wanted = threading.Event()
        """Set it, and the corrections are saved before the next reading; then it is clear again. The compass gives no
        angles for a moment meanwhile."""

    def read(self) -> None:
        """Take one reading. Never raises."""
        try:
            self._restore()
            self._save()
            attitude = self._compass.attitude()
            calibration = self._compass.calibration()
        except HardwareError as fault:
            self.latest = CompassReading(self._clock(), problem=str(fault))
            return
        tilt_deg = max(abs(attitude.roll_deg), abs(attitude.pitch_deg))
        self.latest = CompassReading(self._clock(), attitude.heading_deg, tilt_deg, calibration)

    def _restore(self) -> None:
        """Give the compass the corrections that it had before the last power-off."""
        if self._restored:
            return
        self._restored = True
        offsets = self._corrections.load(COMPASS) if self._corrections else None
        if offsets is not None:
            self._compass.restore(offsets)
            self.messages.append("The compass has been given back what it had learnt.")

    def _save(self) -> None:
        if not self.save_wanted.is_set():
            return
        try:
            offsets = self._compass.offsets()
        except HardwareError as fault:
            self.messages.append(f"   Not kept: {fault}.")
        else:
            if state := self._corrections:
                said = f"What the compass has learnt is kept in {state.path}"
                if not state.keep(COMPASS, offsets):
                    said = f"{state.path}: what the compass learnt cannot be kept: {state.trouble}"
                self.messages.append(f"   {said}.")
        self.save_wanted.clear()

    def _run(self) -> None:
        while not self._stopping.is_set():
            self.read()
            self._stopping.wait(READ_EVERY_S)
