"""A line after each move on a link, `AZ = 235, EL = 25`, as KO6TH's controller prints it: an option of a GS-232 link.

Knows when the antenna has moved and stands again. Wraps the link's own session, whose answers go through unchanged.
Knows no command.
"""

from __future__ import annotations

from rotator.protocols.aiming import bearing, whole
from rotator.protocols.session import Box, Session

LOOK_S = 0.25
"""The time between two looks at the status."""


class MoveReport:
    """Begins with the first bytes of the program at the other end: before those no link knows that there is one."""

    every_s = LOOK_S

    def __init__(self, session: Session, box: Box) -> None:
        self._session = session
        self._box = box
        self._heard = False
        self._moved = False
        """The antenna moves, or has moved since the last line."""

    @property
    def idle_s(self) -> float | None:
        return self._session.idle_s

    @property
    def closed(self) -> bool:
        return self._session.closed

    def receive(self, data: bytes) -> list[bytes]:
        self._heard = True
        return self._session.receive(data)

    def idle(self) -> list[bytes]:
        return self._session.idle()

    def finish(self) -> list[bytes]:
        return self._session.finish()

    def beat(self) -> list[bytes]:
        """The line, when the antenna stands after a move."""
        status = self._box.status()
        if not self._heard or status.moving:
            self._moved = self._heard
            return []
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        if not self._moved or azimuth_deg is None or elevation_deg is None:
            return []
        self._moved = False
        return [f"AZ = {bearing(azimuth_deg)}, EL = {whole(elevation_deg)}\r\n".encode()]
