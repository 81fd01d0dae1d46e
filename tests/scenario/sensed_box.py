"""A whole box from the text of its file, in simulated time: real drivers on simulated chips, and the control loop.

Knows time and orders. Knows nothing of which sensors the file names.
"""

from __future__ import annotations

from typing import Any

from firmware_sim.clock import SimClock
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop

STEP_S = 0.05


class Box:
    """The box has looked at its still antenna when it is ready. `start_deg`: where the antenna stands then."""

    def __init__(self, text: str, start_deg: tuple[float, float] = (40.0, 20.0)) -> None:
        config = parse(text, "box")
        self.clock = SimClock()
        self.station = Station(config, self.clock, self.clock.sleep, start_deg, add_alarm=self.clock.add_alarm)
        self.world: Any = self.station.world
        self.loop = ControlLoop(build_controller(config), self.station.rotor, self.clock, STEP_S)
        self.wait(2.0)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / STEP_S)):
            self.clock.sleep(STEP_S)
            self.loop.cycle()

    def aim(self, azimuth_deg: float, elevation_deg: float, seconds: float = 60.0) -> None:
        self.loop.post(Source("test"), Aim(azimuth_deg, elevation_deg))
        self.wait(seconds)
