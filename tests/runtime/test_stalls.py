"""The whole program stands still for a moment, between any two of its looks at the clock, while a motor runs.

A busy or suspended computer does that. The guard stands still too, so the relay stays closed until the program goes on.
What it says then must be true: that it was late, and never that a relay has welded. Then it goes on by itself.
"""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import Axis
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop
from tests.tables import every_row

PERIOD_S = 0.05
LINK = Source("gs232b", 1)
LOOK_S = 3.0
"""A loop that has run so long has seen both axes stand: before that it closes no relay."""
LATE_S = 0.6
TRUE = {FaultKind.CONTROL_LATE, FaultKind.SENSOR_LATE}


class StallingClock:
    """Gives the time of `clock`. At call number `at` the program stands still for `stall_s`: `before` or after it has
    the time."""

    def __init__(self, clock: SimClock) -> None:
        self._clock = clock
        self.calls, self.at, self.stall_s, self.before = 0, 0, 0.0, False

    def __call__(self) -> float:
        self.calls += 1
        stands = self.calls == self.at
        if stands and self.before:
            self._clock.sleep(self.stall_s)
        now_s = self._clock()
        if stands and not self.before:
            self._clock.sleep(self.stall_s)
        return now_s


class Stalled:
    """A box on relays whose guard stands still with it."""

    def __init__(self) -> None:
        self.time = SimClock()
        self.clock = StallingClock(self.time)
        config = Config()
        self.station = Station(config, self.time, self.time.sleep, (100.0, 20.0))
        assert isinstance(self.station.world, SimRelayPotRotor)
        self.world = self.station.world
        self.loop = ControlLoop(build_controller(config), self.station.rotor, self.clock, PERIOD_S)
        self.said: set[FaultKind] = set()
        """Every fault up to now."""
        self.run(LOOK_S)

    def run(self, seconds: float) -> None:
        end_s = self.time() + seconds
        while self.time() < end_s:
            cycle_s = self.time()
            self.loop.cycle()
            self.said |= self.faults()
            self.time.sleep_until(cycle_s + PERIOD_S)

    def faults(self) -> set[FaultKind]:
        axes = (self.loop.status.axis(axis) for axis in Axis)
        return {axis.fault.kind for axis in axes if axis.fault is not None}


@pytest.mark.long
@every_row(
    ("stall_s", "runs_s", "before"),
    [
        (0.2, 0.3, True),
        (0.2, 4.0, False),
        (0.45, 1.5, True),
        (0.7, 0.3, False),
        (0.7, 4.0, True),
        (1.2, 1.5, False),
        (3.0, 0.3, True),
        (3.0, 4.0, False),
    ],
)
def test_wherever_it_stands_still_it_says_no_more_than_that_it_was_late(
    stall_s: float, runs_s: float, before: bool
) -> None:
    call, last = 1, 1
    while call <= last:
        box = Stalled()
        box.loop.post(LINK, Aim(350.0, 90.0))
        box.run(runs_s)
        assert box.world.drives() == (1, 1)
        begun = box.clock.calls
        box.clock.at, box.clock.stall_s, box.clock.before = begun + call, stall_s, before
        box.run(2 * PERIOD_S)
        last = box.clock.calls - begun
        box.run(LOOK_S)
        said = box.said
        assert said <= TRUE, f"call {call}: {said}"
        assert said or stall_s < LATE_S, f"call {call}: it says nothing of {stall_s} s"
        # It has passed, and all was seen in order since: nobody has to come before the next order.
        box.loop.post(LINK, Aim(0.0, 0.0))
        box.run(LOOK_S)
        assert (box.world.drives(), box.faults()) == ((-1, -1), set()), f"call {call}"
        box.station.close()
        call += 1
