"""A sitting in simulated time: the bench with its simulated rotor, and a person who answers at once."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.world import World
from hw.ports import Axis
from rotator.calibrating.answers import from_line
from rotator.calibrating.guide import Guide
from rotator.commissioning import Bench
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.station import Station

PERIOD_S = 0.05
LONGEST_S = 30.0
QUIET = "[sim]\nbus_takes_time = false\n"


class Sitting:
    def __init__(self, config: Config, axis: Axis = Axis.AZIMUTH) -> None:
        self.clock = SimClock()
        station = Station(config, self.clock, self.clock.sleep, (200.0, 60.0), add_alarm=self.clock.add_alarm)
        assert station.world is not None
        self.world: World = station.world
        self.bank = station.rotor.bank
        self.axis = axis
        self.bench = Bench(config, axis, station, self.clock)
        self.said: list[str] = []
        self.wait(0.5)

    @property
    def guide(self) -> Guide:
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
        part = self.world.azimuth if self.axis is Axis.AZIMUTH else self.world.elevation
        part.motor.advance(self.clock())
        return part.motor.shaft_deg

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


@pytest.fixture
def sit() -> Callable[..., Sitting]:
    """A sitting at the azimuth (or another axis) of a simulated rotor, standing at 200° and 60°."""

    def start(text: str = "", axis: Axis = Axis.AZIMUTH) -> Sitting:
        return Sitting(parse(text + QUIET, "test"), axis)

    return start
