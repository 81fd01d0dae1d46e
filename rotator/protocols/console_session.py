"""One connection to the console: a command in, an answer out. It ends with `ok`, or is one line `error: ` and a reason.

Knows what each command makes the box do, and how the status is written. Does not know how the box does it.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace

from hw.ports import Axis
from rotator.control.rights import Deed, deed_of, hindrance, holds
from rotator.orders import Aim, Home, Jog, Mode, Order, Release
from rotator.protocols.console import TURN_WORDS, VERBS, Ask, ClockIsRight, Track, parse
from rotator.protocols.lines import LineReader
from rotator.protocols.panel_words import Hand, StopButton, ThrowJog, TurnKnob, TurnMode
from rotator.protocols.session import Box, Tracking
from rotator.protocols.status_object import as_object
from rotator.spoken import spoken
from rotator.status import Flown, Status

MAX_LINE = 200
OK, ERROR = "ok", "error: "
FULL_TURN_DEG, ZENITH_DEG = 360.0, 90.0
NO_PLACE = (
    "the box does not know where it stands: write [station] with latitude_deg and longitude_deg, or locator, into its "
    "file, and start it again"
)


Hands = Callable[[Hand], str]


def no_hands(_hand: Hand) -> str:
    return "there is no simulated panel"


class ConsoleSession:
    """One operator's connection. While a stop is latched, orders that move are refused with the reason."""

    idle_s = None
    closed = False

    def __init__(self, box: Box, hands: Hands = no_hands, tracking: Tracking | None = None) -> None:
        """`hands` moves a part of the simulated panel, and returns why it cannot; empty: it has.

        `tracking`: None where the box does not know where on the earth it stands.
        """
        self._box = box
        self._hands = hands
        self._tracking = tracking
        self._lines = LineReader(MAX_LINE)
        self._resumed = False
        """A `resume` has been sent; the status may not show it yet."""

    def receive(self, data: bytes) -> list[bytes]:
        return [self._answer(line) for line in self._lines.feed(data) if line is None or line.strip(b" \t")]

    def idle(self) -> list[bytes]:
        return []

    def _answer(self, line: bytes | None) -> bytes:
        if line is None:
            return _error(f"no line has more than {MAX_LINE} characters")
        try:
            command = parse(line)
        except ValueError as mistake:
            return _error(str(mistake))
        match command:
            case Ask.STATUS:
                return _reply(*report(self._box.status()), OK)
            case Ask.STATUS_JSON:
                return _reply(json.dumps(as_object(self._box.status()), ensure_ascii=False), OK)
            case Ask.HELP:
                width = max(len(verb.usage) for verb in VERBS)
                return _reply(*(f"{verb.usage:<{width}}  {verb.help}" for verb in VERBS), OK)
            case TurnMode() | TurnKnob() | ThrowJog() | StopButton():
                refused = self._hands(command)
                return _error(refused) if refused else _reply(OK)
            case Track(""):
                return _reply(self._tracking.state if self._tracking else "off", OK)
            case Track(words):
                refused = self._track(words)
                return _error(refused) if refused else _reply(OK)
            case ClockIsRight():
                if self._tracking is not None:
                    self._tracking.clock_is_right()
                return _reply(OK)
            case _:
                return self._obey(command)

    def _obey(self, order: Order) -> bytes:
        if reason := self._blocked(order) or _beyond(order, self._box.status()):
            return _error(reason)
        match order:
            case Aim() | Jog() | Home():
                pass
            case _:
                self._resumed = isinstance(order, Release)
        refused = self._box.order(order)
        return _error(refused.reason) if refused else _reply(OK)

    def _track(self, words: str) -> str:
        """Returns why not; empty: it does."""
        if self._tracking is None:
            return NO_PLACE
        if words == "off":
            self._tracking.off()
            return ""
        return self._held(Deed.AIM) or self._tracking.track(words)

    def _blocked(self, order: Order) -> str:
        """Why this order would have no effect; empty: it has one."""
        deed = deed_of(order)
        return self._held(deed) if deed else ""

    def _held(self, deed: Deed) -> str:
        """What holds the antenna back from this; empty: nothing does."""
        status = self._box.status()
        if not status.latched:
            self._resumed = False
        held = holds(replace(status, latched="") if self._resumed else status)
        state = hindrance(held, deed)
        return held[state] if state else ""


