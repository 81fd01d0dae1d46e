"""A satellite that passes now, and the judgement whether the antenna stays with it while a foreign program tracks.

Knows the orbit of the test and the simulated world. Knows no program, and does not ask the box.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta

from tests.gpredict.sky import Satellite, Station, apart_deg
from tests.machines.shack import Shack

HOME = Station(latitude_deg=50.0, longitude_deg=10.0)
OFF_DEG = 4.6 + 0.8 + 1.0
"""The box's tolerance with backlash and noise; a fast motor on a busy machine; the test's orbit, which is a circle."""


def passing() -> Satellite:
    """North of the station and high, some 0.8 degrees a second, over the seam at 360."""
    return Satellite("PASS", Station(53.0, 10.0), datetime.now(UTC) + timedelta(seconds=25), period_min=96.0)


def stays_with(box: Shack, satellite: Satellite, own_deg: float, alive: Callable[[], object]) -> None:
    """While the satellite goes twice as far as the antenna may be off, the antenna is never farther from it than that.

    `own_deg`: by how much the program itself lets the antenna be off. `alive` is called again and again.
    """
    most_deg = OFF_DEG + own_deg

    def place() -> tuple[float, float]:
        return satellite.direction(HOME, datetime.now(UTC))

    def off_deg() -> float:
        alive()
        return apart_deg(box.world().antenna_deg, place())

    box.until(lambda world: off_deg() < most_deg and world.drives == (0, 0), "it comes to the satellite")
    first = place()
    box.until(lambda _world: off_deg() > most_deg or apart_deg(first, place()) > 2 * most_deg, "the pass")
    assert off_deg() <= most_deg, "it lost the satellite"
