"""The Pi's lines and buses, real or simulated, opened when they are asked for and let go of together.

Part of the composition root. Knows which package stands behind a line. Knows nothing of what hangs on it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any

from firmware_sim.rotors.rotor import SimRotor
from hw.buses.gpio import PI_HEADER_LABEL, GpioContact, GpioOutputs, find_chip, real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus


class Board:
    """`opened` closes everything in the end. `chip`: its path, where the file says it. Raises HardwareError."""

    def __init__(
        self,
        world: SimRotor | None,
        opened: ExitStack,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        *,
        chip: str | None = None,
    ) -> None:
        self.world = world
        self.clock = clock
        self.sleep = sleep
        self.opened = opened
        self.gpio: Any = world.gpio if world else real_gpiod()
        self._chip = chip
        self._buses: dict[int, SmbusI2C] = {}

    def chip(self) -> str:
        """The path of the chip with the header's lines: what the file says, or found by its label."""
        if self._chip is None:
            self._chip = find_chip(self.gpio, PI_HEADER_LABEL, self.world.gpio.paths() if self.world else None)
        return self._chip

    def outputs(self, consumer: str, pins: Mapping[str, int], *, active_low: bool = False) -> GpioOutputs:
        outputs = GpioOutputs(self.gpio, self.chip(), pins, consumer=consumer, active_low=active_low)
        self.opened.callback(outputs.close)
        return outputs

    def contact(self, consumer: str, pin: int, *, active_low: bool, pull: bool, debounce_s: float) -> GpioContact:
        contact = GpioContact(
            self.gpio, self.chip(), pin, consumer=consumer, active_low=active_low, pull=pull, debounce_s=debounce_s
        )
        self.opened.callback(contact.close)
        return contact

    def bus(self, number: int) -> SmbusI2C:
        if number not in self._buses:
            bus = SmbusI2C(self.world.bus, "simulated bus") if self.world else open_bus(number)
            self.opened.callback(bus.close)
            self._buses[number] = bus
        return self._buses[number]
