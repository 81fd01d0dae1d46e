"""The table [rotor], and the step that fills in the defaults of its kind of rotor before the file is checked.

Knows where these defaults go, and that real hardware takes no limits from them. The defaults themselves are in
`rotator.config.kinds`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from rotator.config.kinds import KINDS, KindName
from rotator.config.kinds.kind import Usual
from rotator.config.table import Table


class Rotor(Table):
    type: KindName = "relay-pot"
    """Motors on relays with pots, or with counted contacts; two moteus controllers; two hobby servos; or control boxes
    with a digital pot in place of each knob."""
    hardware: Literal["sim", "pi"] = "sim"
    """A simulated rotor, or the relays, chips and display on this Pi."""

    @property
    def switched(self) -> bool:
        """Whether relays switch the motors on and off."""
        return KINDS[self.type].switched


USUAL: Mapping[KindName, Usual] = {name: kind.usual for name, kind in KINDS.items()}
"""The defaults of each kind that differ from those of a relay rotor with pots."""


def with_usual(values: dict[str, Any]) -> dict[str, Any]:
    """The file's values, and the defaults of its kind of rotor for keys that it leaves out. `values` stays as it is."""
    rotor = values.get("rotor")
    table: dict[str, Any] = rotor if isinstance(rotor, dict) else {}
    usual = next((places for kind, places in USUAL.items() if kind == table.get("type")), {})
    limits = {"min_deg", "max_deg"} if table.get("hardware") == "pi" else set()
    filled = dict(values)
    for place, keys in usual.items():
        parent = filled
        for part in place.split("."):
            inner = parent.get(part, {})
            if not isinstance(inner, dict):
                break
            parent[part] = dict(inner)
            parent = parent[part]
        else:
            for key, value in keys.items():
                if key not in limits:
                    parent.setdefault(key, value)
    return filled
