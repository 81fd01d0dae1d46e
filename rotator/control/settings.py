"""What the controller is given once, at the start: both axes, the mount, the times of the loop. Knows only values."""

from __future__ import annotations

from dataclasses import dataclass

from rotator.control.axis.settings import AxisSettings
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import Mode
from rotator.exchange.status import Latch


@dataclass(frozen=True, slots=True)
class Settings:
    azimuth: AxisSettings
    elevation: AxisSettings
    mount: Mount
    period_s: float = 0.05
    lease_s: float = 0.25
    """A drive command that is not renewed ends after this time, so a hung bus keeps no motor running."""
    simulated: bool = False
    park_after_s: float = 0.0
    """Park when the last order was carried out this long ago; 0: never."""
    on_sky: bool = True
    """Whether the tolerance is on the sky; False: in degrees of each axis."""
    mode: Mode = Mode.AUTO
    """The mode until a front panel reports its switch. With a mode switch it is PARK: nothing moves before that."""
    latch: Latch | None = None
    """The stop that was latched when the program ended; None: nothing was latched."""
    attended: bool = False
    """A person stands by, as for a calibration: axes of which no angle is known yet are jogged near a sector too."""
