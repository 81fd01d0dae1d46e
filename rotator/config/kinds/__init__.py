"""The table [rotor], the kinds of rotor, which have one file each, and the step that fills in the defaults of the kind
before the file is checked. `Config.kind` makes the kind that the file names.

Knows where these defaults go, and that real hardware takes no limits from them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from rotator.config.kinds.controller import ControllerKind
from rotator.config.kinds.digipot import DigipotKind
from rotator.config.kinds.h_bridge import HBridgeKind
from rotator.config.kinds.kind import Kind
from rotator.config.kinds.moteus import MoteusKind
from rotator.config.kinds.relay_pot import RelayPot
from rotator.config.kinds.relay_pulse import RelayPulse
from rotator.config.kinds.relay_timed import RelayTimed
from rotator.config.kinds.servo import ServoKind
from rotator.config.kinds.stepper import StepperKind
from rotator.config.table import Table

KindName = Literal[
    "relay-pot", "relay-pulse", "relay-timed", "moteus", "servo", "digipot", "h-bridge", "controller", "stepper"
]

KINDS: Mapping[KindName, type[Kind]] = {
    "relay-pot": RelayPot,
    "relay-pulse": RelayPulse,
    "relay-timed": RelayTimed,
    "moteus": MoteusKind,
    "servo": ServoKind,
    "digipot": DigipotKind,
    "h-bridge": HBridgeKind,
    "controller": ControllerKind,
    "stepper": StepperKind,
}


class Rotor(Table):
    type: KindName = "relay-pot"
    """Motors on relays with pots, with counted contacts, or with nothing that comes back; two moteus controllers; two
    hobby servos; control boxes with a digital pot in place of each knob; DC motors behind H-bridges, with encoders;
    a ready-made controller with a serial port or on the network; or two steppers on chips with ramps."""
    hardware: Literal["sim", "pi"] = "sim"
    """A simulated rotor, or the relays, chips and display on this Pi."""

    @property
    def switched(self) -> bool:
        """Whether relays switch the motors on and off."""
        return KINDS[self.type].switched


def with_usual(values: dict[str, Any]) -> dict[str, Any]:
    """The file's values, and the defaults of its kind of rotor for keys that it leaves out. `values` stays as it is."""
    rotor = values.get("rotor")
    table: dict[str, Any] = rotor if isinstance(rotor, dict) else {}
    usual = next((kind.usual for name, kind in KINDS.items() if name == table.get("type")), {})
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
