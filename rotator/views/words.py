"""The state of the box in the words of its screens: its activity, its sender, and how to let it go on.

Knows a status. Does not know the place of the words on a screen.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

from hw.ports import Axis, Direction
from rotator.control.rights import mode_words
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Mode
from rotator.exchange.sources import PANEL
from rotator.exchange.spoken import sender, spoken
from rotator.exchange.status import SHOWN_OFF_DEG, AxisStatus, Flown, Status
from rotator.views.sky_plot import off_deg

KEYS = "space STOP   q quit", "park + Enter: storm park", "resume + Enter: go on"
TURNS = {
    (Axis.AZIMUTH, Direction.PLUS): "CW",
    (Axis.AZIMUTH, Direction.MINUS): "CCW",
    (Axis.ELEVATION, Direction.PLUS): "UP",
    (Axis.ELEVATION, Direction.MINUS): "DOWN",
}
GOOD, PLAIN, WARNS, ALARMS = "bold green", "bold", "bold yellow", "bold white on red"
RELEASE = "resume + Enter: it may move again"
RELEASE_FAULT = "resume + Enter: go on when repaired"
RELEASE_LATER = "resume + Enter: it may move when the cause is gone"
_FIRST = {
    FaultKind.RELAY_WELDED: "relays-checked AXIS",
    FaultKind.RELAY_UNSEEN: "relays-checked AXIS",
    FaultKind.COUNT_LOST: "home AXIS",
    FaultKind.NOT_HOMED: "home AXIS",
    FaultKind.POSITION_UNKNOWN: "confirm AXIS DEGREES",
}
"""Faults that no `resume` ends: the command that does, once it is repaired."""
OUT = ("closed", "waiting for it")
"""States of a link that no program can use."""
PASSES = "This ends by itself when the cause is gone."


class WireView(Protocol):
    """The properties of a link that a screen shows."""

    name: str
    protocol: str
    where: str
    state: str
    last_in: bytes
    last_out: bytes


def stopped_by(status: Status) -> str:
    """The latched stop and its sender, in capitals as a fault."""
    return f"{'STORM PARK' if status.storm else 'STOPPED'} by {sender(status.latched)}"


def headline(status: Status) -> tuple[str, str]:
    """The activity of the box in a few words, and their style. The worst comes first."""
    faulted = [axis.value for axis in status.fitted if status.axis(axis).fault]
    homing = [axis.value for axis in status.fitted if status.axis(axis).homing]
    lacking = [axis.value for axis in status.fitted if status.axis(axis).missing]
    if loud := next((fault.act_now for fault in status.faults if fault.act_now), ""):
        return loud, ALARMS
    if status.latched:
        return stopped_by(status), ALARMS
    if faulted:
        return f"FAULT {' and '.join(faulted)}", ALARMS
    if homing:
        return f"HOMING {' and '.join(homing)}: turns to its end stop", WARNS
    if status.mode is Mode.PARK or (status.mode is not Mode.AUTO and status.mode_by in ("", PANEL)):
        words = mode_words(status.mode, status.mode_by)
        return spoken(words[0].upper() + words[1:]), WARNS
    if lacking:
        return f"UNCALIBRATED {' and '.join(lacking)}", WARNS
    if stray := [axis.value for axis in status.fitted if status.axis(axis).by_itself_dps]:
        return f"TURNING BY ITSELF: {' and '.join(stray)}", ALARMS
    if status.moving:
        return "TURNING", GOOD
    if status.flown is not None and status.flown.begin_s > status.at_s:
        return f"WAITS FOR {status.flown.name}", GOOD
    return _at_rest(status)


def _at_rest(status: Status) -> tuple[str, str]:
    """The words for a box at rest. An axis without an order, or that lost it by a fault, points at no target."""
    if (off := off_deg(status)) is None:
        return "AT REST", PLAIN
    lost = [axis for axis in status.fitted if status.axis(axis).target_deg is None]
    if any(status.axis(axis).missed_deg is not None for axis in status.fitted if axis not in lost):
        return "WAITS BESIDE A FORBIDDEN SECTOR", WARNS
    if not lost:
        return "ON TARGET" if off < SHOWN_OFF_DEG else "ON TARGET, WITHIN TOLERANCE", GOOD
    if (there := next((axis for axis in status.fitted if axis not in lost), None)) is None:
        return "AT REST", PLAIN
    return f"{there.value.upper()} ON TARGET, {lost[0].value.upper()} AT REST", PLAIN


def orders_from(status: Status, wires: Sequence[WireView] = ()) -> str:
    """The source of the present order."""
    source = status.controlled_by
    if not source:
        return "no orders"
    if status.flown is not None and not status.recognised:
        return f"tracks {status.flown.name}, {rise_or_set(status.flown, status.at_s)}{status.flown.error_text}"
    # The sender's address is better than the port at which this box listens.
    where = "" if status.controlled_from else next((w.where for w in wires if source.partition("#")[0] == w.name), "")
    recognised = f": {status.flown.name}, {rise_or_set(status.flown, status.at_s)}" if status.flown else ""
    point = f", point {status.timed_point} of {status.timed_points}" if status.timed_points else ""
    return f"orders from {sender(source, status.controlled_from)}{recognised}{point}" + (f" ({where})" if where else "")


def rise_or_set(flown: Flown, now_s: float, *, short: bool = False) -> str:
    """`AOS in 3:20`: minutes and seconds until the target rises. LOS: until it sets. A table begins and ends.

    `short`: for a display, `AOS 3:20`, and of a table `IN` and `ENDS`.
    """
    begins, ends = ("begins in", "ends in") if flown.table else ("AOS in", "LOS in")
    if short:
        begins, ends = ("IN", "ENDS") if flown.table else ("AOS", "LOS")
    if flown.begin_s > now_s:
        return f"{begins} {_countdown(flown.begin_s - now_s)}"
    return f"{ends} {_countdown(flown.end_s - now_s)}" if math.isfinite(flown.end_s) else "always up"


def _countdown(seconds: float) -> str:
    """`3:20`, and from an hour on `6h41`."""
    minutes, left_s = divmod(max(0, round(seconds)), 60)
    return f"{minutes}:{left_s:02d}" if minutes < 60 else f"{minutes // 60}h{minutes % 60:02d}"


def off_target(status: Status) -> str:
    off = off_deg(status)
    return "" if off is None else f"{off:.1f}° off target on the sky"


def is_out(wire: WireView) -> bool:
    """Whether no program can use the link now: it waits for its port, file or peer."""
    return wire.state in OUT


def links(wires: Sequence[WireView]) -> tuple[str, str]:
    """The number of links and the names of those that are out, in a few words, and their style."""
    count = f"{len(wires)} link{'' if len(wires) == 1 else 's'}"
    if out := [wire for wire in wires if is_out(wire)]:
        return f"{count}, out: {', '.join(wire.name for wire in out)}", WARNS
    return (f"{count}, all ready" if wires else "no links"), PLAIN


def pass_starts(status: Status) -> str:
    """The number of motor starts; empty: no relay starts the motors."""
    counts = [f"{axis.value} {count}" for axis in status.fitted if (count := status.axis(axis).starts) is not None]
    return f"motor starts in this pass: {', '.join(counts)}" if counts else ""


def release(status: Status) -> str:
    """The keys that let the antenna move again; empty: it may move."""
    if not status.faults:
        return RELEASE if status.latched else ""
    for fault in status.faults:
        if command := _FIRST.get(fault.kind):
            return f"Repaired? rotator {command.replace('AXIS', fault.axis.value)}, then resume"
    if all(fault.passing for fault in status.faults):
        return RELEASE_LATER if status.latched else PASSES
    if status.flown is not None and not status.recognised:
        return f"{RELEASE_FAULT}; {status.flown.name} is tracked on"
    return RELEASE_FAULT


def by_itself(axis: Axis, each: AxisStatus) -> str:
    """`TURNS CCW 5.9°/s` for an axis that turns without a motor; empty: it stands, or is driven."""
    if not each.by_itself_dps:
        return ""
    way = Direction.PLUS if each.by_itself_dps > 0 else Direction.MINUS
    return f"TURNS {TURNS[axis, way]} {abs(each.by_itself_dps):.1f}°/s"


def notes(status: Status) -> list[str]:
    by_deg = {Axis.AZIMUTH: status.nudge_azimuth_deg, Axis.ELEVATION: status.nudge_elevation_deg}
    nudged = [
        f"{axis.value}: nudged by {degrees(by_deg[axis], sign=True)} until the pass ends"
        for axis in status.fitted
        if by_deg[axis]
    ]
    return nudged + [f"{axis.value}: {notice}" for axis in status.fitted for notice in status.axis(axis).notices]


def lacks(status: Status) -> list[str]:
    """The missing steps of each axis before it may be aimed."""
    texts = []
    for axis in status.fitted:
        each = status.axis(axis)
        if each.uncalibrated:
            reads = "" if each.raw is None else f" (its sensor reads {round(each.raw, 4) + 0.0:.4f})"
            texts.append(f"{axis.value} UNCALIBRATED: it needs {each.uncalibrated}{reads}")
    return texts


def stands(axis: AxisStatus, digits: int = 1) -> str:
    """Where the axis stands: `137.0°`; `≈137.0°` where that is only reckoned by time."""
    about = "≈" if axis.error_deg is not None and axis.shown_deg is not None else ""
    return about + degrees(axis.shown_deg, digits)


def degrees(angle_deg: float | None, digits: int = 1, *, sign: bool = False) -> str:
    """`---` for an unknown angle."""
    # Adding zero turns -0.0, from a noisy pot at its stop, into 0.0.
    return "---" if angle_deg is None else f"{round(angle_deg, digits) + 0.0:{'+' if sign else ''}.{digits}f}°"
