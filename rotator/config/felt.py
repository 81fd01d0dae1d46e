"""Which axis may have a sensor that feels gravity, or the earth's magnetic field, and what a compass asks of the file.

Knows what such sensors cannot tell. Knows no chip.
"""

from __future__ import annotations

from collections.abc import Iterator

from rotator.config.axes import Azimuth, Elevation
from rotator.config.mount import MountTable
from rotator.config.sensors import COMPASSES, TILTS

TURN_DEG, GAP_DEG = 360.0, 10.0
"""Between the two ends of its range a compass must be able to tell one from the other."""


def felt_faults(
    azimuth: Azimuth, elevation: Elevation, mount: MountTable, name: str, *, switched: bool
) -> Iterator[str]:
    """One sentence each. `name`: of the kind of rotor; `switched`: relays switch its motors."""
    compass, gravity = azimuth.sensor.kind, elevation.sensor.kind
    if compass in TILTS:
        yield f'azimuth.sensor.kind = "{compass}": gravity tells no azimuth; it is for the elevation'
    if gravity in COMPASSES:
        yield f'elevation.sensor.kind = "{gravity}": a compass tells no elevation; it is for the azimuth'
    if compass not in COMPASSES or not azimuth.fitted:
        return
    key = f'azimuth.sensor.kind = "{compass}"'
    if not switched:
        yield (
            f"{key}: a compass is too coarse for rotor.type = {name}, which goes to an exact angle; it is for motors "
            "on relays"
        )
    if azimuth.max_deg - azimuth.min_deg > TURN_DEG - GAP_DEG and not azimuth.endless:
        yield (
            f"{key}: a compass cannot tell one turn from the next, nor one end of a whole turn from the other: "
            f"azimuth.max_deg must be {azimuth.min_deg + TURN_DEG - GAP_DEG:g} at most"
        )
    if mount.north != "magnetic":
        yield (
            f'{key}: a compass shows magnetic north: write [mount] north = "magnetic" and declination_deg, how far '
            "east of true north it points where you live"
        )
