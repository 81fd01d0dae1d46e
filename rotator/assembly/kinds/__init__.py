"""The builders of the kinds of rotor, one file each: the real drivers, and the simulated rotor for them.

Part of the composition root. This table names the files. The tables and properties of each kind are in
`rotator.config.kinds`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from firmware_sim.rotors.rotor import SimRotor
from hw.ports import OutputLines
from rotator.assembly.kinds import digipot, moteus, relay_pot, relay_pulse, servo
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.kinds import KindName
from rotator.rotors.port import Rotor


class Builder(Protocol):
    """A file of this folder."""

    def build(self, parts: Assembly, lines: OutputLines | None) -> Rotor:
        """The rotor; `lines` are those that must be off for it to stand still, where there are any.

        Raises HardwareError.
        """

    def simulate(self, axes: SimulatedAxes) -> SimRotor:
        """The simulated rotor, with neither display nor sensors yet."""


KINDS: Mapping[KindName, Builder] = {
    "relay-pot": relay_pot,
    "relay-pulse": relay_pulse,
    "moteus": moteus,
    "servo": servo,
    "digipot": digipot,
}
