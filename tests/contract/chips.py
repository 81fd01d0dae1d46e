"""The simulated chips on an I2C bus that every bench but a real Pi shares: a converter, and a display on a backpack.

Knows their addresses, and how to set and unplug them. Does not know whether a kernel is between them and the drivers.
"""

from __future__ import annotations

import time

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.chips.pcf8574 import Backpack
from tests.contract.bench import ADC_ADDRESS, LCD_ADDRESS

YWROBOT = {"rs": 0, "rw": 1, "e": 2, "bl": 3, "d4": 4, "d5": 5, "d6": 6, "d7": 7}


class Chips:
    adc_address, lcd_address, backpack = ADC_ADDRESS, LCD_ADDRESS, "ywrobot"

    def __init__(self) -> None:
        self.wire = SimI2CBus()
        self.adc = Ads1115(time.monotonic)
        self.glass = Hd44780(self.wire.wire_time(time.monotonic))
        self.wire.attach(ADC_ADDRESS, self.adc)
        self.wire.attach(LCD_ADDRESS, Backpack(self.glass, YWROBOT).expander)

    def set_volts(self, channel: int, volts: float) -> None:
        self.adc.inputs[channel] = lambda: volts

    def unplug(self, address: int) -> None:
        self.wire.gone.add(address)

    def replug(self, address: int) -> None:
        self.wire.gone.discard(address)

    def hang(self) -> None:
        self.wire.hang()

    def release(self) -> None:
        self.wire.release()
