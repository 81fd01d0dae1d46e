"""One connection to the console: a command in, an answer out. It ends with `ok`, or is one line `error: ` and a reason.

Knows what each command makes the box do, and how the status is written. Does not know how the box does it.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable

from hw.ports import Axis, Direction
from rotator.exchange.orders import Mode, Release
from rotator.exchange.spoken import held, sender, spoken
from rotator.exchange.status import Flown, Status, time_left
from rotator.protocols.console import TURN_WORDS, VERBS, Ask, Pair, TableLine, TrackTable, parse
from rotator.protocols.lines import LineTalk
from rotator.protocols.methods import Track
from rotator.protocols.operating import Operating
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode
from rotator.protocols.session import Box, Pairing, Tracking
from rotator.protocols.status_object import as_object
from rotator.protocols.table_text import TableError, read_table

MAX_LINE = 200
MOST_TABLE_LINES = 20_000
OK, ERROR = "ok", "error: "
NO_PAGE = "this box has no page: [page] of its file has switched it off"

Hands = Callable[[Hand], str]


def no_hands(_hand: Hand) -> str:
    return "there is no simulated panel"


class ConsoleSession(LineTalk):
    """One operator's connection."""

    max_line = MAX_LINE

    def __init__(
        self, box: Box, hands: Hands = no_hands, tracking: Tracking | None = None, pairing: Pairing | None = None
    ) -> None:
        """`hands` moves a part of the simulated panel, and returns why it cannot; empty: it has.

        `tracking`: None where the box does not know where on the earth it stands. `pairing`: None without a page.
        """
        self._box = box
        self._hands = hands
        self._operating = Operating(box, tracking)
        self._pairing = pairing
        super().__init__()
        self._table: list[str] = []
        """The lines of a timed table, as far as they have come."""

    def _answers(self, line: bytes | None) -> list[bytes]:
        return [self._answer(line)] if line is None or line.strip(b" \t") else []

    def _answer(self, line: bytes | None) -> bytes:
        if line is None:
            return _error(self._operating.refuse(f"no line has more than {MAX_LINE} characters"))
        try:
            command = parse(line)
        except ValueError as mistake:
            return _error(self._operating.refuse(str(mistake)))
        match command:
            case Ask.STATUS:
                return _reply(*report(self._box.status()), OK)
            case Ask.STATUS_JSON:
                return _reply(json.dumps(as_object(self._box.status()), ensure_ascii=False), OK)
            case Ask.HELP:
                # Two rows for each: the longest word would push all explanations out of a narrow terminal.
                return _reply(*(row for verb in VERBS for row in (verb.usage, f"  {verb.help}")), OK)
            case TurnMode() | TurnKnob() | ThrowJog() | StopButton():
                refused = self._hands(command)
                return _error(refused) if refused else _reply(OK)
            case Track(""):
                return _reply(self._operating.tracks, OK)
            case Pair():
                return self._pair(command)
            case TableLine(text):
                refused = self._note(text)
                return _error(refused) if refused else _reply(OK)
            case TrackTable(name):
                refused = self._track_table(name)
                return _error(refused) if refused else _reply(OK)
            case Release():
                refused, left = self._operating.do(command), self._operating.goes_on_with
                if refused:
                    return _error(refused)
                return _reply(f"it tracked {left} before: go-on goes on with that", OK) if left else _reply(OK)
            case _:
                refused = self._operating.do(command)
                return _error(refused) if refused else _reply(OK)

    def _pair(self, command: Pair) -> bytes:
        if self._pairing is None:
            return _error(NO_PAGE)
        match command:
            case Pair("", ""):
                return _reply(self._pairing.begin(), OK)
            case Pair("list"):
                return _reply(*self._pairing.paired(), OK)
            case Pair("token", name):
                return _reply(self._pairing.token(name), OK)
            case Pair(_, number):
                refused = self._pairing.revoke(int(number))
                return _error(refused) if refused else _reply(OK)

    def _note(self, line: str | None) -> str:
        """Returns why not; empty: it has the line."""
        if line is None:
            self._table = []
        elif len(self._table) >= MOST_TABLE_LINES:
            return f"a table has no more than {MOST_TABLE_LINES} lines"
        else:
            self._table.append(line)
        return ""

    def _track_table(self, name: str) -> str:
        lines, self._table = self._table, []
        try:
            table = read_table("\n".join(lines), name, "the table", turns=True)
        except TableError as mistake:
            return str(mistake)
        return self._operating.program(table)


