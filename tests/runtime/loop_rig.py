"""The control loop over the real drivers on a simulated station, in simulated time or in a thread of its own."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import AngleSensor, AngleSource, Axis
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.sources import Source
from rotator.rotors.relays import RelayRotor
from rotator.runtime.loop import ControlLoop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PERIOD_S = 0.05
LINK = Source("gs232b", 1)
PATIENCE_S = 20.0
LOOK_S = 3.0
"""A loop that has run so long has seen both axes stand: before that it closes no relay."""


class Rig:
    """A station with its guard as an alarm of the clock, and a control loop that is cycled by hand.

    `text`: of its file. `more`: of the control loop.
    """

    def __init__(self, text: str = "", clock: SimClock | None = None, **more: Any) -> None:
        self.clock = clock or SimClock()
        self.config = parse(text, "test")
        self.station = Station(self.config, self.clock, self.clock.sleep, (100.0, 20.0), add_alarm=self.clock.add_alarm)
        self.world: Any = self.station.world
        self.loop = ControlLoop(build_controller(self.config), self.station.rotor, self.clock, PERIOD_S, **more)

    def loop_with(self, sensors: Mapping[Axis, AngleSensor], period_s: float = PERIOD_S) -> ControlLoop:
        assert isinstance(self.station.rotor, RelayRotor)
        rotor = RelayRotor(self.station.rotor.bank, sensors)
        return ControlLoop(build_controller(self.config), rotor, self.clock, period_s)

    def run(self, seconds: float, loop: ControlLoop | None = None) -> None:
        end_s = self.clock() + seconds
        while self.clock() < end_s:
            cycle_s = self.clock()
            self.before_cycle()
            (loop or self.loop).cycle()
            self.clock.sleep_until(cycle_s + PERIOD_S)

    def before_cycle(self) -> None:
        """For what else happens at each cycle."""


class Hangs:
    """A sensor that goes well a few times and is then stuck in its reading until let go."""

    source = AngleSource.MEASURED

    def __init__(self, sensor: AngleSensor, times: int) -> None:
        self._sensor = sensor
        self._times = times
        self.stuck, self.let_go = threading.Event(), threading.Event()

    def read(self) -> float:
        self._times -= 1
        if self._times < 0:
            self.stuck.set()
            assert self.let_go.wait(PATIENCE_S)
        return self._sensor.read()


class Relays:
    """The motor relays of a simulated station, watched from another thread."""

    def __init__(self, world: SimRelayPotRotor) -> None:
        self._changed = threading.Condition()
        self._drives = (0, 0)
        self._world = world
        world.gpio.on_edges.append(self._see)

    def _see(self, _now_s: float, _changes: Mapping[int, bool]) -> None:
        with self._changed:
            self._drives = self._world.drives()
            self._changed.notify_all()

    def come_to(self, *drives: int) -> bool:
        with self._changed:
            return self._changed.wait_for(lambda: self._drives == drives, PATIENCE_S)


@contextmanager
def running(loop: ControlLoop) -> Iterator[None]:
    thread = threading.Thread(target=loop.run)
    thread.start()
    try:
        yield
    finally:
        loop.stop()
        thread.join(PATIENCE_S)
        assert not thread.is_alive()


def records(caplog: pytest.LogCaptureFixture, words: str) -> list[str]:
    return [record.message for record in caplog.records if words in record.message]
