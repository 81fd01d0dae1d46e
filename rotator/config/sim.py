"""The tables of the simulated rotor.

Knows the file's words for it. Knows nothing of how it is simulated.
"""

from __future__ import annotations

from pydantic import Field

from rotator.config.table import PerAxis, Table


class SimAxisTable(Table):
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's full speed."""
    lag_s: float = Field(0.15, ge=0, le=5)
    """First-order lag of the motor: it coasts speed × lag."""
    relay_delay_s: float = Field(0.015, ge=0, le=1)
    """From the coil to the contact."""
    backlash_deg: float = Field(0.5, ge=0, le=30)
    """Total play; the pot is on the shaft, the antenna beyond the play."""
    pot_noise_deg: float = Field(0.1, ge=0, le=30)
    """Noise of the pot, rms."""
    pot_bow_deg: float = Field(0.0, ge=-30, le=30)
    """How far the pot is off a straight line in the middle of its travel."""
    start_deg: float | None = None
    """Where the rotor stands at first; left out, at 0 (in a rehearsal, where the pass begins)."""


class SimElevation(SimAxisTable):
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's full speed."""


class Sim(PerAxis, Table):
    azimuth: SimAxisTable = SimAxisTable()
    """The simulated azimuth motor and pot."""
    elevation: SimElevation = SimElevation()
    """The simulated elevation motor and pot."""
    bus_takes_time: bool = True
    """The simulated I2C bus is as slow as a real one."""
