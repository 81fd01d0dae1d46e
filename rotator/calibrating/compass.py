"""The compass on the boom: opened as the file says, and looked at again and again by whoever wants north.

Part of the composition root. Knows the chip's driver and the file of what it has learnt. It has a thread of its own in
real time, because a chip that boots or is gone takes a second to say so. Decides nothing.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from pathlib import Path

from hw.chips.bno055 import Bno055
from hw.ports import HardwareError
from rotator.assembly.board import Board
from rotator.calibrating.bearing import Learnt, Sighting
from rotator.config.model import Config
from rotator.store.compass import CompassFile

LEARNT_FILE = "compass.json"
"""Beside the state file: what the chip forgets without power."""
LOOK_EVERY_S = 0.1
JOIN_S = 3.0


def learnt_path(config: Config) -> Path | None:
    """Where what the compass has learnt is kept; a simulated one's is kept nowhere: a real chip must never get it."""
    return None if config.rotor.hardware == "sim" else Path(config.state.path).with_name(LEARNT_FILE)


def open_compass(config: Config, board: Board) -> Bno055:
    """Raises HardwareError where the file has none; whether the chip is there shows when it is asked."""
    table = config.compass
    if table.kind == "none":
        raise HardwareError(
            'the file has no compass: fit a BNO055 to the boom and write [compass] kind = "bno055" (docs/sensors.md)'
        )
    return Bno055(board.bus(table.bus), board.clock, board.sleep, address=table.address, mounting=table.mounting)


class CompassReader:
    """`look` now and then, or `start` a thread that does; `latest` may be read from any thread."""

    def __init__(self, compass: Bno055, clock: Callable[[], float], file: CompassFile | None) -> None:
        self.latest: Sighting | None = None
        self.told: deque[str] = deque()
        """What became of what it learnt, for a person."""
        self._compass = compass
        self._clock = clock
        self._file = file
        self._given = False
        self._keep = threading.Event()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._keep_looking, name="compass", daemon=True)

    def keep(self) -> None:
        """What it has learnt goes into the file before the next look; its angles are gone for a moment meanwhile."""
        self._keep.set()

    @property
    def keeps(self) -> bool:
        """It has still to do that."""
        return self._keep.is_set()

    def look(self) -> None:
        """One sighting. Never raises."""
        try:
            self._give_back()
            self._save()
            attitude = self._compass.attitude()
            learnt = Learnt(*self._compass.calibration())
        except HardwareError as fault:
            self.latest = Sighting(self._clock(), problem=str(fault))
            return
        tilt_deg = max(abs(attitude.roll_deg), abs(attitude.pitch_deg))
        self.latest = Sighting(self._clock(), attitude.heading_deg, tilt_deg, learnt)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join(timeout=JOIN_S)

    def _give_back(self) -> None:
        """What it knew at the last power-off."""
        if self._given:
            return
        self._given = True
        known = self._file.load() if self._file else None
        if known is not None:
            self._compass.restore(known)
            self.told.append("The compass has been given back what it had learnt.")

    def _save(self) -> None:
        if not self._keep.is_set():
            return
        try:
            learnt = self._compass.offsets()
        except HardwareError as fault:
            self.told.append(f"   Not kept: {fault}.")
        else:
            if self._file:
                self._file.save(learnt)
                kept = f"What the compass has learnt is kept in {self._file.path}"
                self.told.append(f"   {self._file.trouble or kept}.")
        self._keep.clear()

    def _keep_looking(self) -> None:
        while not self._stopping.is_set():
            self.look()
            self._stopping.wait(LOOK_EVERY_S)
