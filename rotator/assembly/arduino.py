"""Builds the emulated Arduino that the box replaces, from the same file as the box.

Part of the composition root. Knows which key of the file is which property of its motors and pots. Does not know the
sketch: the simulator has it.
"""

from __future__ import annotations

from collections.abc import Callable

from firmware_sim.arduino.station import ArduinoStation
from firmware_sim.parts.pot import PotSpec
from rotator.assembly.simulated_axes import motor_spec
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.config.sim import SimAxisTable

__all__ = ["ArduinoStation", "arduino_station"]


def arduino_station(
    config: Config, clock: Callable[[], float], sleep: Callable[[float], None], start_deg: tuple[float, float]
) -> ArduinoStation:
    """The Arduino that the box replaces, with motors and ranges from the same file; its pots have no end resistors."""

    def pot(table: AxisTable, sim: SimAxisTable) -> PotSpec:
        return PotSpec(table.min_deg, table.max_deg, 0.0, 1.0, noise_deg=sim.pot_noise_deg, bow_deg=sim.pot_bow_deg)

    azimuth, elevation, sim = config.azimuth, config.elevation, config.sim
    return ArduinoStation(
        clock,
        sleep,
        motor_spec(azimuth, sim.azimuth),
        motor_spec(elevation, sim.elevation),
        azimuth_pot=pot(azimuth, sim.azimuth),
        elevation_pot=pot(elevation, sim.elevation),
        azimuth_start_deg=start_deg[0],
        elevation_start_deg=start_deg[1],
    )
