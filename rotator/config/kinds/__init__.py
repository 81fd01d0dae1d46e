"""The table of the kinds of rotor, which have one file each. `Config.kind` makes the kind that the file names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from rotator.config.kinds.digipot import DigipotKind
from rotator.config.kinds.kind import Kind
from rotator.config.kinds.moteus import MoteusKind
from rotator.config.kinds.relay_pot import RelayPot
from rotator.config.kinds.relay_pulse import RelayPulse
from rotator.config.kinds.servo import ServoKind

KindName = Literal["relay-pot", "relay-pulse", "moteus", "servo", "digipot"]

KINDS: Mapping[KindName, type[Kind]] = {
    "relay-pot": RelayPot,
    "relay-pulse": RelayPulse,
    "moteus": MoteusKind,
    "servo": ServoKind,
    "digipot": DigipotKind,
}
