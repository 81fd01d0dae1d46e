"""The chips that are looked at, real or simulated: the doctor's share of the composition root.

Knows which driver reads what. Takes no line, and writes to no chip but the converter, when it is told to read it.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from hw.ads1115 import Ads1115
from hw.gpio import find_chip, holders, real_gpiod
from hw.i2c import SmbusI2C, open_bus
from hw.pot import Reference
from rotator.config.model import Config
from rotator.simulation import simulated_rotor

Bus = SmbusI2C

WIDEST_RANGE_V = 6.144
"""Not the box's own: a pot that hangs on too high a supply is to be seen as it is."""


@dataclass(frozen=True, slots=True)
class Chips:
    """`clock` and `sleep` are the seconds of the converter's conversions."""

    gpio: Callable[[], Any]
    """The gpiod package, or anything of its shape. Raises HardwareError where it is missing or the wrong one."""
    paths: list[str] | None
    """The GPIO chips there are; None: whatever stands in /dev."""
    open_bus: Callable[[int], SmbusI2C]
    clock: Callable[[], float]
    sleep: Callable[[float], None]

    def header(self, config: Config) -> str:
        """The path of the chip with the relays. Raises HardwareError."""
        return config.relays.chip or find_chip(self.gpio(), paths=self.paths)

    def holders(self, config: Config, pins: Iterable[int]) -> dict[int, str]:
        """Who holds which of these lines; those that are free are left out. Raises HardwareError."""
        return holders(self.gpio(), self.header(config), pins)

    @contextmanager
    def bus(self, number: int) -> Iterator[SmbusI2C]:
        """Raises HardwareError where it cannot be opened."""
        bus = self.open_bus(number)
        try:
            yield bus
        finally:
            bus.close()

    def converter(self, bus: SmbusI2C, config: Config) -> Ads1115:
        return Ads1115(bus, config.adc.address, self.sleep, rate_sps=config.adc.rate_sps, full_scale_v=WIDEST_RANGE_V)

    def supply_v(self, converter: Ads1115, config: Config) -> float:
        """The pots' supply, measured where it is wired to the converter. Raises HardwareError."""
        channel = config.adc.reference_channel
        return config.adc.supply_v if channel is None else Reference(converter, channel, self.clock).volts()


def real_chips() -> Chips:
    return Chips(real_gpiod, None, open_bus, time.monotonic, time.sleep)


def simulated_chips(config: Config) -> Chips:
    """Those of a station that was never switched on."""
    world = partial(simulated_rotor, config, time.monotonic, None, (0.0, 0.0))
    gpio = world().gpio
    return Chips(
        lambda: gpio,
        gpio.paths(),
        lambda _number: SmbusI2C(world().bus, "simulated bus"),
        time.monotonic,
        time.sleep,
    )
