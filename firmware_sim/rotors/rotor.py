"""What every simulated rotor has beside its motors: the Pi's lines and bus, a display, sensor chips on its shafts.

Knows what is wired where on the Pi's side. Knows no driver: it offers a bus in the shape of smbus2 and lines in the
shape of gpiod. What turns and what can go wrong there, each rotor adds.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import SimpleNamespace

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115
from firmware_sim.chips.as5600 import As5600, MagnetFault
from firmware_sim.chips.bno055 import Bno055
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.chips.mpu6050 import Mpu6050
from firmware_sim.chips.pcf8574 import Backpack
from firmware_sim.faults import Fallible, SimFault
from firmware_sim.panel import PanelSpec, SimPanel
from firmware_sim.parts.pot import PotFault, PotSpec, SimPot


@dataclass(frozen=True, slots=True)
class LcdSpec:
    """A display: on six lines (pins rs, e, d4 to d7), or behind an expander at `address` (bits of the same names)."""

    pins: Mapping[str, int]
    address: int | None = None
    backlight_active_high: bool = True


class SimRotor(Fallible):
    """`clock` tells the time, `sleep` lets it pass on the bus (None: transfers take none)."""

    def __init__(self, clock: Callable[[], float], sleep: Callable[[float], None] | None = None) -> None:
        self._clock = clock
        self._lock = threading.RLock()
        self.gpio = SimGpio(clock)
        self.bus = SimI2CBus(sleep)
        self.lcd: Hd44780 | None = None
        self.panel: SimPanel | None = None

    def antenna(self) -> tuple[float, float]:
        """Where the boom really points: azimuth and elevation on the rotor's own scales."""
        raise NotImplementedError

    def shafts(self) -> tuple[float, float]:
        """Where the shafts are, before the play of the gears; without play, where the boom is."""
        return self.antenna()

    def drives(self) -> tuple[int, int]:
        """The relays' coils: -1, 0, 1 for each axis; 0 without relays."""
        return 0, 0

    @property
    def relay_starts(self) -> int | None:
        """How often a motor relay has closed; None: there are no relays."""
        return None

    def wire_lcd(self, spec: LcdSpec) -> None:
        if spec.address is not None:
            self.lcd = Hd44780(self.bus.wire_time(self._clock))
            self.bus.attach(spec.address, Backpack(self.lcd, spec.pins, spec.backlight_active_high).expander)
            self.faults["lcd-gone"] = self._gone(spec.address)
            return
        lcd = self.lcd = Hd44780(self._clock)
        levels = {pin: self.gpio.level(pin) for pin in spec.pins.values()}

        def pins_changed(_now_s: float, changes: Mapping[int, bool]) -> None:
            if levels.keys() & changes.keys():
                levels.update((pin, level) for pin, level in changes.items() if pin in levels)
                lcd.pins(**{name: levels[pin] for name, pin in spec.pins.items()})

        self.gpio.on_edges.append(pins_changed)

    def wire_pots(self, address: int, pots: Mapping[str, tuple[int, PotSpec]], supply_v: float) -> None:
        """Pots on the shafts of a rotor that brings none, on these inputs of a converter."""
        adc = Ads1115(self._clock, vdd_v=max(3.3, supply_v))
        for name, (channel, spec) in pots.items():
            pot = SimPot(spec, supply_v)
            adc.inputs[channel] = lambda name=name, pot=pot: pot.volts(self._shaft_deg(name))  # type: ignore[misc]
            self.faults[f"{name}-pot-open"] = self._fault_of(pot, "fault", PotFault.OPEN, PotFault.NONE)
        self.bus.attach(address, adc)
        self.faults["adc-gone"] = self._gone(address)

    def wire_as5600(self, name: str, address: int) -> None:
        """A magnet on the shaft, over the chip."""
        chip = As5600(lambda: self._shaft_deg(name) / 360.0)
        self.bus.attach(address, chip)
        self.faults[f"{name}-magnet-missing"] = self._fault_of(chip, "fault", MagnetFault.MISSING, MagnetFault.NONE)
        self.faults[f"{name}-as5600-gone"] = self._gone(address)

    def wire_mpu6050(self, address: int, gravity_g: Callable[[float, float], tuple[float, float, float]]) -> None:
        """On the boom. `gravity_g`: what a board mounted like this one feels, given gravity along the boom and across
        it."""

        def feels_g() -> tuple[float, float, float]:
            elevation = math.radians(self.antenna()[1])
            return gravity_g(math.sin(elevation), math.cos(elevation))

        chip = Mpu6050(self._clock, feels_g)
        self.bus.attach(address, chip)
        self.faults["elevation-shaken"] = self._fault_of(chip, "shaken_g", 0.5, 0.0)
        self.faults["mpu6050-gone"] = self._gone(address)

    def wire_bno055(self, address: int, magnetic_deg: Callable[[float], float]) -> Bno055:
        """On the boom. `magnetic_deg`: where the chip's forward points, given the boom's azimuth on its own scale."""
        chip = Bno055(self._clock, lambda: magnetic_deg(self.antenna()[0]) % 360.0)
        self.bus.attach(address, chip)
        self.faults["steel-near"] = self._fault_of(chip, "hard_iron_deg", 40.0, 0.0)
        self.faults["compass-gone"] = self._gone(address)
        return chip

    def wire_panel(self, spec: PanelSpec) -> SimPanel:
        """A front panel on the same lines and the same bus; its faults are `panel-...`."""
        panel = self.panel = SimPanel(spec, self.gpio, self.bus, self._clock)
        self.faults |= {f"panel-{name}": fault for name, fault in panel.faults.items() if name != "bus-hung"}
        return panel

    def wire_limit(self, key: str, pin: int, name: str, at_deg: float, *, high: bool) -> None:
        """A switch to ground that opens where the shaft of this axis comes to `at_deg`."""
        wire = SimpleNamespace(broken=False)

        def look(_now_s: float) -> None:
            shaft_deg = self._shaft_deg(name)
            reached = shaft_deg >= at_deg if high else shaft_deg <= at_deg
            self.gpio.drive_input(pin, None if reached or wire.broken else False)

        self.gpio.drive_input(pin, False)
        self.gpio.on_look.append(look)
        self.faults[f"{key.replace('_', '-')}-switch-open"] = self._fault_of(wire, "broken", True, False)

    def _shaft_deg(self, name: str) -> float:
        return self.shafts()[0 if name == "azimuth" else 1]

    def _gone(self, address: int) -> SimFault:
        return SimFault(lambda: self.bus.gone.add(address), lambda: self.bus.gone.discard(address))
