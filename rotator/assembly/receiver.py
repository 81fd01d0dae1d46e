"""Builds the simulated receiver behind a simulated antenna: a look-alike of rigctld to practise with.

Knows where the simulated boom points and what it hears. Does not know rigctld's lines, nor what a scan makes of them.
"""

from __future__ import annotations

from collections.abc import Callable

from firmware_sim.parts.receiver import ReceiverSpec, SimReceiver
from firmware_sim.parts.rigctld import SimRigctld
from firmware_sim.rotors.rotor import SimRotor
from rotator.assembly.simulation import simulated_boom
from rotator.config.model import Config
from rotator.control.sky.angles import great_circle_deg


def simulated_receiver(
    config: Config, world: SimRotor, clock: Callable[[], float], source: Callable[[], tuple[float, float]]
) -> SimReceiver:
    """A receiver that hears by where the simulated boom points. `source`: azimuth and elevation of the signal."""
    boom = simulated_boom(config)

    def off_deg() -> float:
        return great_circle_deg(*boom(*world.antenna()), *source())

    return SimReceiver(ReceiverSpec(config.station.beam_deg), clock, off_deg)


def simulated_rigctld(receiver: SimReceiver) -> SimRigctld:
    """A simulated rigctld; it listens on a port of its own until it is closed."""
    return SimRigctld(receiver.strength_db)
