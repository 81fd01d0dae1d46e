"""The builders of the kinds of rotor, one file each: the real drivers, and the simulated rotor for them.

Part of the composition root. One function here finds the files, each of which is named as its kind. The tables and
properties of each kind are in `rotator.config.kinds`.
"""

from __future__ import annotations

from importlib import import_module
from typing import Protocol, cast

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
    return cast(Builder, import_module(f"{__name__}.{kind.replace('-', '_')}"))
