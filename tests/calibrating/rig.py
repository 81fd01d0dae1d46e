"""A calibration in simulated time: the rig on a simulated rotor, and an operator who answers at once."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.simulation import simulated_boom
from rotator.assembly.station import Station
from rotator.calibrating.entries import from_line
from rotator.calibrating.receiver import Receiver, Strength
from rotator.calibrating.rig import AxisRig, NorthRig
from rotator.calibrating.sky_rig import SkyRig
from rotator.config.model import Config
from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.pointing_model import PERFECT
from rotator.orbits.sight import Sight, Target
from rotator.orbits.targets import Fixed
from rotator.store.state import State

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

    def with_the_next(self, line: str) -> None:
        """An entry that comes together with the next status."""
        self.clock.sleep(PERIOD_S)
        self.rig.loop.cycle()
        self.now(line)

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
    """With the compass, read ten times a second. `corrections`: what remembers its own corrections."""

    def __init__(self, config: Config, *, corrections: State | None = None, **rest: Any) -> None:
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


class Told(Receiver):
    """A receiver whose strength comes from a function."""

    def __init__(self, told: Callable[[], Strength | None]) -> None:
        super().__init__(("", 0), lambda: 0.0)
        self.latest = told  # type: ignore[method-assign]

    def start(self) -> None:
        """It needs no thread."""

    def stop(self) -> None:
        """It has none."""


Hears = Callable[[Callable[[], float], Callable[[], float]], Callable[[], Strength | None]]
"""Makes a receiver of a clock, and of how far the boom points from the target."""


class SkyCalibration(Calibration):
    """At a target on the sky. `look` sets the target's direction: by it the operator steers, as by a signal.

    `hears`: the receiver; None: there is none. `target`: in place of a fixed direction.
    """

    rig: SkyRig

    def __init__(
        self,
        config: Config,
        direction_deg: tuple[float, float],
        *,
        hears: Hears | None = None,
        target: Target | None = None,
        **rest: Any,
    ) -> None:
        self._hears = hears
        self._look: Target = target or Fixed("the beacon", Sight(*direction_deg, 1.0))
        super().__init__(config, **rest)

    def _build_rig(self, config: Config) -> None:
        self.boom = simulated_boom(config)
        receiver = Told(self._hears(self.clock, lambda: math.hypot(*self.off_deg()))) if self._hears else None
        self.rig = SkyRig(config, self.station, self.clock, self, self._utc, receiver=receiver)

    def _utc(self) -> float:
        return 1_780_000_000.0 + self.clock()

    @property
    def name(self) -> str:
        return self._look.name

    def sight(self, utc_s: float) -> Sight:
        return self._look.sight(utc_s)

    def late_s(self, _utc_s: float) -> float:
        return 0.0

    def look(self, azimuth_deg: float, elevation_deg: float) -> None:
        """The target is there from now on."""
        self._look = Fixed("the beacon", Sight(azimuth_deg, elevation_deg, 1.0))
        self.wait(PERIOD_S)

    def off_deg(self) -> tuple[float, float]:
        """How far to the right of the boom, and above it, the target truly is."""
        seen = self._look.sight(self._utc())
        there = self.boom(*self.world.antenna())
        return SkyPoint(*there, seen.azimuth_deg, seen.elevation_deg).miss(PERFECT)

    def centre(self, within_deg: float = 0.3) -> None:
        """Steer as a person does: sideways, then up or down, until it is in the middle."""
        for _ in range(60):
            right, above = self.off_deg()
            if math.hypot(right, above) <= within_deg:
                return
            flat = max(0.2, math.cos(math.radians(self._look.sight(self._utc()).elevation_deg)))
            # A motor of 20°/s² speeds up and brakes: the way goes with the square of the time.
            if abs(right) >= abs(above):
                self.say(f"{'r' if right > 0 else 'l'} {math.sqrt(abs(right) / flat / 20):.3f}")
            else:
                self.say(f"{'u' if above > 0 else 'd'} {math.sqrt(abs(above) / 20):.3f}")
            self.wait(1.0)
        raise AssertionError(f"never centred: {self.off_deg()}")
