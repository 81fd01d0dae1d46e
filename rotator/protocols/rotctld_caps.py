"""What the box tells rotctld's clients about itself: model, limits, abilities, settings, and the flags of motion.

The box answers as a GS-232B, Hamlib's model 603. Decides which limits it reports: never narrower than the sky.
Knows the status and Hamlib's words for it. Gives no orders: the settings that a client may make have no effect.
"""

from __future__ import annotations

from hw.ports import Axis
from rotator import __version__
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols.rotctld import INVALID_PARAMETER, NOT_AVAILABLE, Answer, BadRequest, number

SPEEDS = (1, 2, 3, 4)
SPEED_RANGE = f"({SPEEDS[0]}..{SPEEDS[-1]}/1)"
_MODEL = 603
"""Hamlib's number for a GS-232B."""
_AT_END_DEG = 0.5
"""An axis nearer than this to an end of its range counts as at that end."""

_NO_EFFECT = {
    "write_delay": "Delay between bytes in ms. No effect: the box has no serial port here.",
    "post_write_delay": "Delay between commands in ms. No effect: the box has no serial port here.",
    "timeout": "Timeout in ms. No effect: the box has no serial port here.",
    "retry": "Number of retries. No effect: the box has no serial port here.",
}
"""A client may set any value; the box ignores it. Hamlib's clients set these for a controller on a serial port."""
_FIXED = {
    "min_az": "Lowest azimuth that the box accepts, in degrees. Cannot be set here.",
    "max_az": "Highest azimuth that the box accepts, in degrees. Cannot be set here.",
    "min_el": "Lowest elevation that the box accepts, in degrees. Cannot be set here.",
    "max_el": "Highest elevation that the box accepts, in degrees. Cannot be set here.",
    "south_zero": "Always 0: azimuth 0 is north.",
}
"""A client may only set the value that the box has already."""
_SETTINGS = _NO_EFFECT | _FIXED
_TYPES = {
    (Axis.AZIMUTH, Axis.ELEVATION): ("AzEl", "Az-El"),
    (Axis.AZIMUTH,): ("Az", "Azimuth"),
    (Axis.ELEVATION,): ("El", "Elevation"),
}
"""By the axes that the rotor has: Hamlib's names of its type, in the state and among the abilities."""
_CAPS_HEAD = (
    f"Caps dump for model:\t{_MODEL}",
    "Model name:\t\tGS-232B",
    "Mfg name:\t\tgs232-rotator",
    f"Backend version:\t{__version__}",
    "Backend copyright:\tMIT",
    "Backend status:\t\tStable",
)
_CAPS_MIDDLE = (
    "Port type:\t\tNone",
    "Write delay:\t\t0mS, timeout 0mS, 0 retries",
    "Post Write delay:\t0mS",
    "Status flags: MOVING MOVING_AZ MOVING_LEFT MOVING_RIGHT",
    "Status flags: MOVING_EL MOVING_UP MOVING_DOWN",
    "Status flags: LIMIT_UP LIMIT_DOWN LIMIT_LEFT LIMIT_RIGHT",
    "Status flags: OVERLAP_DOWN OVERLAP_LEFT OVERLAP_RIGHT",
    "Get functions: ",
    "Set functions: ",
    f"Get level: SPEED{SPEED_RANGE} ",
    f"Set level: SPEED{SPEED_RANGE} ",
    "Get parameters: ",
    "Set parameters: ",
)
_CAPS_END = (
    "Has priv data:\t\tN",
    *(f"Has {what}:\t\tY" for what in ("Init", "Cleanup", "Open", "Close")),
    "Can set Conf:\t\tY",
    "Can get Conf:\t\tY",
    "Can set Position:\tY",
    "Can get Position:\tY",
    *(f"Can {what}:\t\tY" for what in ("Stop", "Park", "Reset", "Move", "get Info", "get Status")),
    "Can set Func:\tN",
    "Can get Func:\tN",
    "Can set Level:\tY",
    "Can get Level:\tY",
    "Can set Param:\tN",
    "Can get Param:\tN",
    "",
    "Overall backend warnings: 0",
)


def limits(status: Status) -> dict[str, float]:
    """The lowest and highest angles in degrees that the box reports, because some clients send nothing outside them.

    The axes' own, and at least 0 to 360 and 0 to 180 for a rotor with a smaller range: the box itself finds the axis
    angles for every direction. The lowest azimuth is below 0 only if the rotor's is, because CQRLOG takes a negative
    one for a shifted scale. Also of an axis that is not fitted: with 0 to 0 Hamlib would send nothing of a satellite
    that is up.
    """
    azimuth, elevation = status.azimuth, status.elevation
    return {
        "min_az": min(0.0, azimuth.min_deg),
        "max_az": max(360.0, azimuth.max_deg),
        "min_el": min(0.0, elevation.min_deg),
        "max_el": max(180.0, elevation.max_deg),
    }