def report(status: Status) -> list[str]:
    """The status as lines `name: value`. Lines without a value are left out."""
    lines = [f"{axis.value}: {_stands(status, axis)}" for axis in status.fitted]
    both_deg = {Axis.AZIMUTH: status.wanted_azimuth_deg, Axis.ELEVATION: status.wanted_elevation_deg}
    wanted_deg = [both_deg[axis] for axis in status.fitted]
    if any(angle_deg is not None for angle_deg in wanted_deg):
        lines.append(
            "wanted: " + " ".join("---" if angle_deg is None else _shown(angle_deg) for angle_deg in wanted_deg)
        )
    if status.moving:
        lines.append("moving: " + " ".join(axis.value for axis in status.fitted if status.axis(axis).moving))
    mover = sender(status.controlled_by, status.controlled_from) if status.controlled_by else "nobody"
    lines.append(f"moved by: {mover}")
    if status.held_by:
        lines.append(f"held by: {sender(status.held_by)}; programs do not move it until give-back")
    if status.flown is not None:
        how = "recognised" if status.recognised else "tracks"
        lines.append(f"{how}: {tracked(status.flown, status.at_s)}")
    if status.mode is not Mode.AUTO:
        lines.append(f"panel: {status.mode.name}")
    if status.latched:
        what, until = held(storm=status.storm)
        lines.append(f"{what}: {sender(status.latched)}; {until}")
    lines += [f"fault: {fault}" for fault in status.faults]
    lines += [
        f"missing: {axis.value} needs {what}" for axis in status.fitted if (what := status.axis(axis).uncalibrated)
    ]
    lines += [f"note: {notice}" for notice in status.notices]
    lines += [f"note: {axis.value}: {notice}" for axis in status.fitted for notice in status.axis(axis).notices]
    lines += [f"note: {why}" for why in status.stays]
    if status.simulated:
        lines.append("simulated: nothing real turns")
    return [spoken(line) for line in lines]


def tracked(flown: Flown, now_s: float) -> str:
    """The target, when it rises or sets, and how far it may be from where it is computed."""
    begins, lasts = ("begins", "goes on") if flown.table else ("rises", "up")
    wait_s, left_s = flown.begin_s - now_s, max(0.0, flown.end_s - now_s)
    if wait_s > 0:
        when = f"{begins} in {time_left(wait_s)}"
    else:
        when = f"{lasts} for {time_left(left_s)} more" if math.isfinite(left_s) else "always up"
    return f"{flown.name}, {when}{flown.error_text}"


def _stands(status: Status, axis: Axis) -> str:
    now = status.axis(axis)
    known = now.source.value if now.seen else "when last seen, no reading now"
    about = "≈ " if now.error_text else ""
    angle = "" if now.shown_deg is None else f"{about}{_shown(now.shown_deg)}{now.error_text} {known}"
    words = [angle or "not known"]
    if now.target_deg is not None:
        words.append(f"to {_shown(now.target_deg)}")
    elif now.off_deg is not None:
        words.append(f"{_shown(abs(now.off_deg))} off what was ordered")
    if now.homing:
        words.append("homing: turns to its end stop")
    if now.drive:
        words.append(f"turns {TURN_WORDS[axis, now.drive]}")
    if now.by_itself_dps:
        way = Direction.PLUS if now.by_itself_dps > 0 else Direction.MINUS
        words.append(f"TURNS {TURN_WORDS[axis, way]} BY ITSELF at {abs(now.by_itself_dps):.1f}°/s")
    return ", ".join(words)


def _shown(angle_deg: float) -> str:
    # Adding zero turns -0.0, from a noisy pot at its stop, into 0.0.
    return f"{round(angle_deg, 1) + 0.0:.1f}°"


def _error(reason: str) -> bytes:
    return _reply(ERROR + spoken(reason))


def _reply(*lines: str) -> bytes:
    return "".join(f"{_on_one_line(line)}\n" for line in lines).encode("utf-8", "replace")


def _on_one_line(text: str) -> str:
    return re.sub(r"[\r\n]+", " ", text)
