"""The lines and buses of the Pi that the program runs on, or of the simulated one.

Part of the composition root. Chooses the package or the simulator behind each line and bus. Does not know which parts
are connected to them.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from firmware_sim.rotors.rotor import SimRotor
from hw.buses.gpio import real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus
from hw.buses.spi import real_spidev
from rotator.assembly.buses import Buses


class Board(Buses):
    """`world`: the simulated rotor with its Pi; None: the real one. `opened` closes everything in the end.

    `chip`: the path of the GPIO chip, where the file says it. Raises HardwareError.
    """

    def __init__(
        self,
        world: SimRotor | None,
        opened: ExitStack,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        chip: str | None = None,
    ) -> None:
        gpiod: Any = world.gpio if world else real_gpiod()
        super().__init__(
            opened,
            gpio=lambda: gpiod,
            paths=world.gpio.paths() if world else None,
            open_bus=(lambda number: SmbusI2C(world.i2c(number), "simulated bus")) if world else open_bus,
            spidev=(lambda: world.spidev) if world else real_spidev,
            clock=clock,
            sleep=sleep,
            chip=chip,
        )
        self.world = world
