"""The builders of the kinds of rotor, one file each: the real drivers, and the simulated rotor for them.

Part of the composition root. One function here names the files. The tables and properties of each kind are in
`rotator.config.kinds`.
"""

# ruff: noqa: PLC0415 - a box loads the kind that it has

from __future__ import annotations

from typing import Protocol

from firmware_sim.rotors.rotor import SimRotor
from hw.ports import OutputLines
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


def builder(kind: KindName) -> Builder:
    """The file of that kind. Loaded only now: the drivers of all the others would double the time of a start."""
    match kind:
        case "relay-pot":
            from rotator.assembly.kinds import relay_pot

            return relay_pot
        case "relay-pulse":
            from rotator.assembly.kinds import relay_pulse

            return relay_pulse
        case "relay-timed":
            from rotator.assembly.kinds import relay_timed

            return relay_timed
        case "moteus":
            from rotator.assembly.kinds import moteus

            return moteus
        case "servo":
            from rotator.assembly.kinds import servo

            return servo
        case "digipot":
            from rotator.assembly.kinds import digipot

            return digipot
        case "h-bridge":
            from rotator.assembly.kinds import h_bridge

            return h_bridge
        case "controller":
            from rotator.assembly.kinds import controller

            return controller
        case "stepper":
            from rotator.assembly.kinds import stepper

            return stepper
