"""The table [rotor], and what is usual for each kind of rotor.

Knows how the defaults of a kind go beneath the values of a file. The kinds themselves are in `rotator.config.kinds`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from rotator.config.kinds import KINDS, KindName
from rotator.config.kinds.kind import Usual
from rotator.config.table import Table


class Rotor(Table):
    type: KindName = "relay-pot"
    """How the rotor is driven and measured: motors on relays with pots, or with a contact that is counted; two moteus
    controllers; two hobby servos; or a control box with a digital pot for a knob."""
    hardware: Literal["sim", "pi"] = "sim"
    """A simulated rotor, or the relays, chips and display on this Pi."""

    @property
    def switched(self) -> bool:
        """Whether its motors are only on or off, by relays."""
        return KINDS[self.type].switched


USUAL: Mapping[KindName, Usual] = {name: kind.usual for name, kind in KINDS.items()}
"""What each kind has in place of a relay rotor's defaults, where the file does not say."""


def with_usual(values: dict[str, Any]) -> dict[str, Any]:
    """The file's values, with what is usual for its kind of rotor beneath them."""
    rotor = values.get("rotor")
    said: dict[str, Any] = rotor if isinstance(rotor, dict) else {}
    usual = next((places for kind, places in USUAL.items() if kind == said.get("type")), {})
    limits = {"min_deg", "max_deg"} if said.get("hardware") == "pi" else set()
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
