"""The box on an output that cannot show a picture: a greeting, and a line for each change.

Knows words. Does not know when a line is printed.
"""

from __future__ import annotations

from collections.abc import Sequence

from hw.ports import Axis, Direction
from rotator.exchange.status import AxisStatus, Status
from rotator.views.words import TURNS, WireView, degrees, notes, stands, stopped_by


def greeting(version: str, hardware: str, wires: Sequence[WireView]) -> list[str]:
    """The version, and the address of each link."""
    rotor = "a SIMULATED rotor" if hardware == "sim" else "the rotor on this Pi"
    return [f"rotator {version}: {rotor}", *(f"  {wire.protocol:<11} {wire.where}  ({wire.state})" for wire in wires)]


def line(status: Status) -> str:
    """The status in one line. It has no time and no counter, so equal lines mean that nothing has changed."""
    parts = [_axis(status, axis) for axis in status.fitted]
    if status.mode_switch:
        parts.append(f"mode {status.mode.name}")
    if status.latched:
        parts.append(stopped_by(status))
    parts += [f"FAULT {fault}" for fault in status.faults]
    parts += [f"NOTE {notice}" for notice in notes(status)]
    return "  ".join(parts)


def farewell(status: Status) -> str:
    """The state in which the box has ended."""
    places = [f"{axis.value} {_last(status.axis(axis))}" for axis in status.fitted]
    lines = [f"The box has ended and turns nothing any more. The antenna is at {', '.join(places)}."]
    return "\n".join([*lines, *(f"FAULT {fault}" for fault in status.faults)])


def _last(axis: AxisStatus) -> str:
    if axis.shown_deg is None:
        return "unknown"
    return stands(axis) + axis.error_text + ("" if axis.seen else " (last seen)")


def _axis(status: Status, axis: Axis) -> str:
    each = status.axis(axis)
    words = [f"{axis.value} {stands(each, 0)}{each.error_text}"]
    if not each.seen and each.shown_deg is not None:
        words.append("LAST SEEN")
    if each.target_deg is not None:
        words.append(f"to {degrees(each.target_deg)}")
    if each.drive is not Direction.OFF:
        words.append(TURNS[axis, each.drive])
    if each.by_itself_dps:
        words.append(f"TURNS {TURNS[axis, Direction.PLUS if each.by_itself_dps > 0 else Direction.MINUS]} BY ITSELF")
    if each.uncalibrated:
        reads = "" if each.raw is None else f"; its sensor reads {round(each.raw, 3)}"
        words.append(f"UNCALIBRATED (needs {each.uncalibrated}{reads})")
    return " ".join(words)
