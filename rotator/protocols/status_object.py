"""The status as one object of plain values, for programs: `rotator where --json`, and every API of the box.

Knows the names of the fields, what each means, and how it is read from a status. The documentation is made from the
same table. Does not know JSON, nor who asks. A field is never renamed or removed while FORMAT stays; fields may come.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Generic, TypeVar

from rotator.exchange.faults import Fault
from rotator.exchange.status import AxisStatus, Flown, Status

FORMAT = 1
DIGITS = 2
"""Angles have so many decimals: more than any sensor of a rotor."""

Plain = str | int | float | bool | None | list["Plain"] | dict[str, "Plain"]
Of = TypeVar("Of")


@dataclass(frozen=True, slots=True)
class Field(Generic[Of]):
    name: str
    kind: str
    """The type in JSON, for the documentation."""
    meaning: str
    of: Callable[[Of], Plain]


FAULT_FIELDS: Sequence[Field[Fault]] = (
    Field("kind", "text", "the name of the fault, as in docs/troubleshooting.md", lambda fault: fault.kind.text),
    Field("measured", "text", "what was measured", lambda fault: fault.measured),
    Field("limit", "text or null", "the limit that was exceeded", lambda fault: fault.limit or None),
    Field("page", "text", "the page and the heading that explain it", lambda f: f"{f.page}#{f.kind.anchor}"),
    Field("act_now", "text or null", "what a person must do this moment", lambda fault: fault.act_now or None),
    Field("text", "text", "all of it in one sentence", str),
)
AXIS_FIELDS: Sequence[Field[AxisStatus]] = (
    Field("angle_deg", "number or null", "where it stands on the rotor's own scale",
          lambda axis: _angle(axis.shown_deg)),
    Field("angle_is_current", "boolean", "false: the angle is the sensor's last good one",
          lambda axis: axis.angle_deg is not None and axis.seen),
    Field("angle_source", "text", '"measured", "counted" or "modelled"', lambda axis: axis.source.value),
    Field("error_deg", "number or null", "how far an angle reckoned by time may be off; null: lost, or not by time",
          lambda axis: _angle(axis.error_deg) if isfinite(axis.error_deg or 0.0) else None),
    Field("target_deg", "number or null", "the angle that it turns to",
          lambda axis: _angle(axis.target_deg)),
    Field("ordered_deg", "number or null", "the angle last ordered, also while a fault keeps it from there",
          lambda axis: _angle(axis.ordered_deg)),
    Field("at_target", "boolean", "it stands, near enough to its target",
          lambda axis: axis.at_target),
    Field("moving", "boolean", "it turns, or still coasts", lambda axis: axis.moving),
    Field("by_itself_dps", "number", "its speed while its motor is off; positive: clockwise, up",
          lambda axis: round(axis.by_itself_dps, 1)),
    Field("drive", "number", "1: driven clockwise or up; -1: the other way; 0: off", lambda axis: int(axis.drive)),
    Field("homing", "boolean", "it looks for its end stop", lambda axis: axis.homing),
    Field("fitted", "boolean", "the rotor has this axis", lambda axis: axis.fitted),
    Field("homeable", "boolean", "`rotator home` has an effect", lambda axis: axis.homeable),
    Field("min_deg", "number", "the low end of its range", lambda axis: _angle(axis.min_deg)),
    Field("max_deg", "number", "the high end of its range", lambda axis: _angle(axis.max_deg)),
    Field("fault", "object or null", "the fault that holds it", lambda axis: _fault(axis.fault)),
    Field("fault_present", "boolean", "the cause of the fault is still seen: `rotator resume` does not end it now",
          lambda axis: axis.fault_present),
    Field("confirmable", "boolean", "`rotator confirm` has an effect", lambda axis: axis.confirmable),
    Field("relays_in_doubt", "boolean", "`rotator relays-checked` has an effect",
          lambda axis: axis.relays_in_doubt),
    Field("missing", "list of text", "what it needs before it may be aimed: calibration, homing …",
          lambda axis: [each.text for each in axis.missing]),
    Field("notes", "list of text", "what a person should know though it stops nothing",
          lambda axis: [str(notice) for notice in axis.notices]),
)  # fmt: skip
FLOWN_FIELDS: Sequence[Field[tuple[Flown, float]]] = (
    Field("name", "text", "the target", lambda each: each[0].name),
    Field("begins_in_s", "number", "when it rises; negative: it is up",
          lambda each: round(each[0].begin_s - each[1], 1)),
    Field("ends_in_s", "number or null", "when it sets; null: it does not",
          lambda each: round(each[0].end_s - each[1], 1) if isfinite(each[0].end_s) else None),
    Field("expected_error_deg", "number", "how far it may be from where it is computed",
          lambda each: _angle(each[0].expected_error_deg)),
    Field("beyond_beam", "boolean", "that is more than half of the antenna's beam",
          lambda each: each[0].beyond_beam),
    Field("table", "boolean", "a table that a person has handed in", lambda each: each[0].table),
    Field("recognised", "boolean", "in the orders of a program; false: the box tracks it by itself",
          lambda each: each[0].recognised),
)  # fmt: skip


def _flown(status: Status) -> dict[str, Plain] | None:
    flown = status.flown
    return None if flown is None else {field.name: field.of((flown, status.at_s)) for field in FLOWN_FIELDS}


FIELDS: Sequence[Field[Status]] = (
    Field("format", "number", f"{FORMAT}; another number only when a field is renamed or removed", lambda _: FORMAT),
    Field("azimuth", "object", "the axis, as below", lambda status: _axis(status.azimuth)),
    Field("elevation", "object", "the axis, as below", lambda status: _axis(status.elevation)),
    Field("wanted_azimuth_deg", "number or null", "the direction last ordered",
          lambda status: _angle(status.wanted_azimuth_deg)),
    Field("wanted_elevation_deg", "number or null", "the same for elevation",
          lambda status: _angle(status.wanted_elevation_deg)),
    Field("nudge_azimuth_deg", "number", "so much of that is a person's nudge, which ends with the pass",
          lambda status: _angle(status.nudge_azimuth_deg)),
    Field("nudge_elevation_deg", "number", "the same for elevation",
          lambda status: _angle(status.nudge_elevation_deg)),
    Field("moving", "boolean", "an axis turns or coasts", lambda status: status.moving),
    Field("moved_by", "text or null", "whose orders move the antenna", lambda status: status.controlled_by or None),
    Field("held_by", "text or null", "who has taken the antenna from the programs, and not given it back",
          lambda status: status.held_by or None),
    Field("tracks", "object or null", "what the box tracks by itself, as below", _flown),
    Field("stopped_by", "text or null", "who stopped or storm-parked it; nothing else moves it until `rotator resume`",
          lambda status: status.latched or None),
    Field("storm_park", "boolean", "`stopped_by` is a storm park", lambda status: status.storm),
    Field("panel_mode", "text", 'the mode: "auto", "manual", "jog" or "park"',
          lambda status: status.mode.value),
    Field("mode_by", "text or null", "who has set the mode", lambda status: status.mode_by or None),
    Field("supply_cut", "boolean", "a fault cuts the motors' supply", lambda status: status.cut),
    Field("notes", "list of text", "whose orders have no effect, and why", lambda status: list(status.notices)),
    Field("simulated", "boolean", "nothing real turns", lambda status: status.simulated),
    Field("orders_wait", "boolean", "the box has an order that shows in the next status, not in this one",
          lambda status: status.orders_wait),
)  # fmt: skip


def as_object(status: Status) -> dict[str, Plain]:
    return {field.name: field.of(status) for field in FIELDS}


def _axis(axis: AxisStatus) -> dict[str, Plain]:
    return {field.name: field.of(axis) for field in AXIS_FIELDS}


def _fault(fault: Fault | None) -> dict[str, Plain] | None:
    return None if fault is None else {field.name: field.of(fault) for field in FAULT_FIELDS}


def _angle(angle_deg: float | None) -> float | None:
    # Adding zero turns -0.0, from a noisy pot at its stop, into 0.0.
    return None if angle_deg is None else round(angle_deg, DIGITS) + 0.0
