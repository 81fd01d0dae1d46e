"""The rotor behind the kernel's own chips: relay lines are read from their pins, pots and display hang on a real bus.

Knows which pins the rotor listens to, and which ones its contacts pull. The rotor itself, its motors, pots, converter
and display, is the simulated station's; here its lines are a mirror of the kernel's.
"""

from __future__ import annotations

import threading
from typing import Self

import gpiod
from gpiod.line import Direction, Value

from firmware_sim.rotors.geared import RelayedRotor
from tests.kernel.bench.gpio import GpioChip

PERIOD_S = 0.02
"""A relay takes as long to close; and more often costs time that the box needs on so slow a machine."""


class Plant:
    """A thread that turns the motors as the pins of `chip` say. `world.bus` is for an adapter to carry."""

    def __init__(
        self, chip: GpioChip, world: RelayedRotor, pins: tuple[int, ...], contacts: tuple[int, ...] = ()
    ) -> None:
        self.world = world
        self._contacts = contacts
        self._pulled: dict[int, bool] = {}
        self._chip = chip
        self._pins = pins
        setting = gpiod.LineSettings(direction=Direction.OUTPUT)
        self._mirror = world.gpio.request_lines(world.gpio.paths()[0], consumer="plant", config={pins: setting})
        watched = gpiod.LineSettings(direction=Direction.INPUT)
        self._outlook = world.gpio.request_lines(
            world.gpio.paths()[0], consumer="contacts", config={contacts or (0,): watched}
        )
        self._stopping = threading.Event()
        # "Thread-": it belongs to a fixture and may outlive a test.
        self._thread = threading.Thread(target=self._turn, name="Thread-plant", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *error: object) -> None:
        self._stopping.set()
        self._thread.join()

    def _turn(self) -> None:
        while not self._stopping.wait(PERIOD_S):
            levels = {pin: self._chip.level(pin) for pin in self._pins}
            self._mirror.set_values({pin: Value.ACTIVE if on else Value.INACTIVE for pin, on in levels.items()})
            for pin in self._contacts:
                up = self._outlook.get_value(pin) is Value.ACTIVE
                if self._pulled.get(pin) is not up:
                    self._chip.pull(pin, up=up)
                    self._pulled[pin] = up
