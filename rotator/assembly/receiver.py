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


def simulated_rigctld(
    config: Config, world: SimRotor, clock: Callable[[], float], source: Callable[[], tuple[float, float]]
) -> SimRigctld:
    """A simulated rigctld, whose receiver hears by where the simulated boom points. It listens on a port of its own
    until it is closed. `source`: azimuth and elevation of the signal.
    """
    boom = simulated_boom(config)

    def off_deg() -> float:
        return great_circle_deg(*boom(*world.antenna()), *source())

    return SimRigctld(SimReceiver(ReceiverSpec(config.station.beam_deg), clock, off_deg).strength_db)
