"""What the controller is given once, at the start: both axes, the mount, the times of the loop. Knows only values."""

from __future__ import annotations

from dataclasses import dataclass

from rotator.control.axis.settings import AxisSettings
from rotator.control.sky.mount import Mount
from rotator.orders import Mode
from rotator.status import Latch


@dataclass(frozen=True, slots=True)
class Settings:
    azimuth: AxisSettings
    elevation: AxisSettings
    mount: Mount
    period_s: float = 0.05
    lease_s: float = 0.25
    """How long a drive command lives unless renewed: how long a hung bus can keep a motor running."""
    simulated: bool = False
    park_after_s: float = 0.0
    """Park when no order has moved the antenna for so long; 0: never."""
    on_sky: bool = True
    """Whether the tolerance is on the sky; False: in degrees of each axis."""
    mode: Mode = Mode.AUTO
    """The mode until a front panel reports its switch. With a mode switch it is PARK: nothing moves before that."""
    latch: Latch | None = None
    """The stop that was latched when the program ended; None: none was."""
    attended: bool = False
    """A person stands by, as for a calibration: axes of which no angle is known yet are jogged near a sector too."""
