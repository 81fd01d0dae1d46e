"""The text of the LCD, two rows of sixteen characters: the direction of the satellite, the direction of the antenna.

Knows the layout, and the notices that replace the upper row in turn. Does not know the display's chip or bus.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import ceil, isfinite
from types import MappingProxyType

from hw.ports import Axis
from rotator.exchange.orders import Mode
from rotator.exchange.spoken import short_sender
from rotator.exchange.status import Status
from rotator.protocols.aiming import bearing, whole
from rotator.views.words import rise_or_set

COLUMNS = 16
ALTERNATE_S = 2.0
"""Seconds that the upper row shows the satellite, or one notice, before it changes."""
PAIR_CODE, STOP, STORM, ALWAYS_UP = "PAIR CODE", "STOP", "STORM", "always up"
WIDTHS = {PAIR_CODE: COLUMNS - 7, STOP: 5, STORM: 5, ALWAYS_UP: 10}
"""Texts that leave room for more: how long a translation may be."""
BESIDE_AXIS = COLUMNS - 3
_SHORT = {Axis.AZIMUTH: "AZ", Axis.ELEVATION: "EL"}


def rows(
    status: Status, now_s: float, code: str = "", translated: Mapping[str, str] = MappingProxyType({})
) -> tuple[str, str]:
    """`SAT A:235 E:025` over `ANT A:231 E:024`; SIM in place of ANT when the rotor is simulated. With one axis alone
    its angle stands there alone.

    Where an angle is reckoned by time, `+/- A:006 E:004` takes turns with the lower row: how far it may be off.

    With a mode switch its letter follows: A, M, J or P. If it is not at AUTO, a notice says so.

    `code`: the code that pairs a browser now. It takes the upper row, and only faults alternate with it.
    `translated`: the texts in another language, by the English ones. SAT, ANT, SIM, AZ, EL and the modes stay.
    """
    name = "SIM" if status.simulated else "ANT"
    upper = " ".join(["SAT", *(_NUMBER[axis](status.wanted_deg(axis)) for axis in status.fitted)])
    lower = " ".join([name, *(_NUMBER[axis](status.axis(axis).points_deg) for axis in status.fitted)])
    if any(status.axis(axis).error_deg for axis in Axis) and int(now_s / ALTERNATE_S) % 2:
        errors = [f"{_SHORT[axis][0]}:{_error(status.axis(axis).error_deg)}" for axis in status.fitted]
        lower = " ".join(["+/-", *errors])
    notices = _notices(status, lambda text: translated.get(text, text))
    if code:
        upper = f"{translated.get(PAIR_CODE, PAIR_CODE)} {code}"
        notices = notices if status.faults else []
    turn = int(now_s / ALTERNATE_S)
    if notices and turn % 2:
        upper = notices[turn // 2 % len(notices)]
    if status.mode_switch:
        lower += status.mode.name[0]
    return upper[:COLUMNS].ljust(COLUMNS), lower[:COLUMNS].ljust(COLUMNS)


def _notices(status: Status, say: Callable[[str], str]) -> list[str]:
    notices = [say(fault.act_now) for fault in status.faults if fault.act_now]
    notices += [f"{_SHORT[fault.axis]} {say(fault.lcd)}" for fault in status.faults]
    if status.latched:
        notices.append(f"{say(STORM if status.storm else STOP)}: {say(short_sender(status.latched))}")
    if status.unkept is not None:
        notices.append(say(status.unkept.lcd))
    if status.mode is not Mode.AUTO:
        notices.append(f"MODE {status.mode.name}")
    for axis in status.fitted:
        if missing := status.axis(axis).missing:
            notices.append(f"{_SHORT[axis]} {say(missing[0].lcd)}")
    # A notice without a text for the LCD is only in the log.
    for axis in status.fitted:
        notices += [f"{_SHORT[axis]} {say(notice.lcd)}" for notice in status.axis(axis).notices if notice.lcd]
    if status.flown is not None:
        when = rise_or_set(status.flown, status.at_s, short=True)
        when = say(when) if when == ALWAYS_UP else when
        notices.append(f"{status.flown.name[: COLUMNS - 1 - len(when)]} {when}")
        if status.flown.beyond_beam:
            notices.append(f"OFF BY <={status.flown.expected_error_deg:.0f}DEG?")
    return list(dict.fromkeys(notices))


def _error(error_deg: float | None) -> str:
    """How far an angle may be off, rounded up; `---`: it is lost."""
    return f"{ceil(error_deg or 0.0):03d}" if isfinite(error_deg or 0.0) else "---"


def _azimuth(angle_deg: float | None) -> str:
    return "A:---" if angle_deg is None else f"A:{bearing(angle_deg):03d}"


def _elevation(angle_deg: float | None) -> str:
    return "E:---" if angle_deg is None else f"E:{whole(angle_deg):03d}"


_NUMBER = {Axis.AZIMUTH: _azimuth, Axis.ELEVATION: _elevation}
