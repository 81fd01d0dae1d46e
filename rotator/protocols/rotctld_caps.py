"""The box's description for rotctld's clients: limits, abilities, settings, and the state of motion.

Knows the status and Hamlib's words for it. Changes nothing: the settings that a client may make have no effect.
"""

from __future__ import annotations

from rotator import __version__
from rotator.protocols.rotctld import INVALID_PARAMETER, NOT_AVAILABLE, Answer, BadRequest, number
from rotator.status import Status

SPEEDS = (1, 2, 3, 4)
SPEED_RANGE = f"({SPEEDS[0]}..{SPEEDS[-1]}/1)"
_PRETENDED_MODEL = 603
_AT_AN_END_DEG = 0.5

_NO_EFFECT = {
    "write_delay": "Delay in ms between bytes: there is no port behind this, so without effect",
    "post_write_delay": "Delay in ms between commands: likewise",
    "timeout": "Timeout in ms: likewise",
    "retry": "Number of retries: likewise",
}
"""Settings that Hamlib's clients make without need."""
_FIXED = {
    "min_az": "Lowest azimuth in degrees; the box's configuration has it",
    "max_az": "Highest azimuth in degrees; likewise",
    "min_el": "Lowest elevation in degrees; likewise",
    "max_el": "Highest elevation in degrees; likewise",
    "south_zero": "Zero of azimuth is south: it never is",
}
_CAPS_HEAD = (
    f"Caps dump for model:\t{_PRETENDED_MODEL}",
    "Model name:\t\tGS-232B",
    "Mfg name:\t\tgs232-rotator",
    f"Backend version:\t{__version__}",
    "Backend copyright:\tMIT",
    "Backend status:\t\tStable",
    "Rot type:\t\tAz-El",
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
    """The angles that the box accepts, in degrees, for clients that enforce them.

    Azimuth covers at least the whole circle and elevation 0 to 180, because the box turns every direction into axis
    angles itself. Azimuth begins below zero only if the rotor does: CQRLOG takes that for a shifted scale.
    """
    min_az_deg = min(0.0, status.azimuth.min_deg)
    max_az_deg = max(360.0, status.azimuth.max_deg)
    return {"min_az": min_az_deg, "max_az": max_az_deg, "min_el": 0.0, "max_el": 180.0}


def dump_state(status: Status) -> Answer:
    """Numbers alone for Hamlib up to 4.5.0, then `key=value` for later ones. The extended protocol has labels."""
    angles = limits(status)
    names = ("Minimum Azimuth", "Maximum Azimuth", "Minimum Elevation", "Maximum Elevation")
    labelled = tuple((name, f"{value:.6f}") for name, value in zip(names, angles.values(), strict=True))
    head = (("rotctld Protocol Ver", "1"), ("Rotor Model", f"{_PRETENDED_MODEL}"))
    rows = ["1", f"{_PRETENDED_MODEL}", *(f"{value:.6f}" for value in angles.values()), "0"]
    rows += [f"{key}={value:.6f}" for key, value in angles.items()]
    rows += ["south_zero=0", "rot_type=AzEl", "done"]
    return Answer(
        records=(*head, *labelled, ("South Zero", "0"), ("", "rot_type=AzEl"), ("", "done")),
        default_text="".join(row + "\n" for row in rows),
    )


def dump_caps(status: Status) -> Answer:
    """The abilities, in the lines of Hamlib's own server for a GS-232B."""
    angles = limits(status)
    lines = [
        *_CAPS_HEAD,
        f"Min Azimuth:\t\t{angles['min_az']:.2f}",
        f"Max Azimuth:\t\t{angles['max_az']:.2f}",
        f"Min Elevation:\t\t{angles['min_el']:.2f}",
        f"Max Elevation:\t\t{angles['max_el']:.2f}",
        *_CAPS_END,
    ]
    return Answer(text="".join(line + "\n" for line in lines), always_reports=True)


def dump_conf(status: Status, *, always_reports: bool) -> Answer:
    """Every setting with its meaning and value."""
    rows = [
        f'{name}: "{meaning}"\n\tDefault: {value}, Value: {value}\n'
        for name, meaning in (_NO_EFFECT | _FIXED).items()
        for value in (_setting(name, status),)
    ]
    return Answer(text="".join(rows), always_reports=always_reports)


def get_conf(name: str, status: Status) -> Answer:
    """Raises BadRequest for an unknown name."""
    if name not in _NO_EFFECT | _FIXED:
        raise BadRequest(INVALID_PARAMETER)
    return Answer(text=f"{name}={_setting(name, status)}\n")


def set_conf(name: str, value: str, status: Status) -> Answer:
    """Accepts a value that changes nothing. Raises BadRequest for others: only the configuration sets limits."""
    if name not in _NO_EFFECT | _FIXED:
        raise BadRequest(INVALID_PARAMETER)
    if number(value) != float(_setting(name, status)) and name in _FIXED:
        raise BadRequest(NOT_AVAILABLE)
    return Answer()


def status_words(status: Status) -> str:
    """Hamlib's flags, each followed by a blank; empty while the antenna rests between its ends."""
    azimuth, elevation = status.azimuth, status.elevation
    azimuth_deg, elevation_deg = azimuth.angle_deg, elevation.angle_deg
    flags = {
        "MOVING": status.moving,
        "MOVING_AZ": azimuth.moving,
        "MOVING_LEFT": azimuth.drive < 0,
        "MOVING_RIGHT": azimuth.drive > 0,
        "MOVING_EL": elevation.moving,
        "MOVING_UP": elevation.drive > 0,
        "MOVING_DOWN": elevation.drive < 0,
        "LIMIT_UP": elevation_deg is not None and elevation_deg >= elevation.max_deg - _AT_AN_END_DEG,
        "LIMIT_DOWN": elevation_deg is not None and elevation_deg <= elevation.min_deg + _AT_AN_END_DEG,
        "LIMIT_LEFT": azimuth_deg is not None and azimuth_deg <= azimuth.min_deg + _AT_AN_END_DEG,
        "LIMIT_RIGHT": azimuth_deg is not None and azimuth_deg >= azimuth.max_deg - _AT_AN_END_DEG,
        "OVERLAP_DOWN": elevation_deg is not None and elevation_deg < 0,
        "OVERLAP_LEFT": azimuth_deg is not None and azimuth_deg < 0,
        "OVERLAP_RIGHT": azimuth_deg is not None and azimuth_deg > 360,
    }
    return "".join(f"{word} " for word, is_so in flags.items() if is_so)


def _setting(name: str, status: Status) -> str:
    angles = limits(status)
    return f"{angles[name]:.6f}" if name in angles else "0"
