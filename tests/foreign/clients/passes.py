"""A satellite that passes now, and the judgement whether the antenna stays with it while a foreign program tracks.

Knows the orbit of the test and the simulated world. Knows no program, and does not ask the box.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta

from tests.gpredict.sky import Satellite, Station, apart_deg
from tests.machines.shack import Shack

HOME = Station(latitude_deg=50.0, longitude_deg=10.0)
PASS_S = 25.0
OFF_DEG = 4.6 + 0.8 + 0.8
"""The box's tolerance with backlash and noise; a fast motor on a busy machine; the test's orbit, which is a circle."""


def passing() -> Satellite:
    """North of the station and high, half a degree a second, over the seam at 360."""
    return Satellite("PASS", Station(53.0, 10.0), datetime.now(UTC) + timedelta(seconds=25), period_min=100.0)


def stays_with(box: Shack, satellite: Satellite, own_deg: float, alive: Callable[[], object]) -> None:
    """For PASS_S the antenna is never farther from the satellite than it may be, and goes with it.

    `own_deg`: by how much the program itself lets the antenna be off. `alive` is called again and again.
    """
    most_deg = OFF_DEG + own_deg

    def off_deg() -> float:
        alive()
        return apart_deg(box.world().antenna_deg, satellite.direction(HOME, datetime.now(UTC)))

    box.until(lambda world: off_deg() < most_deg and world.drives == (0, 0), "it comes to the satellite")
    begun_s, begun_deg = time.monotonic(), box.world().antenna_deg
    box.until(lambda _world: off_deg() > most_deg or time.monotonic() > begun_s + PASS_S, "the pass")
    assert off_deg() <= most_deg, "it lost the satellite"
    assert apart_deg(begun_deg, box.world().antenna_deg) > most_deg, "nothing was to be followed"
