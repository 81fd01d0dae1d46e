"""A sitting in simulated time: the bench with its simulated rotor, and a person who answers at once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.station import Station
from rotator.calibrating.answers import from_line
from rotator.calibrating.rig import Bench, NorthBench
from rotator.config.load import parse
from rotator.config.model import Config

PERIOD_S = 0.05
LONGEST_S = 1200.0
QUIET = "[sim]\nbus_takes_time = false\n"


class Sitting:
    """`counts`: where counted axes are kept; None: they know their place. `bad_luck`: a fault from the beginning."""

    bench: Any

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
            assert self.world is not None
            self.world.inject(bad_luck)
        self._sit_down(config)
        self.wait(0.5)

    def _sit_down(self, config: Config) -> None:
        self.bench = Bench(config, self.axis, self.station, self.clock)

    @property
    def guide(self) -> Any:
        return self.bench.guide

    @property
    def text(self) -> str:
        return "\n".join(self.said)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            self._cycle()

    def say(self, *lines: str) -> str:
        """Give each answer when it is its turn, as lines typed ahead; returns what was said since."""
        before = len(self.said)
        for line in lines:
            self._until_ready(line)
            self.said += self.bench.step(from_line(line))
        self._until_ready("")
        return "\n".join(self.said[before:])

    def now(self, line: str) -> None:
        """An answer at this very moment, as a key."""
        self.said += self.bench.step(from_line(line))

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
        self.bench.loop.cycle()
        if not self.guide.ended:
            self.said += self.bench.step()


class NorthSitting(Sitting):
    """With the compass, which is looked at ten times a second. `kept`: the file of what it has learnt."""

    def __init__(self, config: Config, *, kept: Path | None = None, **rest: Any) -> None:
        self._kept = kept
        self._cycles = 0
        super().__init__(config, **rest)

    def _sit_down(self, config: Config) -> None:
        self.bench = NorthBench(config, self.station, self.clock, self.clock.sleep, kept=self._kept)

    def _cycle(self) -> None:
        self._cycles += 1
        if self._cycles % 2:
            self.bench.compass.look()
        super()._cycle()


@pytest.fixture
def sit() -> Callable[..., Sitting]:
    """A sitting at the azimuth (or another axis) of a simulated rotor, standing at 200° and 60°."""

    def start(text: str = "", axis: Axis = Axis.AZIMUTH, **rest: Any) -> Sitting:
        return Sitting(parse(text + QUIET, "test"), axis, **rest)

    return start


@pytest.fixture
def sit_with_compass() -> Callable[..., NorthSitting]:
    def start(text: str, **rest: Any) -> NorthSitting:
        return NorthSitting(parse(text + QUIET, "test"), **rest)

    return start
