"""What does not change while the box runs: ranges, beam, horizon, sectors, its place.

Knows a mount and a place, and makes plain values of them. Knows no HTTP and no browser.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from typing_extensions import TypedDict

from hw.ports import Axis
from rotator import __version__
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.status import Status
from rotator.web.schema import Pair, the


@dataclass(frozen=True, slots=True)
class Station:
    """`tolerances_deg`: of azimuth and elevation."""

    mount: Mount
    beam_deg: float
    tolerances_deg: tuple[float, float]
    where: tuple[float, float] | None
    """Latitude and longitude; None: not known."""
    calibrates: str
    """The axis that is calibrated now; empty: none."""


_Range = TypedDict("_Range", {"min_deg": float, "max_deg": float, "fitted": Annotated[bool, the("it has this axis")]})
_Sector = TypedDict("_Sector", {"name": str, "azimuth": Pair, "elevation": Pair})


class BoxFacts(TypedDict):
    version: str
    command: Annotated[str, the("how a person at the box, in its folder, types this program")]
    simulated: Annotated[bool, the("nothing real turns")]
    beam_deg: Annotated[float, the("how wide the antenna sees")]
    where: Annotated[Pair | None, the("latitude and longitude, to a whole degree for who is not paired")]
    calibrates: Annotated[str, the("the axis that is calibrated now; empty: none")]
    azimuth: _Range
    elevation: _Range
    tolerance_deg: Annotated[Pair, the("of azimuth and elevation: so near is at the target")]
    park: Annotated[Pair, the("azimuth and elevation")]
    horizon: Annotated[Sequence[Pair], the("azimuth, and the least elevation there")]
    sectors: Annotated[Sequence[_Sector], the("where the antenna may not go")]


def command(started: str) -> str:
    """`rotator` where the shell finds it; else the path by which the program was started, as `.venv/bin/rotator`."""
    path = Path(started)
    if path.name != "rotator" or shutil.which("rotator"):
        return "rotator"
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else started


def box(station: Station, status: Status, *, stranger: bool) -> BoxFacts:
    """The range, the horizon, the sectors: for the browser's one request. A stranger learns the place to a degree."""
    mount = station.mount
    exact = station.where
    return {
        "version": __version__,
        "command": command(sys.argv[0]),
        "simulated": status.simulated,
        "beam_deg": station.beam_deg,
        "where": [round(deg) for deg in exact] if exact and stranger else exact,
        "calibrates": station.calibrates,
        "azimuth": _range(mount.azimuth.shown, fitted=Axis.AZIMUTH in mount.fitted),
        "elevation": _range(mount.elevation, fitted=Axis.ELEVATION in mount.fitted),
        "tolerance_deg": station.tolerances_deg,
        "park": [mount.park_azimuth_deg, mount.park_elevation_deg],
        "horizon": list(mount.horizon),
        "sectors": [
            {
                "name": sector.name,
                "azimuth": [sector.azimuth.min_deg, sector.azimuth.max_deg],
                "elevation": [sector.elevation.min_deg, sector.elevation.max_deg],
            }
            for sector in mount.sectors
        ],
    }


def _range(limits: Range, *, fitted: bool) -> _Range:
    return {"min_deg": limits.min_deg, "max_deg": limits.max_deg, "fitted": fitted}
