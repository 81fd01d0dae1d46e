"""The bench of `pytest tests/contract --hardware`: a Raspberry Pi, wired as its rotator.toml says.

Knows the `pinctrl` tool of Raspberry Pi OS, which reads a pin's level while a program drives it. This bench cannot set
a voltage, pull a plug or read a display: tests that need that are skipped, with the reason. A relay closes only with
--motors-are-unplugged.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, NoReturn

import pytest

from hw.buses.gpio import PI_HEADER_LABEL, find_chip, real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus
from rotator.config.model import Config
from tests.contract.bench import Edge

LEVEL = re.compile(r"\| (hi|lo)\b")


class RaspberryPiBench:
    def __init__(self, config: Config, *, motors_are_unplugged: bool) -> None:
        self._config = config
        self._motors_are_unplugged = motors_are_unplugged
        self.adc_address = config.adc.address
        self.backpack: str = config.lcd.backpack

    @cached_property
    def api(self) -> Any:
        return real_gpiod()

    @cached_property
    def chip(self) -> str:
        return self._config.relays.chip or find_chip(self.api, PI_HEADER_LABEL)

    @cached_property
    def relays(self) -> Mapping[str, int]:
        if not self._motors_are_unplugged:
            pytest.skip("this closes relays: unplug the motors, then add --motors-are-unplugged")
        named = {"azimuth_cw", "azimuth_ccw", "elevation_up", "elevation_down"}
        return self._config.relays.model_dump(include=named)

    @cached_property
    def lcd_pins(self) -> Mapping[str, int]:
        if self._config.lcd.kind != "gpio":
            pytest.skip("the configuration has no display on six lines")
        return self._config.lcd.model_dump(include={"rs", "e", "d4", "d5", "d6", "d7"})

    @cached_property
    def lcd_address(self) -> int:
        if self._config.lcd.kind != "pcf8574" or self._config.lcd.bus != self._config.adc.bus:
            pytest.skip("the configuration has no display on a backpack on the converter's bus")
        return self._config.lcd.address

    @cached_property
    def bus(self) -> SmbusI2C:
        return open_bus(self._config.adc.bus)

    def paths(self) -> list[str]:
        return sorted(str(path) for path in Path("/dev").glob("gpiochip*"))

    def crowd(self, labels: Sequence[str]) -> NoReturn:
        pytest.skip("a Raspberry Pi has the chips it has")

    def level(self, offset: int) -> bool:
        said = subprocess.run(["pinctrl", "get", str(offset)], capture_output=True, text=True, check=True).stdout
        found = LEVEL.search(said)
        assert found, f"pinctrl get {offset} said {said!r}"
        return found[1] == "hi"

    def edges(self) -> list[Edge]:
        pytest.skip("nothing on a Raspberry Pi records what its pins did: look with a logic analyser")

    def set_volts(self, channel: int, volts: float) -> None:
        pytest.skip(f"nothing here can put {volts} V on input {channel} of a real converter")

    def unplug(self, address: int) -> None:
        pytest.skip("nothing here can draw a real plug")

    def replug(self, address: int) -> None: ...

    def hang(self) -> None:
        pytest.skip("nothing here can hold a real bus low")

    def release(self) -> None: ...

    def read_glass(self, port: str, expected: Sequence[str]) -> tuple[str, ...]:
        pytest.skip(f"look at the display yourself; it should read {' / '.join(expected)}")

    def close(self) -> None:
        if "bus" in self.__dict__:
            self.bus.close()
