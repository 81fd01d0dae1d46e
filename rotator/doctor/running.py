"""The check of the running box: its faults, who has stopped it, and its notes, as it tells them itself.

Knows the fields of its status (`rotator.protocols.status_object`). Does not know how the box is asked.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from hw.ports import Axis
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine, Silent
from rotator.exchange.spoken import held_by, sender, spoken

START_ANEW = (
    "Keep its log, then start it anew: sudo systemctl restart rotator; without the service Ctrl-C and rotator run."
)


def running_box(machine: Machine) -> Iterator[Finding]:
    match machine.ask_box():
        case None:
            yield fine("none runs now")
        case Silent(why):
            yield wrong(f"{why}: it stands still, and takes no stop", START_ANEW)
        case str(why):
            yield skipped(why)
        case status:
            found = [*_faults(status), *_held(status), *_lacks(status), *_notes(status)]
            yield from found or [fine("it runs, and no axis has a fault")]


def _faults(status: dict[str, Any]) -> Iterator[Finding]:
    for axis in Axis:
        if fault := status[axis.value]["fault"]:
            yield wrong(str(fault["text"]), "rotator resume, when it is repaired.")


def _held(status: dict[str, Any]) -> Iterator[Finding]:
    if by := status["stopped_by"]:
        yield warn(held_by(sender(by), storm=status["storm_park"]), "rotator resume lets it move again.")
    if (mode := status["panel_mode"]) != "auto":
        yield warn(f"the panel's switch is at {mode.upper()}: programs move nothing", "Turn the switch to AUTO.")


def _lacks(status: dict[str, Any]) -> Iterator[Finding]:
    for axis in Axis:
        if "homing" in status[axis.value]["missing"]:
            tell = f"Look where it points, and: rotator confirm {axis.value} DEGREES"
            home = f"Watch the antenna, and: rotator home {axis.value}"
            told = status[axis.value]["confirmable"] and not status[axis.value]["homeable"]
            yield warn(f"{axis.value} needs homing", tell if told else home)


def _notes(status: dict[str, Any]) -> Iterator[Finding]:
    notes = [*status["notes"], *(f"{axis.value}: {note}" for axis in Axis for note in status[axis.value]["notes"])]
    for note in notes:
        yield warn(spoken(note), "rotator where shows whether it is still so.")
