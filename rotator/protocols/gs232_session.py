"""One GS-232 connection: what each command makes the box do, and the answer.

Knows the meaning of the commands. Does not know the bytes (`gs232` does), nor how the box carries out an order.
"""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.exchange.orders import Calibrate, ClearTimed, Jog, LoadTimed, Order, RunTimed, Speed, Stop
from rotator.exchange.status import AxisStatus
from rotator.protocols import gs232
from rotator.protocols.aiming import aim, outside, whole
from rotator.protocols.gs232 import Command, Dialect, NoOrder, NotACommand
from rotator.protocols.lines import OVERLONG, LineTalk
from rotator.protocols.session import Box

_OF_ELEVATION = ("B", "C2", "W", "U", "D", "E", "O2", "F2")
"""What a unit without its elevation option does not know. Programs ask `C2` all the same: a link that is not strict
answers it, with elevation 0."""
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


class Gs232Session(LineTalk):
    """GS-232 on one connection.

    `ack` is the answer to a command that asks no question, b"" or b"\\r"; `empty_line` that to an empty line, b"" or
    `?>`. `strict` follows the GS-232B's manual where programs know a clone's way: O and F store only after Y, Z changes
    the centre that H3 shows, neither Z nor P36 nor P45 has a text as its answer, and a W counts only at the begin of a
    line.
    """

    max_line = gs232.MAX_LINE

    def __init__(
        self,
        box: Box,
        dialect: Dialect,
        *,
        ack: bytes = b"",
        empty_line: bytes = b"",
        strict: bool = False,
        may_calibrate: bool = False,
    ) -> None:
        self._box = box
        self._dialect = dialect
        self._ack = ack
        self._empty_line = empty_line
        self._as_unit = strict
        self._strict = strict and dialect is Dialect.B
        self._lenient = not strict
        self._may_calibrate = may_calibrate
        super().__init__()
        azimuth = box.status().azimuth
        self._top_deg = (
            gs232.AZIMUTH_TOP_450_DEG
            if azimuth.max_deg - azimuth.min_deg > gs232.AZIMUTH_TOP_360_DEG
            else gs232.AZIMUTH_TOP_360_DEG
        )
        # Where the middle of the first turn points. A stop in the southern half has north in its middle.
        self._north = 90 < azimuth.min_deg % 360 < 270
        self._points = 0
        self._asked: Calibrate | None = None
        """What a Y as the next line stores."""
        self._echoed = False
        """The last line was this unit's own `?>`, perhaps with one more line end."""

    def _answers(self, line: bytes | None) -> list[bytes]:
        reply = self._answer(line)
        return [reply] if reply else []

    def _answer(self, line: bytes | None) -> bytes:
        if line is None:
            self._box.note_refused(OVERLONG)
            return gs232.INVALID
        # A port that echoes (Linux does, until a program sets it) sends it back: an answer to it would come back too.
        self._echoed = line.strip() == gs232.INVALID.strip() or (self._echoed and not line.strip())
        if self._echoed:
            return b""
        asked, self._asked = self._asked, None
        if asked is not None and line.strip().upper() in (b"Y", b""):
            return self._store(asked) if line.strip() else self._ack
        try:
            command = gs232.parse(line, self._dialect)
        except NotACommand as reason:
            command = gs232.order_within(line) if self._lenient else None
            if command is None:
                if isinstance(reason, NoOrder):
                    self._clear_list()
                self._box.note_refused(line)
                return gs232.INVALID
        return self._empty_line if command is None else self._obey(command)

    def _obey(self, command: Command) -> bytes:
        if self._as_unit and command.verb in _OF_ELEVATION and not self._box.status().elevation.fitted:
            return gs232.INVALID
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
                return gs232.help_reply(_HELP[verb], self._dialect, self._top_deg, north=self._north)
            case "P36":
                return self._mode(gs232.AZIMUTH_TOP_360_DEG)
            case "P45":
                return self._mode(gs232.AZIMUTH_TOP_450_DEG)
            case "Z":
                return self._centre()
            case "O" | "F" | "O2" | "F2" as verb if self._may_calibrate and not self._box.status().moving:
                return self._calibrate(_CALIBRATIONS[verb])
            case verb if verb in _PLAIN_ORDERS:
                return self._order(_PLAIN_ORDERS[verb])
        return gs232.INVALID

    def _order(self, order: Order) -> bytes:
        return gs232.INVALID if self._box.order(order) else self._ack

    def _go(self, command: Command) -> bytes:
        # Any M or W clears the list, as the manuals say, and before anything can make it invalid.
        self._clear_list()
        azimuths_deg = [azimuth for azimuth, _ in command.points]
        if command.azimuth_deg is not None:
            azimuths_deg.append(command.azimuth_deg)
        if (farthest_deg := max(azimuths_deg)) > (top_deg := self._counts_to(self._box.status().azimuth)):
            self._box.note_refused(outside(farthest_deg, top_deg))
            return gs232.INVALID
        if command.interval_s is not None:
            reply = self._order(LoadTimed(float(command.interval_s), command.points))
            self._points = 0 if reply == gs232.INVALID else len(command.points)
            return reply
        return self._order(aim(command.azimuth_deg, command.elevation_deg))

    def _counts_to(self, azimuth: AxisStatus) -> float:
        """The highest azimuth: a 450° unit has all of an overlap that is wider."""
        return max(self._top_deg, azimuth.max_deg) if self._top_deg > gs232.AZIMUTH_TOP_360_DEG else self._top_deg

    def _clear_list(self) -> None:
        if self._list_length():
            self._points = 0
            self._box.order(ClearTimed())

    def _list_length(self) -> int:
        """The length of the box's list, or of one just sent on this connection that the box has not taken yet."""
        return self._points or self._box.status().timed_points

    def _position(self, verb: str) -> bytes:
        status = self._box.status()
        azimuth_deg = self._shown(status.azimuth)
        elevation_deg = (status.elevation.angle_deg or 0.0) + status.elevation.correction_deg
        match verb:
            case "C":
                return gs232.azimuth_reply(self._dialect, azimuth_deg)
            case "B":
                return gs232.elevation_reply(self._dialect, elevation_deg)
            case _:
                return gs232.position_reply(self._dialect, azimuth_deg, elevation_deg)

    def _shown(self, azimuth: AxisStatus) -> float:
        """A 450° unit counts on through its overlap; a 360° unit starts again at north."""
        # Noise of the pot just beyond an end of the range counts as that end, not as one turn away.
        axis_deg = min(max(azimuth.angle_deg or 0.0, azimuth.min_deg), azimuth.max_deg)
        points_deg = axis_deg + azimuth.correction_deg
        return points_deg if 0 <= whole(points_deg) <= self._counts_to(azimuth) else points_deg % 360

    def _mode(self, top_deg: int) -> bytes:
        self._top_deg = top_deg
        return self._ack if self._strict else gs232.mode_reply(top_deg)

    def _centre(self) -> bytes:
        """A unit ignores Z in its 450° mode. Angles stay compass angles: the mast decides where the stop is."""
        if not self._strict:
            return gs232.centre_reply(north=self._north)
        if self._top_deg == gs232.AZIMUTH_TOP_360_DEG:
            self._north = not self._north
        return self._ack

    def _calibrate(self, order: Calibrate) -> bytes:
        if not self._strict:
            return self._order(order)
        self._asked = order
        if not order.high_end:
            return gs232.SURE
        # As a unit does, F shows the reading first; F2 shows both.
        return self._position("C" if order.axis is Axis.AZIMUTH else "C2") + gs232.SURE

    def _store(self, order: Calibrate) -> bytes:
        if self._box.status().moving or self._box.order(order):
            return gs232.INVALID
        return gs232.STORED
