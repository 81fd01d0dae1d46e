"""Lines and buses, opened when a part asks for them and closed together: of this Pi, or of the simulated one.

Part of the composition root. Knows the drivers of lines, I2C and SPI, and for a station the package or the simulator
behind each. Does not know which parts are connected.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

from firmware_sim.rotors.rotor import SimRotor
from hw.buses.gpio import PI_HEADER_LABEL, GpioContact, GpioInputs, GpioOutputs, NoHeaderError, find_chip, real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus
from hw.buses.spi import SO, KernelSpi, LineSpi, SpiBus, real_spidev
from hw.ports import HardwareError
from rotator.config.chips import KERNEL_SELECTS, SpiUse

_ELSEWHERE = (
    "This computer is no Raspberry Pi, or its GPIO driver is not loaded. "
    'To try the box here, write hardware = "sim" under [rotor]: the rotor is then simulated'
)


@dataclass(eq=False)
class Buses:
    """`opened` closes everything in the end. `header`: the path of the GPIO chip, where the file says it.

    `gpiod` and `spidev` return the packages of their name, or objects of their shape. `paths` lists the GPIO chips;
    None: those in /dev. Raises HardwareError.
    """

    opened: ExitStack
    _: KW_ONLY
    gpiod: Callable[[], Any]
    paths: list[str] | None
    open_bus: Callable[[int], SmbusI2C]
    spidev: Callable[[], Any]
    clock: Callable[[], float]
    sleep: Callable[[float], None]
    header: str | None = None
    _buses: dict[int, SmbusI2C] = field(default_factory=dict, init=False)

    @property
    def gpio(self) -> Any:
        """The package gpiod, or an object of its shape."""
        return self.gpiod()

    def chip(self) -> str:
        """The path of the chip with the lines of the header: what the file says, or found by its label."""
        if self.header is None:
            try:
                self.header = find_chip(self.gpio, PI_HEADER_LABEL, self.paths)
            except NoHeaderError as fault:
                raise HardwareError(f"{fault}. {_ELSEWHERE}") from fault
        return self.header

    def outputs(self, consumer: str, pins: Mapping[str, int], *, active_low: bool = False) -> GpioOutputs:
        outputs = GpioOutputs(self.gpio, self.chip(), pins, consumer=consumer, active_low=active_low)
        self.opened.callback(outputs.close)
        return outputs

    def inputs(self, consumer: str, pins: Mapping[str, int]) -> GpioInputs:
        """Contacts to ground, each held high by the Pi's own resistor while it is open."""
        inputs = GpioInputs(self.gpio, self.chip(), pins, consumer=consumer)
        self.opened.callback(inputs.close)
        return inputs

    def contact(self, consumer: str, pin: int, *, active_low: bool, pull: bool, debounce_s: float) -> GpioContact:
        contact = GpioContact(
            self.gpio, self.chip(), pin, consumer=consumer, active_low=active_low, pull=pull, debounce_s=debounce_s
        )
        self.opened.callback(contact.close)
        return contact

    def bus(self, number: int) -> SmbusI2C:
        if number not in self._buses:
            bus = self.open_bus(number)
            self.opened.callback(bus.close)
            self._buses[number] = bus
        return self._buses[number]

    def spi(self, use: SpiUse) -> SpiBus:
        """The bus with these chips; a driver calls each by the key of its select line."""
        if use.kernel:
            return self._kernel_spi(use)
        consumer = f"rotator-spi-{use.table}"
        selects = self.outputs(f"{consumer}-select", use.selects, active_low=True)
        wires = {name: pin for name, pin in use.wires.items() if name != SO}
        answer = self.inputs(f"{consumer}-so", {SO: use.wires[SO]}) if SO in use.wires else None
        return LineSpi(selects, self.outputs(consumer, wires), answer)

    def _kernel_spi(self, use: SpiUse) -> KernelSpi:
        for key, pin in use.selects.items():
            if pin not in KERNEL_SELECTS:
                raise HardwareError(f"SPI: {use.table}.{key} = {pin} is no select of the kernel's SPI: take 8 or 7")
        selects = {key: KERNEL_SELECTS[pin] for key, pin in use.selects.items()}
        spi = KernelSpi(self.spidev(), 0, selects, mode=use.mode, speed_hz=use.speed_hz)
        self.opened.callback(spi.close)
        return spi


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
            gpiod=lambda: gpiod,
            paths=world.gpio.paths() if world else None,
            open_bus=(lambda number: SmbusI2C(world.i2c(number), "simulated bus")) if world else open_bus,
            spidev=(lambda: world.spidev) if world else real_spidev,
            clock=clock,
            sleep=sleep,
            header=chip,
        )
        self.world = world
