"""The hardware half of the composition root: from a configuration to drivers, on real chips or simulated ones.

Knows which driver sits on which bus and which lines, and the order in which they are let go. Decides nothing.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.ads1115 import Ads1115
from hw.gpio import PI_HEADER_LABEL, GpioOutputs, find_chip, real_gpiod
from hw.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS, BackpackPort, GpioPort, Hd44780
from hw.i2c import SmbusI2C, open_bus
from hw.ports import AngleSensor, Axis, CharacterDisplay
from hw.pot import PotSensor, Reference
from hw.relays import MASTER, RelayBank
from rotator.config.model import Config
from rotator.simulation import simulated_world


class Station:
    """The hardware, real or simulated, behind its drivers. Raises HardwareError where it is missing."""

    def __init__(
        self,
        config: Config,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        start_deg: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self.world = None
        if config.rotor.hardware == "sim":
            self.world = simulated_world(config, clock, sleep if config.sim.bus_takes_time else None, start_deg)
        gpio = self.world.gpio if self.world else real_gpiod()
        self._buses: dict[int, SmbusI2C] = {}
        chip = config.relays.chip or find_chip(gpio, PI_HEADER_LABEL, self.world.gpio.paths() if self.world else None)
        relays = config.relays.model_dump(include={"azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down"})
        if config.relays.master is not None:
            relays[MASTER] = config.relays.master
        self._outputs = [
            GpioOutputs(gpio, chip, relays, consumer="rotator-relays", active_low=config.relays.active == "low")
        ]
        self.bank = RelayBank(
            self._outputs[0], clock, dead_time_s=config.relays.dead_time_s, master=config.relays.master is not None
        )
        adc_range_v = 4.096 if config.adc.supply_v <= 4.096 else 6.144
        adc = Ads1115(
            self._bus(config.adc.bus),
            config.adc.address,
            sleep,
            rate_sps=config.adc.rate_sps,
            full_scale_v=adc_range_v,
        )
        reference = config.adc.reference_channel
        supply = config.adc.supply_v if reference is None else Reference(adc, reference, clock)
        self.sensors: dict[Axis, AngleSensor] = {
            Axis.AZIMUTH: PotSensor(adc, config.adc.azimuth_channel, supply),
            Axis.ELEVATION: PotSensor(adc, config.adc.elevation_channel, supply),
        }
        self.display = self._display(config, gpio, chip, sleep)

    def close(self) -> None:
        self.bank.off()
        for outputs in self._outputs:
            outputs.close()
        for bus in self._buses.values():
            bus.close()

    def _bus(self, number: int) -> SmbusI2C:
        if number not in self._buses:
            self._buses[number] = SmbusI2C(self.world.bus, "simulated bus") if self.world else open_bus(number)
        return self._buses[number]

    def _display(
        self, config: Config, gpio: object, chip: str, sleep: Callable[[float], None]
    ) -> CharacterDisplay | None:
        match config.lcd.kind:
            case "gpio":
                pins = config.lcd.model_dump(include={"rs", "e", "d4", "d5", "d6", "d7"})
                outputs = GpioOutputs(gpio, chip, pins, consumer="rotator-lcd")
                self._outputs.append(outputs)
                return Hd44780(GpioPort(outputs, sleep), sleep)
            case "pcf8574":
                board = config.lcd.backpack
                port = BackpackPort(
                    self._bus(config.lcd.bus),
                    config.lcd.address,
                    BACKPACKS[board],
                    backlight_active_low=board in BACKLIGHT_ACTIVE_LOW,
                )
                return Hd44780(port, sleep)
            case _:
                return None
