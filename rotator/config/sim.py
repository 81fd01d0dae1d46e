"""The tables [sim], [sim.azimuth] and [sim.elevation]: the motors and pots of the simulated rotor.

Knows their keys and defaults. Does not know the simulator.
"""

from __future__ import annotations

from pydantic import Field

from rotator.config.mount import MountTerms
from rotator.config.table import FilePath, PerAxis, Table


class SimAxisTable(Table):
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's full speed."""
    lag_s: float = Field(0.15, ge=0, le=5)
    """The motor's first-order lag: it coasts by speed × lag."""
    relay_delay_s: float = Field(0.015, ge=0, le=1)
    """The time from coil to contact."""
    backlash_deg: float = Field(0.5, ge=0, le=30)
    """Total play between the shaft with the pot and the antenna."""
    pot_noise_deg: float = Field(0.1, ge=0, le=30)
    """Noise of the pot, rms."""
    pot_bow_deg: float = Field(0.0, ge=-30, le=30)
    """How far the pot leaves a straight line, at mid-travel."""
    start_deg: float | None = None
    """The angle at the start. Left out: where it stood last, at first 0; in a rehearsal the start of the pass."""


class SimElevation(SimAxisTable):
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's full speed."""


class Sim(PerAxis, Table):
    azimuth: SimAxisTable = SimAxisTable.model_construct()
    """The simulated azimuth motor and pot."""
    elevation: SimElevation = SimElevation.model_construct()
    """The simulated elevation motor and pot."""
    mount: MountTerms = MountTerms.model_construct()
    """How the simulated mount really stands."""
    world: FilePath | None = None
    """A file with the true angles, from which the next run begins; the box then keeps its other files, as on a Pi."""
    bus_takes_time: bool = True
    """The simulated I2C bus is as slow as a real one."""
