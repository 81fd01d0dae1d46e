"""MacDoppler's broadcasts: `[AzEl Rotor Report:Azimuth:39.00, Elevation:0.00, SatName:XW-2C]`, without answers.

Knows this report, its codec, and that it is an order. Reports for radios are skipped. Does not know sockets: one
`receive` is one datagram. Source: programs that connect MacDoppler to rotors (see docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rotator.protocols.aiming import aim, degrees
from rotator.protocols.session import Box, Talk

_REPORT = re.compile(
    r"\[AzEl Rotor Report:Azimuth:([-+.,eE\d ]*), *Elevation:([-+.,eE\d ]*)(?:, *SatName:([^\r\n]*))?\][\s\0]*$"
)


@dataclass(frozen=True, slots=True)
class SatelliteReport:
    """The direction of the satellite."""

    azimuth_deg: float
    elevation_deg: float
    satellite: str = ""


def parse(datagram: bytes) -> SatelliteReport | None:
    """The report at the end of a datagram, after a number and the Mac's name; None: there is none."""
    found = _REPORT.search(datagram.decode("latin-1"))
    if not found:
        return None
    azimuth_deg, elevation_deg = degrees(found[1]), degrees(found[2])
    if azimuth_deg is None or elevation_deg is None:
        return None
    return SatelliteReport(azimuth_deg, elevation_deg, found[3] or "")


class MacDopplerSession(Talk):
    """MacDoppler on one Mac: it sends the satellite's direction and takes no answers."""

    def __init__(self, box: Box) -> None:
        self._box = box

    def receive(self, data: bytes) -> list[bytes]:
        report = parse(data)
        if report:
            self._box.order(aim(report.azimuth_deg, report.elevation_deg))
        elif b"[AzEl Rotor" in data:
            self._box.note_refused(data)
        return []