def dump_state(status: Status) -> Answer:
    """Model and limits, for a Hamlib client that connects.

    In the default protocol: lines of bare numbers, which Hamlib up to 4.5.0 reads, then `key=value` lines, which later
    versions read. In the extended protocol: lines with labels.
    """
    angles = limits(status)
    names = ("Minimum Azimuth", "Maximum Azimuth", "Minimum Elevation", "Maximum Elevation")
    labelled = tuple((name, f"{value:.6f}") for name, value in zip(names, angles.values(), strict=True))
    head = (("rotctld Protocol Ver", "1"), ("Rotor Model", f"{_MODEL}"))
    rows = ["1", f"{_MODEL}", *(f"{value:.6f}" for value in angles.values()), "0"]
    rows += [f"{key}={value:.6f}" for key, value in angles.items()]
    rot_type = f"rot_type={_TYPES[status.fitted][0]}"
    rows += ["south_zero=0", rot_type, "done"]
    return Answer(
        records=(*head, *labelled, ("South Zero", "0"), ("", rot_type), ("", "done")),
        default_text="".join(row + "\n" for row in rows),
    )


def dump_caps(status: Status) -> Answer:
    """The abilities, in the same lines as Hamlib's own server writes for a GS-232B."""
    angles = limits(status)
    lines = [
        *_CAPS_HEAD,
        f"Rot type:\t\t{_TYPES[status.fitted][1]}",
        *_CAPS_MIDDLE,
        f"Min Azimuth:\t\t{angles['min_az']:.2f}",
        f"Max Azimuth:\t\t{angles['max_az']:.2f}",
        f"Min Elevation:\t\t{angles['min_el']:.2f}",
        f"Max Elevation:\t\t{angles['max_el']:.2f}",
        *_CAPS_END,
    ]
    return Answer(text="".join(line + "\n" for line in lines), always_reports=True)


def dump_conf(status: Status, *, always_reports: bool) -> Answer:
    """Every setting with its meaning and value. `always_reports`: a line RPRT follows in the default protocol too."""
    rows = [_setting_rows(name, meaning, _setting(name, status)) for name, meaning in _SETTINGS.items()]
    return Answer(text="".join(rows), always_reports=always_reports)


def get_conf(name: str, status: Status) -> Answer:
    """One setting and its value. Raises BadRequest for an unknown name."""
    if name not in _SETTINGS:
        raise BadRequest(INVALID_PARAMETER)
    return Answer(text=f"{name}={_setting(name, status)}\n")


def set_conf(name: str, value: str, status: Status) -> Answer:
    """Accept a value without effect. Raises BadRequest for an unknown name, and for a new limit.

    Only the configuration sets limits: a client on the network must not widen them.
    """
    if name not in _SETTINGS:
        raise BadRequest(INVALID_PARAMETER)
    if number(value) != float(_setting(name, status)) and name in _FIXED:
        raise BadRequest(NOT_AVAILABLE)
    return Answer()


def status_words(status: Status) -> str:
    """Hamlib's flags for the present state, each followed by a blank. Empty when no flag is true."""
    azimuth, elevation = status.azimuth, status.elevation
    azimuth_deg, elevation_deg = azimuth.angle_deg, elevation.angle_deg
    at_left, at_right = _at_ends(azimuth)
    at_bottom, at_top = _at_ends(elevation)
    flags = {
        "MOVING": status.moving,
        "MOVING_AZ": azimuth.moving,
        "MOVING_LEFT": azimuth.drive < 0,
        "MOVING_RIGHT": azimuth.drive > 0,
        "MOVING_EL": elevation.moving,
        "MOVING_UP": elevation.drive > 0,
        "MOVING_DOWN": elevation.drive < 0,
        "LIMIT_UP": at_top,
        "LIMIT_DOWN": at_bottom,
        "LIMIT_LEFT": at_left,
        "LIMIT_RIGHT": at_right,
        "OVERLAP_DOWN": elevation_deg is not None and elevation_deg < 0,
        "OVERLAP_LEFT": azimuth_deg is not None and azimuth_deg < 0,
        "OVERLAP_RIGHT": azimuth_deg is not None and azimuth_deg > 360,
    }
    return "".join(f"{word} " for word, is_true in flags.items() if is_true)


def _at_ends(axis: AxisStatus) -> tuple[bool, bool]:
    """Whether an axis is at its low end, and whether it is at its high end. Neither while its angle is not known."""
    if axis.angle_deg is None or not axis.fitted or axis.endless:
        return False, False
    return axis.angle_deg <= axis.min_deg + _AT_END_DEG, axis.angle_deg >= axis.max_deg - _AT_END_DEG


def _setting_rows(name: str, meaning: str, value: str) -> str:
    return f'{name}: "{meaning}"\n\tDefault: {value}, Value: {value}\n'


def _setting(name: str, status: Status) -> str:
    angles = limits(status)
    return f"{angles[name]:.6f}" if name in angles else "0"
