"""A calibration that a browser guides: the box runs on with its page, and one axis is treated as never set up.

Knows the guide, the button that a person holds, and that a motor stands still where no browser looks on. Does not know
HTTP, nor who may press. The questions are those of `rotator calibrate`.
"""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from hw.ports import AngleSensor, Axis, Direction, FeelsField
from rotator.calibrating.entries import Entry, Keyboard, Press, StopNow
from rotator.calibrating.field_guide import FieldGuide
from rotator.calibrating.readings import SHARES
from rotator.calibrating.results import save, saved_in
from rotator.calibrating.rig import doing, page_guide, reading, step
from rotator.config.load import ConfigError
from rotator.config.model import Config
from rotator.exchange.orders import Jog
from rotator.runtime.loop import ControlLoop

POLL_S = 0.02
LOOKS_S = 1.0
"""A browser asks more often than this for what the guide says. One that does not has gone: the motor stops."""
MOST_REMARKS = 4
GONE_S = 300.0
"""After this time without a browser the calibration ends, and nothing of it is saved."""
SIMULATED = "This rotor is simulated, and may stand at a stop: then hold the button for some seconds first."
NOT_NOW = "the calibration turns it again after your answer"


class PageCalibration:
    """`path`: the file for the result. Raises HardwareError where this axis cannot be calibrated on the page."""

    def __init__(self, config: Config, axis: Axis, path: Path, clock: Callable[[], float]) -> None:
        self.axis = axis
        self._path = path
        self._clock = clock
        self._guide = page_guide(config, axis)
        if config.simulated:
            self._guide.remarks.append(SIMULATED)
        self._lock = threading.Lock()
        self._entries: deque[Entry] = deque(maxlen=16)
        self._reading, self._doing, self._fault = "", "", ""
        self._turns = False
        self._looked_s = clock()
        self._learnt: tuple[str, ...] = ()
        self._saved = False
        self._held_until_s: float | None = None
        """Until then the latest sign of the finger lets the motor turn. None: no button is held."""

    def press(self, keys: str, asked: int | None) -> None:
        """An answer, as it is typed in a terminal. `asked`: to which question; to another one than the latest it comes
        too late. Called from the page's thread."""
        keyboard = Keyboard()
        with self._lock:
            if asked in (None, self._guide.asked):
                self._entries += [entry for key in keys if (entry := keyboard.key(key)) is not None]

    def hold(self, jog: Jog) -> str:
        """A sign that a button is held, for as long as the jog lasts, or is held no more. Returns why nothing turns.

        Called from the page's thread."""
        with self._lock:
            if jog.direction is Direction.OFF or jog.seconds is None:
                if self._held_until_s is not None:
                    self._held_until_s = 0.0
                return ""
            if self._held_until_s is not None and self._fault:
                # A new press acknowledges it; that one which ran into it does not.
                self._held_until_s = None
                return self._fault
            if not self._guide.question.turns:
                return NOT_NOW
            self._held_until_s = self._clock() + jog.seconds
            self._entries.append(Press(jog.axis, jog.direction, jog.seconds))
            return ""

    def shown(self) -> dict[str, Any]:
        """What the guide asks, and that a browser looks on. Called from the page's thread."""
        guide, facts = self._guide, self._guide.facts
        with self._lock:
            self._looked_s = self._clock()
            stages, shares = guide.stages, facts.unit is SHARES
            choices = [asdict(choice) for choice in guide.question.choices]
            return {
                "axis": self.axis.value,
                "asked": guide.asked,
                "question": {**asdict(guide.question), "hint": list(guide.question.hint), "choices": choices},
                "stage": guide.stage,
                "step": stages.index(guide.stage) + 1 if guide.stage in stages else 0,
                "steps": len(stages),
                "remarks": list(guide.remarks[-MOST_REMARKS:]),
                "points": [list(point) for point in guide.points],
                "scale": [facts.lowest_reading, facts.highest_reading] if shares else [facts.min_deg, facts.max_deg],
                "degrees": not shares,
                "reading": self._reading,
                "doing": self._doing,
                "fault": self._fault,
                "turns": self._turns,
                "runs_s": guide.runs_s,
            }

    def outcome(self) -> dict[str, Any]:
        """What the page says when the calibration is over."""
        said, halfway = [*self._learnt, *self._guide.remarks], isinstance(self._guide, FieldGuide)
        return {"axis": self.axis.value, "saved": self._saved, "halfway": halfway, "said": said}

    async def run(self, loop: ControlLoop, sensors: Mapping[Axis, AngleSensor]) -> None:
        """Until the guide ends. Its result is saved then. The motor stands."""
        guide, sensor = self._guide, sensors.get(self.axis)
        while not guide.ended:
            if isinstance(guide, FieldGuide) and isinstance(sensor, FeelsField) and sensor.field_ut:
                guide.feel(sensor.field_ut)
            with self._lock:
                alone_s = self._clock() - self._looked_s
                if alone_s > GONE_S:
                    guide.remarks.append("No browser looks on any more: nothing is saved.")
                    return
                step(guide, loop, self._next(alone_s))
                axis = loop.status.axis(self.axis)
                self._reading, self._doing = reading(guide, axis), doing(guide, axis)
                self._fault, self._turns = str(axis.fault or ""), bool(axis.drive)
            await asyncio.sleep(POLL_S)
        await self._save()

    def _next(self, alone_s: float) -> Entry | None:
        released = self._held_until_s is not None and self._clock() > self._held_until_s
        if released:
            self._held_until_s = None
        if released or (self._turns and alone_s > LOOKS_S):
            self._entries.clear()
            return StopNow()
        return self._entries.popleft() if self._entries else None

    async def _save(self) -> None:
        if (result := self._guide.result) is None:
            return
        try:
            await asyncio.to_thread(save, result, self._path)
        except (OSError, ConfigError) as fault:
            self._guide.remarks.append(f"It cannot be saved: {fault}")
        else:
            # The last question was whether to save just this.
            self._learnt, self._saved = self._guide.question.hint, True
            self._guide.remarks = [saved_in(self._path)]
