"""Builds the simulated axes that a file describes: motors, pots, and where they stand at first.

Part of the composition root. Knows which key of the file is which property of a simulated part. Knows no driver, and
no kind of rotor: those are in `rotator.assembly.kinds`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from firmware_sim import world_file
from firmware_sim.parts.motor import MotorSpec
from firmware_sim.parts.pot import PotSpec
from firmware_sim.world_file import WorldState
from hw.ports import Axis, HardwareError
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.config.sim import SimAxisTable
from rotator.config.table import Point

SIM_CALIBRATION_RAW = (0.05, 0.95)
"""The simulated pot's reading at each end of the range. End resistors keep it away from 0 and 1."""
STOP_BEYOND_DEG = 2.0
"""The end stops stand a little beyond the range, as on a G-5500."""


@dataclass(eq=False)
class SimulatedAxes:
    """`clock` tells the time, `bus_sleep` lets it pass on the buses (None: transfers take none).

    `first_deg`: azimuth and elevation where the file does not say where the rotor stands at first.

    Raises HardwareError where the file of a kept world is damaged.
    """

    config: Config
    clock: Callable[[], float]
    bus_sleep: Callable[[float], None] | None
    first_deg: tuple[float, float]
    kept: WorldState | None = field(init=False)
    """The simulated world as the last run left it; None: it begins anew."""

    def __post_init__(self) -> None:
        self.kept = kept_world(self.config)

    def start_deg(self, axis: Axis) -> float:
        """The start angle, on the rotor's own scale."""
        table, configured_deg = self.config.axis(axis), self.sim(axis).start_deg
        place = 0 if axis is Axis.AZIMUTH else 1
        if self.kept is not None:
            # It comes before the file, and may be beyond the range.
            return self.kept.rests_deg[place]
        first_deg = self.first_deg[place]
        if self.config.endless(axis):
            return (first_deg if configured_deg is None else configured_deg) % 360.0
        return min(max(first_deg if configured_deg is None else configured_deg, table.min_deg), table.max_deg)

    def sim(self, axis: Axis) -> SimAxisTable:
        return self.config.sim.of(axis)

    def motor(self, axis: Axis, stop_low_deg: float | None = None, stop_high_deg: float | None = None) -> MotorSpec:
        if self.config.endless(axis):
            stop_low_deg, stop_high_deg = -math.inf, math.inf
        return motor_spec(self.config.axis(axis), self.sim(axis), stop_low_deg, stop_high_deg)

    def pot(self, axis: Axis) -> PotSpec:
        sim = self.sim(axis)
        (low_raw, low_deg), (high_raw, high_deg) = self._pot_line(axis)
        return PotSpec(
            low_deg,
            high_deg,
            low_raw,
            high_raw,
            noise_deg=sim.pot_noise_deg,
            bow_deg=sim.pot_bow_deg,
        )

    def _pot_line(self, axis: Axis) -> tuple[Point, Point]:
        """Reading and angle of the pot at both ends: in a kept world those of the file, as on the builder's mast."""
        table = self.config.axis(axis)
        if table.calibration:
            return table.calibration[0], table.calibration[-1]
        low_raw, high_raw = SIM_CALIBRATION_RAW
        return (low_raw, table.min_deg), (high_raw, table.max_deg)


def motor_spec(
    table: AxisTable, sim: SimAxisTable, stop_low_deg: float | None = None, stop_high_deg: float | None = None
) -> MotorSpec:
    return MotorSpec(
        speed_dps=sim.speed_dps,
        lag_s=sim.lag_s,
        relay_delay_s=sim.relay_delay_s,
        backlash_deg=sim.backlash_deg,
        stop_low_deg=table.min_deg - STOP_BEYOND_DEG if stop_low_deg is None else stop_low_deg,
        stop_high_deg=table.max_deg + STOP_BEYOND_DEG if stop_high_deg is None else stop_high_deg,
    )


def kept_world(config: Config) -> WorldState | None:
    """The simulated world as the last run left it; None: it begins anew. Raises HardwareError for a damaged file."""
    if not config.simulated or config.sim.world is None:
        return None
    try:
        return world_file.read(Path(config.sim.world))
    except (OSError, ValueError) as fault:
        raise HardwareError(f"sim.world: {fault}; remove the file, then the simulation begins anew") from fault
