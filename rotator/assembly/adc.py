"""Opens the converter of the pots with the driver of its kind, and wires a simulated one to the simulated pots.

Part of the composition root: knows the drivers and the keys of [adc]. Does not judge readings.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from firmware_sim.buses.spi import wire_spi
from firmware_sim.chips.ads1115 import Ads1115 as SimAds1115
from firmware_sim.chips.mcp3208 import Mcp3208 as SimMcp3208
from firmware_sim.faults import SimFault
from firmware_sim.rotors.rotor import SimRotor
from hw.chips.ads1115 import Ads1115
from hw.chips.mcp3208 import Mcp3208
from hw.ports import AnalogInputs, Axis
from hw.sensors.pot import PotSensor, Reference
from rotator.assembly.buses import Buses
from rotator.config.adc import Adc
from rotator.config.chips import KERNEL_SELECTS
from rotator.config.model import Config

SUPPLY = "supply"
"""The name of the wire to the input that measures the pots' supply."""
ADS1115_RANGE_V, ADS1115_WIDEST_RANGE_V = 4.096, 6.144


@dataclass(frozen=True, slots=True)
class Converter:
    """An opened converter, with the supply of the pots: volts, or the input at which they are measured."""

    inputs: AnalogInputs
    answers: Callable[[], bool]
    """Whether the chip is there. Raises HardwareError where its bus cannot be asked."""
    supply: Reference | float

    def pot(self, channel: int) -> PotSensor:
        return PotSensor(self.inputs, channel, self.supply)

    def supply_v(self) -> float:
        """The supply of the pots in volts, measured or from the file. Raises HardwareError if the measurement fails."""
        return self.supply.volts() if isinstance(self.supply, Reference) else self.supply


def open_adc(table: Adc, buses: Buses, *, widest: bool = False) -> Converter:
    """`widest`: with the widest range of the chip, so that a pot on too high a supply is seen as it is.

    Raises HardwareError.
    """
    match table.kind:
        case "ads1115":
            return _ads1115(table, buses, widest=widest)
        case "mcp3208":
            return _mcp3208(table, buses)


def _ads1115(table: Adc, buses: Buses, *, widest: bool) -> Converter:
    bus = buses.bus(table.bus)
    range_v = ADS1115_WIDEST_RANGE_V if widest or table.supply_v > ADS1115_RANGE_V else ADS1115_RANGE_V
    inputs = Ads1115(bus, table.address, buses.sleep, rate_sps=table.rate_sps, full_scale_v=range_v)
    channel = table.reference_channel
    supply = table.supply_v if channel is None else Reference(inputs, channel, buses.clock)
    return Converter(inputs, lambda: bus.answers(table.address), supply)


def _mcp3208(table: Adc, buses: Buses) -> Converter:
    (use,) = table.spi_uses()
    # VREF is the supply of the pots: the reading is a share of it, at any voltage.
    inputs = Mcp3208(buses.spi(use), "select", table.supply_v, None if use.kernel else buses.clock)
    return Converter(inputs, inputs.answers, table.supply_v)


def simulate_adc(config: Config, rotor: SimRotor, clock: Callable[[], float]) -> None:
    """Wire the simulated converter to the simulated pots and to their supply."""
    table = config.adc
    match table.kind:
        case "ads1115":
            chip: SimAds1115 | SimMcp3208 = _wire_ads1115(table, rotor, clock)
        case "mcp3208":
            chip = _wire_mcp3208(table, rotor)
    for axis in Axis:
        if config.has_pot(axis):
            chip.inputs[table.channel(axis)] = _wire(rotor, axis.value)
    if table.reference_channel is not None:
        rotor.wipers.setdefault(SUPPLY, lambda: table.supply_v)
        chip.inputs[table.reference_channel] = _wire(rotor, SUPPLY)


def _wire(rotor: SimRotor, name: str) -> Callable[[], float]:
    """The volts are looked up at each conversion: a bench may put a bad contact into the wire later."""

    def volts() -> float:
        return rotor.wipers[name]()

    return volts


def _wire_ads1115(table: Adc, rotor: SimRotor, clock: Callable[[], float]) -> SimAds1115:
    chip = SimAds1115(clock, vdd_v=max(3.3, table.supply_v))
    rotor.wire_i2c("adc", (table.bus, table.address), chip)
    rotor.faults["adc-frozen"] = SimFault(lambda: setattr(chip, "frozen", True), lambda: setattr(chip, "frozen", False))
    return chip


def _wire_mcp3208(table: Adc, rotor: SimRotor) -> SimMcp3208:
    chip = SimMcp3208(table.supply_v)
    if table.spi == "kernel":
        rotor.spidev.chips[0, KERNEL_SELECTS.get(table.select, -1)] = chip
    else:
        wire_spi(rotor.gpio, chip, select=table.select, sck=table.sck, si=table.si, so=table.so)
    rotor.faults["adc-gone"] = SimFault(lambda: setattr(chip, "gone", True), lambda: setattr(chip, "gone", False))
    return chip
