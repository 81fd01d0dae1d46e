"""What radio amateurs call their rotors, and which `type` drives each.

Knows names on boxes and how each rotor tells its angle. Does not know the tables of a type.
"""

from __future__ import annotations

import re

from rotator.config.kinds import KindName

_POTS = "motors on relays, a pot that tells the angle"
_COUNTED = "motors on relays, a contact that is counted"
_BRAKE = f"{_POTS}; its brake is not driven: release it another way"

_PROTOCOLS = r"gs232[ab]?|rs?232|rotctld?|hamlib|easycomm\w*|dcu1|md0[12]|rot[12]prog"
_ROTORS: tuple[tuple[str, KindName, str, str], ...] = (
    (r"(yaesu|kenpro)?[gk]r?s?5[456]00(dc|ac|a|b)?", "relay-pot", "g5500", _POTS),
    (r"(yaesu|kenpro)?[gk]r?s?(400|450|500|550|600|650|800|1000|2000|2700|2800)(rc|sdx|dxa|dxc|xl|sa|a|c|dc)?",
     "relay-pot", "g5500", _POTS),
    (r"(cde|hygain|cd)?ham(ii|iii|iv|v|[2345m])?|t2x|tailtwister|cd(e|44|45)?(ii)?", "relay-pot", "f1efw", _BRAKE),
    (r"(cde|hygain)?ar(20|22|30|33|35|40)x?[lx]?l?", "relay-pot", "f1efw", _POTS),
    (r"f1efw|arduino|sketch|relays?|pots?|relaypots?|potentiometer", "relay-pot", "f1efw", _POTS),
    (r"(create)?rc5\w*|emotator\w*|prosistel\w*|pst\d+\w*|(alliance)?hd73|kr\d+\w*", "relay-pot", "f1efw", _POTS),
    (r"(alfa|alpha)?spid|(big)?ras(hr|2)?|rak|rau", "relay-pulse", "u100",
     f"{_COUNTED}, as sold; with pots of your own write \"relay-pot\""),
    (r"(m2)?(orion)?(or|rc)?2800(px|pdc|g)?|orion|m2", "relay-pulse", "u100", _COUNTED),
    (r"(alliance)?[ut]1[01]0|alliance|ko6th|relaypulses?|pulses?|counter|reed|hall", "relay-pulse", "u100", _COUNTED),
    (r"orbit(360)?|aa2tx|mcp410\d\d|digitalpot|digipots?", "digipot", "orbit360", "a digital pot in place of a knob"),
    (r"isel|mjbots|moteus\w*|canfd", "moteus", "isel", "two moteus controllers"),
    (r"(sg|mg|ds|hs)\d+\w*|hobbyservos?|servos|pca9685", "servo", "servos", "two hobby servos"),
)  # fmt: skip
"""Names in small letters without spaces and signs; the type; the shipped file to begin with; how the rotor works."""


def type_of(name: str) -> str | None:
    """Advice for a rotor's name where a type belongs: `"G-5500"`; None: no rotor that is known."""
    for bare in _written(name):
        if re.fullmatch(_PROTOCOLS, bare):
            return "that is a protocol, which belongs in a [[link]]: the usual rotor is relay-pot"
        for pattern, kind, profile, how in _ROTORS:
            if re.fullmatch(pattern, bare):
                return f'write "{kind}" ({how}); `rotator config {profile}` prints a file to begin with'
    return None


def shipped_file(name: str) -> str | None:
    """The shipped configuration to begin with, by a rotor's name; None: no rotor that is known."""
    names = _written(name)
    return next((profile for bare in names for pattern, _, profile, _ in _ROTORS if re.fullmatch(pattern, bare)), None)


def _written(name: str) -> list[str]:
    """The name and each of its words, as the patterns write them."""
    return [re.sub(r"[^a-z0-9]", "", word) for word in (name.lower(), *name.lower().split())]
