"""The bench of `make test`: simulated chips and lines in the shape of smbus2 and gpiod, in real time."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.chips.hd44780 import Hd44780
from hw.buses.i2c import SmbusI2C
from tests.contract.bench import LCD_PINS, RELAYS, Edge
from tests.contract.chips import Chips

GIVES_UP_S = 0.2
"""When the bus stands still; a kernel's driver takes up to two seconds."""


class SimulatedBench(Chips):
    relays, lcd_pins = RELAYS, LCD_PINS
    chip = "/dev/gpiochip0"

    def __init__(self) -> None:
        super().__init__()
        self.api = SimGpio(time.monotonic)
        self.bus = SmbusI2C(self.wire, "simulated bus")
        self._glass_on_lines = Hd44780(time.monotonic)
        self._lcd_levels = {pin: self.api.level(pin) for pin in LCD_PINS.values()}
        self.api.on_edges.append(self._wires)

    def paths(self) -> list[str]:
        return self.api.paths()

    def crowd(self, labels: Sequence[str]) -> tuple[Any, list[str]]:
        api = SimGpio(time.monotonic, {f"/dev/gpiochip{number}": label for number, label in enumerate(labels)})
        return api, api.paths()

    def level(self, offset: int) -> bool:
        return self.api.level(offset)

    def edges(self) -> list[Edge]:
        seen = [Edge(edge.at_s, edge.offset, edge.level) for edge in self.api.edges]
        self.api.edges.clear()
        return [edge for edge in seen if edge.offset in RELAYS.values()]

    def hang(self) -> None:
        self.wire.hang(GIVES_UP_S)

    def read_glass(self, port: str, expected: Sequence[str]) -> tuple[str, ...]:
        return (self.glass if port == "backpack" else self._glass_on_lines).text()

    def close(self) -> None:
        self.bus.close()

    def _wires(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        self._lcd_levels |= {pin: level for pin, level in changes.items() if pin in self._lcd_levels}
        self._glass_on_lines.pins(**{name: self._lcd_levels[pin] for name, pin in LCD_PINS.items()})
