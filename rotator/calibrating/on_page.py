"""A calibration that a browser guides: the box runs on with its page, and one axis is treated as never set up.

Knows the guide, its lines, and that a motor stands still where no browser looks on. Does not know HTTP, nor who may
press. The questions are those of `rotator calibrate`.
"""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.calibrating.entries import StopNow
from rotator.calibrating.results import save, saved_in
from rotator.calibrating.rig import axis_guide, picture, step
from rotator.calibrating.typed_ahead import TypedAhead
from rotator.config.load import ConfigError
from rotator.config.model import Config
from rotator.runtime.loop import ControlLoop

POLL_S = 0.02
LOOKS_S = 1.0
"""A browser asks more often than this for what the guide says. One that does not has gone: the motor stops."""
GONE_S = 300.0
"""After this time without a browser the calibration ends, and nothing of it is saved."""
MOST_LINES = 400


class PageCalibration:
    """`path`: the file for the result. Raises HardwareError where this axis cannot be calibrated on the page."""

    def __init__(self, config: Config, axis: Axis, path: Path, clock: Callable[[], float]) -> None:
        self.axis = axis
        self._path = path
        self._clock = clock
        self._guide = axis_guide(config, axis)
        self._lock = threading.Lock()
        self._keys: deque[str] = deque(maxlen=16)
        self._lines: deque[str] = deque(maxlen=MOST_LINES)
        self._state, self._turns = "", False
        self._looked_s = clock()

    @property
    def lines(self) -> tuple[str, ...]:
        with self._lock:
            return tuple(self._lines)

    def press(self, keys: str) -> None:
        """What a person presses, as the keys of `rotator calibrate`. Called from the page's thread."""
        with self._lock:
            self._keys.append(keys)

    def shown(self) -> dict[str, Any]:
        """What the guide says, and that a browser looks on. Called from the page's thread."""
        with self._lock:
            self._looked_s = self._clock()
            return {
                "axis": self.axis.value,
                "lines": list(self._lines),
                "prompt": self._guide.prompt,
                "state": self._state,
                "turns": self._turns,
            }

    async def run(self, loop: ControlLoop) -> None:
        """Until the guide ends. Its result is saved then. The motor stands."""
        typed = TypedAhead()
        while not self._guide.ended:
            with self._lock:
                pressed = self._keys.popleft() if self._keys else ""
                alone_s = self._clock() - self._looked_s
            if pressed:
                # A number that was begun and not entered is forgotten.
                typed.keyboard.typed = ""
            for key in pressed:
                typed.key(key)
            entry = typed.next(self._guide)
            if alone_s > GONE_S:
                self._say("No browser looks on any more: nothing is saved.")
                return
            if self._turns and alone_s > LOOKS_S:
                entry = StopNow()
            self._say(*step(self._guide, loop, entry))
            state, turns = picture(self._guide, loop)
            with self._lock:
                self._state, self._turns = state, turns
            await asyncio.sleep(POLL_S)
        await self._save()

    async def _save(self) -> None:
        result = self._guide.result
        if result is None:
            return

        try:
            await asyncio.to_thread(save, result, self._path)
        except (OSError, ConfigError) as fault:
            self._say(f"It cannot be saved: {fault}")
        else:
            self._say(saved_in(self._path))

    def _say(self, *lines: str) -> None:
        with self._lock:
            self._lines.extend(lines)
