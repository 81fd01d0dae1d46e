"""One rotctld connection: what each command makes the box do, and the answer.

Knows the meaning of the commands. Does not know the bytes (`rotctld` does). Every command gets an answer, because
Gpredict's window freezes without one, in one piece, because Gpredict and SatDump read once for each command.
"""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator import __version__
from rotator.exchange.orders import Jog, Order, Park, Speed, Stop
from rotator.protocols import rotctld_caps, rotctld_earth
from rotator.protocols.aiming import aim
from rotator.protocols.lines import OVERLONG, LineTalk
from rotator.protocols.rotctld import (
    INVALID_PARAMETER,
    IO_ERROR,
    MAX_LINE,
    NOT_AVAILABLE,
    NOT_IMPLEMENTED,
    QUESTION,
    REJECTED,
    REPORT,
    Answer,
    BadRequest,
    Request,
    encode_answer,
    is_damaged_stop,
    number,
    report,
    requests,
    whole_number,
)
from rotator.protocols.session import Box

NO_NEWLINE_S = 0.1
"""Windows builds of Gpredict up to 2018 send no line end: a whole command followed by this silence is obeyed."""

UNCHANGED_SPEED = -1
FULL_SPEED = 100

_LEFT, _RIGHT = Jog(Axis.AZIMUTH, Direction.MINUS), Jog(Axis.AZIMUTH, Direction.PLUS)
_UP, _DOWN = Jog(Axis.ELEVATION, Direction.PLUS), Jog(Axis.ELEVATION, Direction.MINUS)
_MOVES: dict[tuple[str, ...], tuple[Jog, ...]] = {
    ("2", "UP"): (_UP,),
    ("4", "DOWN"): (_DOWN,),
    ("8", "LEFT", "CCW"): (_LEFT,),
    ("16", "RIGHT", "CW"): (_RIGHT,),
    ("32", "UP_LEFT", "UP_CCW"): (_UP, _LEFT),
    ("64", "UP_RIGHT", "UP_CW"): (_UP, _RIGHT),
    ("128", "DOWN_LEFT", "DOWN_CCW"): (_DOWN, _LEFT),
    ("256", "DOWN_RIGHT", "DOWN_CW"): (_DOWN, _RIGHT),
}
_DIRECTIONS = {word: jogs for words, jogs in _MOVES.items() for word in words}


