"""One connection to an LX200 telescope: what each command makes the box do, and the answer.

Knows the meaning of the commands. Does not know the numbers on the line (`lx200` does), nor where a star stands (`sky`
does). A target needs both its coordinates anew for each order, so that half of a damaged pair is never obeyed.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime

from hw.ports import Axis, Direction
from rotator.control.sky.angles import direction
from rotator.exchange.orders import Aim, Jog, Order, Park, Stop
from rotator.exchange.sources import Refusal
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.protocols import lx200
from rotator.protocols.lx200 import Command, CommandReader, Kind
from rotator.protocols.session import Box, Talk
from rotator.protocols.star_follower import BELOW, EVERY_S, StarFollower

DONE, NOT_DONE = b"1", b"0"
GOES = b"0"
LONGEST_REASON = 80
_HALTS = {"Qn": Axis.ELEVATION, "Qe": Axis.AZIMUTH}
_TURNS = {
    "Mn": Jog(Axis.ELEVATION, Direction.PLUS),
    "Ms": Jog(Axis.ELEVATION, Direction.MINUS),
    "Mw": Jog(Axis.AZIMUTH, Direction.PLUS),
    "Me": Jog(Axis.AZIMUTH, Direction.MINUS),
}
_PARTNERS = {"Sr": "Sd", "Sd": "Sr", "Sz": "Sa", "Sa": "Sz"}


class Lx200Session(Talk):
    """`remark` takes a line for the log: what the program wants and does not get."""

    every_s = EVERY_S

    def __init__(self, box: Box, sky: Sky, remark: Callable[[str], None] = lambda _text: None) -> None:
        self._box = box
        self._sky = sky
        self._remark = remark
        self._commands = CommandReader()
        self._follower = StarFollower(box, sky, remark)
        self._set_deg: dict[str, float] = {}
        """The coordinates that have come since the last order: Sr, Sd, Sz, Sa."""
        self._last: dict[str, float] = {}
        """The last complete target on the sky."""
        self._long = False

    def receive(self, data: bytes) -> list[bytes]:
        replies = [self._answer(command) for command in self._commands.feed(data)]
        return [reply for reply in replies if reply]

    def finish(self) -> list[bytes]:
        return self.receive(bytes([lx200.HASH]))

    def beat(self) -> list[bytes]:
        self._follower.beat()
        return []

    def _answer(self, command: Command | Kind) -> bytes:
        match command:
            case Kind.MOUNT:
                return b"A"
            case Kind():
                return b""
            case Command("Sr", text):
                return self._set(command, lx200.hours(text))
            case Command("Sd" | "Sa", text):
                return self._set(command, lx200.signed(text))
            case Command("Sz", text):
                return self._set(command, lx200.around(text))
            case Command("MS"):
                return self._go_to_star()
            case Command("MA"):
                return self._go_to_place()
            case Command(lx200.STOP):
                self._order(Stop())
            case Command("Qn" | "Qe" as halt):
                self._order(Stop((_HALTS[halt],)))
            case Command("Mn" | "Ms" | "Mw" | "Me" as turn):
                self._order(_TURNS[turn])
            case Command("hP"):
                self._order(Park())
            case Command("U"):
                self._long = not self._long
            case Command("D"):
                return b"\x7f#" if self._box.status().moving else b"#"
            case Command("CM"):
                self._remark("the program wants the antenna's place taken for its target: not done")
                return b"not done#"
            case Command("St" | "Sg" | "SL" | "SG"):
                return DONE
            case Command("SC"):
                return b"1Updating Planetary Data#                                #"
            case Command(verb):
                return self._place(verb) or self._known(verb)
        return b""

    def _set(self, command: Command, angle_deg: float | None) -> bytes:
        """A damaged coordinate takes its partner with it: one of an earlier target must not complete a later one."""
        which = command.verb
        if angle_deg is None:
            self._box.note_refused(f":{which}{command.value}#".encode("latin-1"))
            self._set_deg.pop(which, None)
            self._set_deg.pop(_PARTNERS[which], None)
            return NOT_DONE
        self._set_deg[which] = angle_deg
        return DONE

    def _go_to_star(self) -> bytes:
        right_ascension_deg, declination_deg = self._taken("Sr", "Sd")
        if right_ascension_deg is None or declination_deg is None:
            return b"2No target#"
        self._last = {"Sr": right_ascension_deg, "Sd": declination_deg}
        refused = self._follower.go(Star(right_ascension_deg, declination_deg, Equinox.OF_DATE))
        if refused is None:
            return GOES
        return b"%d%b#" % (1 if refused.reason == BELOW else 2, _shown(refused))

    def _go_to_place(self) -> bytes:
        azimuth_deg, elevation_deg = self._taken("Sz", "Sa")
        if azimuth_deg is None or elevation_deg is None:
            return b"1"
        return b"1" if self._order(Aim(azimuth_deg, elevation_deg)) else GOES

    def _taken(self, *which: str) -> tuple[float | None, float | None]:
        first, second = (self._set_deg.pop(each, None) for each in which)
        return first, second

    def _order(self, order: Order) -> Refusal | None:
        """Any order of the program's own ends the following of a star."""
        self._follower.end()
        if isinstance(order, Stop):
            self._set_deg.clear()
        return self._box.order(order)

    def _place(self, verb: str) -> bytes:
        """Where the antenna points; nothing while that is not known."""
        status = self._box.status()
        if status.azimuth.points_deg is None or status.elevation.points_deg is None:
            return b""
        azimuth_deg, elevation_deg = direction(status.azimuth.points_deg, status.elevation.points_deg)
        match verb:
            case "GZ":
                return lx200.around_reply(azimuth_deg, long=self._long)
            case "GA":
                return lx200.signed_reply(elevation_deg, long=self._long)
            case "GR" | "GD":
                star = self._sky.star(azimuth_deg, elevation_deg, Equinox.OF_DATE)
                if verb == "GR":
                    return lx200.hours_reply(star.right_ascension_deg, long=self._long)
                return lx200.signed_reply(star.declination_deg, long=self._long)
        return b""

    def _known(self, verb: str) -> bytes:
        site = self._sky.site
        now = datetime.fromtimestamp(self._sky.utc(), UTC)
        match verb:
            case "Gr":
                return lx200.hours_reply(self._last.get("Sr", 0.0), long=self._long)
            case "Gd":
                return lx200.signed_reply(self._last.get("Sd", 0.0), long=self._long)
            case "GS":
                return lx200.hours_reply(self._sky.sidereal_h() * 15.0, long=True)
            case "GL":
                return f"{now:%H:%M:%S}#".encode()
            case "GC":
                return f"{now:%m/%d/%y}#".encode()
            case "GG":
                return b"+00#"
            case "Gt":
                return lx200.signed_reply(site.latitude_deg, long=False)
            case "Gg":
                return lx200.around_reply(-site.longitude_deg, long=False)
            case "GVP":
                return b"gs232-rotator#"
        return b""


def _shown(refused: Refusal) -> bytes:
    """The reason as an answer may hold it."""
    return refused.reason.replace("#", "").encode("ascii", "replace")[:LONGEST_REASON]