def _beyond(order: Order, status: Status) -> str:
    """Why the rotor has no such angle; empty: it has. A person who names one is not led to another one instead.

    A program's order means a direction all the same: it sends what its satellite does.
    """
    match order:
        case Aim(float() as azimuth_deg, float() as elevation_deg):
            pass
        case _:
            return ""
    azimuth, elevation = status.azimuth, status.elevation
    if azimuth_deg > FULL_TURN_DEG and azimuth_deg > azimuth.max_deg:
        return (
            f"azimuth {azimuth_deg:g}° names a turn beyond the range of {azimuth.min_deg:g}° to {azimuth.max_deg:g}°; "
            f"the same direction is {azimuth_deg % FULL_TURN_DEG:g}°"
        )
    below = elevation_deg < min(0.0, elevation.min_deg)
    if below or elevation_deg > max(ZENITH_DEG, elevation.max_deg):
        return f"elevation {elevation_deg:g}° is outside the range of {elevation.min_deg:g}° to {elevation.max_deg:g}°"
    return ""


def report(status: Status) -> list[str]:
    """The status as lines `name: value`. Lines without a value are left out."""
    lines = [f"{axis.value}: {_stands(status, axis)}" for axis in Axis]
    wanted_deg = (status.wanted_azimuth_deg, status.wanted_elevation_deg)
    if wanted_deg != (None, None):
        lines.append(
            "wanted: " + " ".join("---" if angle_deg is None else _shown(angle_deg) for angle_deg in wanted_deg)
        )
    if status.moving:
        lines.append("moving: " + " ".join(axis.value for axis in Axis if status.axis(axis).moving))
    lines.append(f"moved by: {status.controlled_by or 'nobody'}")
    if status.flown is not None:
        lines.append(f"tracks: {tracked(status.flown, status.at_s)}")
    if status.mode is not Mode.AUTO:
        lines.append(f"panel: {status.mode.name}")
    if status.latched:
        lines.append(f"stopped by: {status.latched}; nothing moves until resume")
    lines += [f"fault: {fault}" for fault in status.faults]
    lines += [f"missing: {axis.value} needs {what}" for axis in Axis if (what := status.axis(axis).uncalibrated)]
    lines += [f"note: {notice}" for notice in status.notices]
    lines += [f"note: {axis.value}: {notice}" for axis in Axis for notice in status.axis(axis).notices]
    if status.simulated:
        lines.append("simulated: nothing real turns")
    return [spoken(line) for line in lines]


def tracked(flown: Flown, now_s: float) -> str:
    """The target, and when it rises or sets."""
    wait_s, left_s = flown.begin_s - now_s, max(0.0, flown.end_s - now_s)
    if wait_s > 0:
        return f"{flown.name}, rises in {_minutes(wait_s)}"
    return f"{flown.name}, up for {_minutes(left_s)} more" if math.isfinite(left_s) else f"{flown.name}, always up"


def _minutes(seconds: float) -> str:
    minutes, seconds_left = divmod(round(seconds), 60)
    return f"{minutes // 60} h {minutes % 60} min" if minutes >= 60 else f"{minutes}:{seconds_left:02d} min"


def _stands(status: Status, axis: Axis) -> str:
    now = status.axis(axis)
    known = now.source.value if now.seen else "when last seen, no reading now"
    words = ["not known" if now.shown_deg is None else f"{_shown(now.shown_deg)} {known}"]
    if now.target_deg is not None:
        words.append(f"to {_shown(now.target_deg)}")
    if now.homing:
        words.append("homing: turns to its end stop")
    if now.drive:
        words.append(f"turns {TURN_WORDS[axis, now.drive]}")
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