class RotctldSession(LineTalk):
    max_line = MAX_LINE
    idle_s = NO_NEWLINE_S

    def __init__(self, box: Box) -> None:
        self._box = box
        super().__init__()

    def idle(self) -> list[bytes]:
        pending = self._lines.pending
        try:
            whole = bool(pending) and all(map(_complete, requests(pending.decode("latin-1"))))
        except BadRequest:
            whole = is_damaged_stop(pending)
        return self._answers(self._lines.flush()) if whole else []

    def _answers(self, line: bytes | None) -> list[bytes]:
        if self.closed:
            return []
        if line is None:
            self._box.note_refused(OVERLONG)
            return [report(INVALID_PARAMETER)]
        if line.startswith(REPORT):
            # A port that echoes sends it back: an answer to it would come back too.
            return []
        try:
            # The whole line is parsed before any command is obeyed: KEEPALIVE must not park the antenna.
            understood = list(requests(line.decode("latin-1")))
        except BadRequest as fault:
            return [encode_answer(Request(""), self._refuse(line, fault.code))]
        replies = []
        for request in understood:
            if request.name == "quit":
                self.closed = True
                break
            try:
                answer = self._answer(request)
            except BadRequest as fault:
                answer = self._refuse(line, fault.code)
            replies.append(encode_answer(request, answer))
        return replies

    def _refuse(self, line: bytes, code: int) -> Answer:
        if is_damaged_stop(line):
            return self._order(Stop())
        self._box.note_refused(line)
        return Answer(code)

    def _answer(self, request: Request) -> Answer:
        words = request.arguments
        match request.name:
            case "set_pos":
                azimuth_deg, elevation_deg = map(number, words)
                return self._order(aim(azimuth_deg, elevation_deg))
            case "get_pos":
                return self._position()
            case "stop":
                return self._order(Stop())
            case "reset":
                answer = self._order(Stop())  # whatever the number is
                whole_number(words[0])
                return answer
            case "park":
                return self._order(Park())
            case "move":
                return self._move(*words)
            case "pause":
                # The box does not wait: that would delay a stop that follows.
                whole_number(words[0])
                return Answer()
            case "send_cmd":
                return Answer(NOT_AVAILABLE)
            case name if name in rotctld_earth.NAMES:
                return rotctld_earth.answer(request)
            case _:
                return self._setting(request.name, words) or self._reading(request.name)

    def _setting(self, name: str, words: tuple[str, ...]) -> Answer | None:
        """Levels, functions, parameters and configuration; None for another command."""
        status = self._box.status()
        match name, words:
            case "set_level", ("?",):
                return Answer(text="SPEED \n", always_reports=True)
            case "get_level", ("?",):
                return Answer(text="SPEED \n")
            case "set_level", ("SPEED", "?"):
                return Answer(text=f"{rotctld_caps.SPEED_RANGE}\n", always_reports=True)
            case "set_level", ("SPEED", word):
                return self._set_speed(whole_number(word))
            case "get_level", ("SPEED",):
                return Answer(text=f"{status.speed_level}\n")
            case (("set_func" | "set_parm"), ("?",)):
                return Answer(text="\n", always_reports=True)
            case (("get_func" | "get_parm"), ("?",)):
                return Answer(text="\n")
            case (("set_level" | "set_func" | "set_parm"), _):
                return Answer(NOT_AVAILABLE)
            case (("get_level" | "get_func" | "get_parm"), _):
                return Answer(INVALID_PARAMETER)
            case "set_conf", (token, value):
                return rotctld_caps.set_conf(token, value, status)
            case "set_conf", _:
                return Answer(INVALID_PARAMETER)
            case "get_conf", (token,):
                listed = token == QUESTION
                return (
                    rotctld_caps.dump_conf(status, always_reports=False)
                    if listed
                    else rotctld_caps.get_conf(token, status)
                )
        return None

    def _reading(self, name: str) -> Answer:
        """The commands without arguments that read something."""
        status = self._box.status()
        match name:
            case "get_info":
                return Answer(records=(("Info", f"gs232-rotator {__version__}"),))
            case "get_status":
                return Answer(records=(("Status flags", rotctld_caps.status_words(status)),))
            case "dump_caps":
                return rotctld_caps.dump_caps(status)
            case "dump_conf":
                return rotctld_caps.dump_conf(status, always_reports=True)
            case "dump_state":
                return rotctld_caps.dump_state(status)
        raise BadRequest(NOT_IMPLEMENTED)

    def _move(self, direction: str, speed: str) -> Answer:
        jogs, percent = _DIRECTIONS.get(direction), whole_number(speed)
        if jogs is None or not (percent == UNCHANGED_SPEED or 1 <= percent <= FULL_SPEED):
            raise BadRequest(INVALID_PARAMETER)
        if percent != UNCHANGED_SPEED:
            self._set_speed(-(-percent * len(rotctld_caps.SPEEDS) // FULL_SPEED))
        return self._order(*jogs)

    def _set_speed(self, level: int) -> Answer:
        if level not in rotctld_caps.SPEEDS:
            raise BadRequest(INVALID_PARAMETER)
        return self._order(Speed(level))

    def _order(self, *orders: Order) -> Answer:
        for order in orders:
            if refusal := self._box.order(order):
                return Answer(REJECTED if refusal.forbidden or refusal.faulty else INVALID_PARAMETER)
        return Answer()

    def _position(self) -> Answer:
        status = self._box.status()
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        if azimuth_deg is None or elevation_deg is None:
            return Answer(IO_ERROR)
        return Answer(records=(("Azimuth", f"{azimuth_deg:z.2f}"), ("Elevation", f"{elevation_deg:z.2f}")))


def _complete(request: Request) -> bool:
    """Whether a request without a line end is whole: those clients end with a number, while a word could go on."""
    try:
        for word in request.arguments:
            number(word)
    except BadRequest:
        return False
    return True
