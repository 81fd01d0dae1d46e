"""`[azimuth] endless = true`: an azimuth that turns on and on, by slip rings, without an end anywhere.

Its scale never ends. Where a sensor knows the angle within a turn, whole turns are added (`hw/sensors/turns.py`), so
that the angle goes on past north; a count and a moteus go on by themselves. A target is the nearest of its turns
(`control/going_round.py`), and the status shows 0 to 360 again. So no law, no watch and no plan knows of north: the
range is only too wide to be met ever. Nothing is put back by whole turns later: a number of degrees is large enough for
a life of turning, and a scale that jumped would have to be told to everything that remembers an angle.

Knows which kinds of rotor and sensor can do that; and which axis may have a sensor that feels gravity, or the earth's
magnetic field. Knows no motor and no chip.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable, Azimuth, Elevation
from rotator.config.kinds.kind import Kind
from rotator.config.mount import MountTable
from rotator.config.sensors import COMPASSES, TILTS, Angle

MAGNET = '[azimuth.sensor] kind = "as5600"'


def in_turns(angle: Angle) -> Angle:
    """How such an axis knows its angle: a whole turn of a magnet is 360°, which needs no calibration."""
    if angle.pot or angle.in_degrees:
        return angle
    return replace(angle, in_degrees=True, by="told by its magnet")


def endless_faults(
    axes: Mapping[Axis, AxisTable],
    kind: Kind,
    name: str,
    angle_of: Callable[[Axis], Angle],
    switches: Iterable[str],
) -> Iterator[str]:
    """Why an axis cannot be one without ends, one sentence each. `name`: of the kind of rotor."""
    azimuth, elevation = axes.get(Axis.AZIMUTH), axes.get(Axis.ELEVATION)
    if elevation is not None and elevation.endless:
        yield "elevation.endless: only an azimuth turns without ends: leave it out"
    if azimuth is None or not azimuth.endless:
        return
    angle = angle_of(Axis.AZIMUTH)
    if (azimuth.min_deg, azimuth.max_deg) != (0.0, 360.0):
        yield "azimuth.endless: an axis without ends has no limits: leave azimuth.min_deg and azimuth.max_deg out"
    if angle.pot:
        yield f"azimuth.endless: a pot ends, or has a gap, in each turn: fit a magnet over a chip, {MAGNET}"
    elif azimuth.sensor.kind in COMPASSES:
        yield f"azimuth.endless: a compass learns its iron between two ends: fit a magnet over a chip, {MAGNET}"
    elif kind.switched and angle.source is not AngleSource.MEASURED:
        yield (
            f"azimuth.endless: rotor.type = {name} begins at an end stop, and an axis without ends has none: fit a "
            f"magnet over a chip, {MAGNET}"
        )
    elif not kind.switched and (not kind.endless or azimuth.sensor.kind != "own"):
        yield f"azimuth.endless: rotor.type = {name} has ends of its own: it would turn back there, the long way"
    elif kind.homes(Axis.AZIMUTH):
        yield "azimuth.endless: an axis without ends has none at which homing could end: leave homing out"
    if azimuth.calibration is not None:
        yield "azimuth.endless: its sensor tells degrees without a table: leave azimuth.calibration out"
    for key in switches:
        if key.startswith(Axis.AZIMUTH.value):
            yield f"azimuth.endless: an axis without ends has no limit switch: leave limits.{key} out"


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
