"""What radio amateurs call their rotors, and the shipped file that each begins with.

Knows names on boxes. Does not know the tables of a type.
"""

from __future__ import annotations

import re

_SHIPPED = {
    "g5500": (
        r"(yaesu|kenpro)?[gk]r?s?5[456]00(dc|ac|a|b)?",
        r"(yaesu|kenpro)?[gk]r?s?(400|450|500|550|600|650|800|1000|2000|2700|2800)(rc|sdx|dxa|dxc|xl|sa|a|c|dc)?",
    ),
    "f1efw": (
        r"(cde|hygain|cd)?ham(ii|iii|iv|v|[2345m])?|t2x|tailtwister|cd(e|44|45)?(ii)?",
        r"(cde|hygain)?ar(20|22|30|33|35|40)x?[lx]?l?",
        r"f1efw|arduino|sketch|relays?|pots?|relaypots?|potentiometer",
        r"(create)?rc5\w*|emotator\w*|prosistel\w*|pst\d+\w*|(alliance)?hd73|kr\d+\w*",
    ),
    "u100": (
        r"(alfa|alpha)?spid|(big)?ras(hr|2)?|rak|rau",
        r"(m2)?(orion)?(or|rc)?2800(px|pdc|g)?|orion|m2",
        r"(alliance)?[ut]1[01]0|alliance|ko6th|relaypulses?|pulses?|counter|reed|hall",
    ),
    "orbit360": (r"orbit(360)?|aa2tx|mcp410\d\d|digitalpot|digipots?",),
    "isel": (r"isel|mjbots|moteus\w*|canfd",),
    "servos": (r"(sg|mg|ds|hs)\d+\w*|hobbyservos?|servos|pca9685",),
}
"""By shipped file: names in small letters without spaces and signs. The first that fits counts."""


def shipped_file(name: str) -> str | None:
    """The shipped configuration to begin with, by a rotor's name; None: no rotor that is known."""
    written = [re.sub(r"[^a-z0-9]", "", word) for word in (name.lower(), *name.lower().split())]
    return next(
        (
            profile
            for bare in written
            for profile, patterns in _SHIPPED.items()
            if any(re.fullmatch(pattern, bare) for pattern in patterns)
        ),
        None,
    )
