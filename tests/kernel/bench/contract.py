"""The bench of `make test-kernel`: the real gpiod and smbus2 on the kernel's own drivers, simulated chips beyond them.

Knows which parts the contract needs, and makes each when it is first asked for: an adapter takes half a second to come.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import gpiod

from firmware_sim.chips.hd44780 import Hd44780
from hw.buses.i2c import SmbusI2C, open_bus
from tests.contract.bench import LCD_PINS, RELAYS, Edge
from tests.contract.chips import Chips
from tests.kernel.bench.edges import EdgeRecorder
from tests.kernel.bench.gpio import GpioChip
from tests.kernel.bench.i2c import I2CAdapter


class KernelBench(Chips):
    api: Any = gpiod
    relays, lcd_pins = RELAYS, LCD_PINS

    def __init__(self) -> None:
        super().__init__()
        self._chips: list[GpioChip] = []
        self._relay_edges: list[Edge] = []
        self._lcd_now_s = 0.0

    @cached_property
    def _header(self) -> GpioChip:
        return self._made()

    @cached_property
    def _recorder(self) -> EdgeRecorder:
        recorder = EdgeRecorder(self._header)
        recorder.know(*RELAYS.values(), *LCD_PINS.values())
        self._lcd_levels = {pin: self._header.level(pin) for pin in LCD_PINS.values()}
        self._glass_on_lines = Hd44780(lambda: self._lcd_now_s)
        return recorder

    @cached_property
    def _adapter(self) -> I2CAdapter:
        adapter = I2CAdapter(self.wire)
        adapter.plug()
        return adapter

    @cached_property
    def bus(self) -> SmbusI2C:
        assert self._adapter.number is not None
        return open_bus(self._adapter.number)

    @property
    def chip(self) -> str:
        assert self._recorder  # from the first moment on that a test could take a line
        return self._header.path

    def paths(self) -> list[str]:
        assert self._header
        return sorted(str(path) for path in Path("/dev").glob("gpiochip*"))

    def crowd(self, labels: Sequence[str]) -> tuple[Any, list[str]]:
        return gpiod, [self._made(label).path for label in labels]

    def level(self, offset: int) -> bool:
        return self._header.level(offset)

    def edges(self) -> list[Edge]:
        self._look()
        seen, self._relay_edges = self._relay_edges, []
        return seen

    def read_glass(self, port: str, expected: Sequence[str]) -> tuple[str, ...]:
        if port == "backpack":
            return self.glass.text()
        self._look()
        return self._glass_on_lines.text()

    def close(self) -> None:
        made = self.__dict__
        if "bus" in made:
            self.bus.close()
        if "_adapter" in made:
            self._adapter.close()
        if "_recorder" in made:
            self._recorder.close()
        for chip in self._chips:
            chip.close()

    def _made(self, label: str = "pinctrl-bcm2711") -> GpioChip:
        self._chips.append(GpioChip(label))
        return self._chips[-1]

    def _look(self) -> None:
        """Hand on what the pins did: the relays' edges to the test, the display's to the display, at their moments."""
        for edge in self._recorder.edges():
            if edge.offset in self._lcd_levels:
                self._lcd_now_s = edge.at_s
                self._lcd_levels[edge.offset] = edge.level
                self._glass_on_lines.pins(**{name: self._lcd_levels[pin] for name, pin in LCD_PINS.items()})
            elif edge.offset in RELAYS.values():
                self._relay_edges.append(Edge(edge.at_s, edge.offset, edge.level))
