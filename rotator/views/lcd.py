"""Two rows of sixteen characters: where the satellite is, where the antenna is.

Knows the layout, and the notices that replace the upper row for a moment. Does not know the display.
"""

from __future__ import annotations

from hw.ports import Axis
from rotator.protocols.gs232 import whole
from rotator.status import Status

COLUMNS = 16
ALTERNATE_S = 2.0
"""Satellite and notices take the upper row in turn, for this long each."""
_SHORT = {Axis.AZIMUTH: "AZ", Axis.ELEVATION: "EL"}
_SHORT_FAULTS = {
    "pot open or shorted": "POT OPEN/SHRT",
    "motor runs and pot stands still": "STANDS STILL",
    "pot moves the wrong way": "WRONG WAY",
    "turning with no relay on": "TURNS BY SELF",
    "motor on longer than the travel takes": "RUN TOO LONG",
    "end stop reached": "END STOP",
    "control thread late": "CONTROL LATE",
    "limit switch reached": "LIMIT SWITCH",
    "count not kept": "COUNT UNKEPT",
    "axis does not follow": "NOT FOLLOWING",
    "controller fault": "CTRL FAULT",
    "controller silent": "CTRL SILENT",
    "position unknown": "POS UNKNOWN",
}
"""For faults whose name is longer than the thirteen characters beside the axis."""
_SHORT_NOTICES = {
    "turning with no relay on": "TURNS BY SELF",
    "still turning with the master open": "STILL TURNS",
    "motor hot": "MOTOR HOT",
    "its velocity limit": "SPEED LIMIT",
    "its power limit": "POWER LIMIT",
    "the supply voltage": "SUPPLY VOLTS",
    "its current limit": "CURRENT LIMIT",
    "its own temperature": "DRIVER WARM",
    "the motor's temperature": "MOTOR WARM",
    "its torque limit": "TORQUE LIMIT",
    "its position bounds (servopos.position_min, position_max)": "SERVOPOS",
    "braking that feeds the supply": "BRAKING",
    "field weakening": "FIELD WEAK",
}
"""By the text of a notice before its colon. Other notices are not shown here: they would hide the satellite for the
whole pass. The log has them."""


def rows(status: Status, now_s: float) -> tuple[str, str]:
    """`SAT A:235 E:025` over `ANT A:231 E:024`; SIM in place of ANT when the rotor is simulated."""
    name = "SIM" if status.simulated else "ANT"
    upper = f"SAT A:{_azimuth(status.wanted_azimuth_deg)} E:{_elevation(status.wanted_elevation_deg)}"
    lower = f"{name} A:{_azimuth(status.azimuth.angle_deg)} E:{_elevation(status.elevation.angle_deg)}"
    notices = _notices(status)
    turn = int(now_s / ALTERNATE_S)
    if notices and turn % 2:
        upper = notices[turn // 2 % len(notices)]
    return upper[:COLUMNS].ljust(COLUMNS), lower[:COLUMNS].ljust(COLUMNS)


def _notices(status: Status) -> list[str]:
    notices = [fault.act_now for fault in status.faults if fault.act_now]
    notices += [
        (f"{_SHORT[fault.axis]} " if fault.axis else "") + _SHORT_FAULTS.get(fault.name, fault.name.upper())
        for fault in status.faults
    ]
    if status.latched:
        notices.append("STOP: " + status.latched.upper())
    for axis in Axis:
        if missing := status.axis(axis).uncalibrated:
            notices.append(f"{_SHORT[axis]} {'NOT HOMED' if missing.startswith('homing') else 'UNCALIBRATED'}")
    for axis in Axis:
        heads = [notice.partition(":")[0] for notice in status.axis(axis).notices]
        notices += [f"{_SHORT[axis]} {_SHORT_NOTICES[head]}" for head in heads if head in _SHORT_NOTICES]
    return list(dict.fromkeys(notices))


def _azimuth(angle_deg: float | None) -> str:
    if angle_deg is None:
        return "---"
    rounded = whole(angle_deg)
    return f"{rounded if 0 <= rounded <= 360 else rounded % 360:03d}"


def _elevation(angle_deg: float | None) -> str:
    return "---" if angle_deg is None else f"{whole(angle_deg):03d}"
