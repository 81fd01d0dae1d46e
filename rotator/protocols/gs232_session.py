"""One GS-232 connection: what each command makes the box do, and the answer.

Knows the meaning of the commands. Does not know the bytes (`gs232` does), nor how the box carries out an order.
"""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.orders import Aim, Calibrate, ClearTimed, Jog, LoadTimed, Order, RunTimed, Speed, Stop
from rotator.protocols import gs232
from rotator.protocols.gs232 import Command, Dialect, NotACommand
from rotator.protocols.lines import LineReader
from rotator.protocols.session import Box

_PLAIN_ORDERS: dict[str, Order] = {
    "R": Jog(Axis.AZIMUTH, Direction.PLUS),
    "L": Jog(Axis.AZIMUTH, Direction.MINUS),
    "U": Jog(Axis.ELEVATION, Direction.PLUS),
    "D": Jog(Axis.ELEVATION, Direction.MINUS),
    "A": Stop((Axis.AZIMUTH,)),
    "E": Stop((Axis.ELEVATION,)),
    "S": Stop(),
    "X1": Speed(1),
    "X2": Speed(2),
    "X3": Speed(3),
    "X4": Speed(4),
}
_CALIBRATIONS = {
    "O": Calibrate(Axis.AZIMUTH, high_end=False),
    "F": Calibrate(Axis.AZIMUTH, high_end=True),
    "O2": Calibrate(Axis.ELEVATION, high_end=False),
    "F2": Calibrate(Axis.ELEVATION, high_end=True),
}
_HELP = {"H": 1, "H2": 2, "H3": 3}


class Gs232Session:
    """GS-232 on one connection. `ack` is the answer to a command that asks no question: b"" or b"\\r"."""

    idle_s = None
    closed = False

    def __init__(self, box: Box, dialect: Dialect, *, ack: bytes = b"", may_calibrate: bool = False) -> None:
        self._box = box
        self._dialect = dialect
        self._ack = ack
        self._may_calibrate = may_calibrate
        self._lines = LineReader(gs232.MAX_LINE)
        azimuth = box.status().azimuth
        self._top_deg = (
            gs232.AZIMUTH_TOP_450_DEG
            if azimuth.max_deg - azimuth.min_deg > gs232.AZIMUTH_TOP_360_DEG
            else gs232.AZIMUTH_TOP_360_DEG
        )
        self._points = 0

    def receive(self, data: bytes) -> list[bytes]:
        replies = [self._answer(line) for line in self._lines.feed(data)]
        return [reply for reply in replies if reply]

    def idle(self) -> list[bytes]:
        return []

    def _answer(self, line: bytes | None) -> bytes:
        if line is None:
            return gs232.INVALID
        try:
            command = gs232.parse(line, self._dialect)
        except NotACommand:
            return gs232.INVALID
        return b"" if command is None else self._obey(command)

    def _obey(self, command: Command) -> bytes:
        match command.verb:
            case "C" | "B" | "C2":
                return self._position(command.verb)
            case "M" | "W":
                return self._go(command)
            case "T" if self._list_length():
                return self._order(RunTimed())
            case "N" if points := self._list_length():
                status = self._box.status()
                return gs232.count_reply(status.timed_point if status.timed_points == points else 1, points)
            case "H" | "H2" | "H3" as verb:
                return gs232.help_reply(_HELP[verb], self._dialect)
            case "P36":
                self._top_deg = gs232.AZIMUTH_TOP_360_DEG
                return b"Mode 360 degree\r\n"
            case "P45":
                self._top_deg = gs232.AZIMUTH_TOP_450_DEG
                return b"Mode 450 degree\r\n"
            case "Z":
                return self._centre()
            case "O" | "F" | "O2" | "F2" as verb if self._may_calibrate and not self._box.status().moving:
                return self._order(_CALIBRATIONS[verb])
            case verb if verb in _PLAIN_ORDERS:
                return self._order(_PLAIN_ORDERS[verb])
        return gs232.INVALID

    def _order(self, order: Order) -> bytes:
        return gs232.INVALID if self._box.order(order) else self._ack

    def _go(self, command: Command) -> bytes:
        azimuths_deg = [azimuth for azimuth, _ in command.points]
        if command.azimuth_deg is not None:
            azimuths_deg.append(command.azimuth_deg)
        if any(azimuth > self._top_deg for azimuth in azimuths_deg):
            return gs232.INVALID
        if command.verb == "M":
            # Every M clears the old list. An M without numbers does only that, and a real unit answers `?>`.
            self._points = 0
            self._box.order(ClearTimed())
        if command.interval_s is not None:
            reply = self._order(LoadTimed(float(command.interval_s), command.points))
            self._points = 0 if reply == gs232.INVALID else len(command.points)
            return reply
        if command.azimuth_deg is None:
            return gs232.INVALID
        return self._order(Aim(command.azimuth_deg, command.elevation_deg))

    def _list_length(self) -> int:
        """The length of the box's list, or of one just sent on this connection that the box has not taken yet."""
        return self._points or self._box.status().timed_points

    def _position(self, verb: str) -> bytes:
        status = self._box.status()
        azimuth_deg = self._shown(status.azimuth.angle_deg or 0.0)
        elevation_deg = status.elevation.angle_deg or 0.0
        match verb:
            case "C":
                return gs232.azimuth_reply(self._dialect, azimuth_deg)
            case "B":
                return gs232.elevation_reply(self._dialect, elevation_deg)
            case _:
                return gs232.position_reply(self._dialect, azimuth_deg, elevation_deg)

    def _shown(self, axis_deg: float) -> float:
        """A 450° unit counts on through its overlap; a 360° unit starts again at north."""
        azimuth = self._box.status().azimuth
        # Noise of the pot just beyond an end of the range counts as that end, not as one turn away.
        axis_deg = min(max(axis_deg, azimuth.min_deg), azimuth.max_deg)
        return axis_deg if 0 <= gs232.whole(axis_deg) <= self._top_deg else axis_deg % 360

    def _centre(self) -> bytes:
        """Where the middle of the first turn points. It depends on the mast, so a client can only read it."""
        low_deg = self._box.status().azimuth.min_deg % 360
        north = 90 < low_deg < 270  # a stop in the southern half has north in its middle
        return b"N Center\r\n" if north else b"S Center\r\n"
