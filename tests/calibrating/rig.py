"""A calibration in simulated time: the rig on a simulated rotor, and an operator who answers at once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.station import Station
from rotator.calibrating.entries import from_line
from rotator.calibrating.rig import AxisRig, NorthRig
from rotator.config.model import Config

PERIOD_S = 0.05
LONGEST_S = 1200.0
QUIET = "[sim]\nbus_takes_time = false\n"


class Calibration:
    """`counts`: the file of the pulse counts; None: the axes know their angle. `bad_luck`: a fault from the start."""

    rig: Any

    def __init__(
        self,
        config: Config,
        axis: Axis = Axis.AZIMUTH,
        *,
        counts: Path | None = None,
        start_deg: tuple[float, float] = (200.0, 60.0),
        bad_luck: str = "",
    ) -> None:
        self.clock = SimClock()
        self.station = Station(
            config, self.clock, self.clock.sleep, start_deg, add_alarm=self.clock.add_alarm, counts=counts
        )
        self.world: Any = self.station.world
        self.axis = axis
        self.said: list[str] = []
        if bad_luck:
            assert self.station.world is not None
            self.station.world.inject(bad_luck)
        self._build_rig(config)
        self.wait(0.5)

    def _build_rig(self, config: Config) -> None:
        self.rig = AxisRig(config, self.axis, self.station, self.clock)

    @property
    def guide(self) -> Any:
        return self.rig.guide

    @property
    def text(self) -> str:
        return "\n".join(self.said)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            self._cycle()

    def say(self, *lines: str) -> str:
        """Give each line when its question is open, as lines typed ahead. Returns what was shown since."""
        before = len(self.said)
        for line in lines:
            self._until_ready(line)
            self.said += self.rig.step(from_line(line))
        self._until_ready("")
        return "\n".join(self.said[before:])

    def now(self, line: str) -> None:
        """An entry at this moment, as a key."""
        self.said += self.rig.step(from_line(line))

    def drive(self, key: str, presses: int) -> str:
        return self.say(*[key] * presses)

    def shaft_deg(self) -> float:
        return float(self.world.shafts()[0 if self.axis is Axis.AZIMUTH else 1])

    def moving(self) -> bool:
        return any(self.world.drives())

    def _until_ready(self, line: str) -> None:
        waited_s = 0.0
        while not self.guide.ended and not self.guide.ready(from_line(line)):
            self._cycle()
            waited_s += PERIOD_S
            assert waited_s < LONGEST_S, f"never ready for {line!r}: {self.guide.prompt}"

    def _cycle(self) -> None:
        self.clock.sleep(PERIOD_S)
        self.rig.loop.cycle()
        if not self.guide.ended:
            self.said += self.rig.step()


class NorthCalibration(Calibration):
    """With the compass, read ten times a second. `corrections`: the file with the compass's own corrections."""

    def __init__(self, config: Config, *, corrections: Path | None = None, **rest: Any) -> None:
        self._corrections = corrections
        self._cycles = 0
        super().__init__(config, **rest)

    def _build_rig(self, config: Config) -> None:
        self.rig = NorthRig(config, self.station, self.clock, self.clock.sleep, corrections=self._corrections)

    def _cycle(self) -> None:
        self._cycles += 1
        if self._cycles % 2:
            self.rig.compass.read()
        super()._cycle()
