"""What simulated rotors have beside motors: the Pi's lines and buses, a display, a panel, sensors, limit switches.

Knows which line or address each of these parts is on, and the fault of each part. Knows no driver: it offers lines in
the shape of gpiod, a bus in the shape of smbus2, and a module in the shape of spidev. Does not know what turns: each
kind adds its motors and their faults.
"""

from __future__ import annotations

import math
import random
import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import SimpleNamespace

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import I2CChip, SimI2CBus
from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.adxl345 import Adxl345
from firmware_sim.chips.as5045 import As5045
from firmware_sim.chips.as5048 import As5048a, As5048b
from firmware_sim.chips.as5600 import As5600
from firmware_sim.chips.bno055 import Bno055
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.chips.hmc5883l import Hmc5883l
from firmware_sim.chips.lsm303 import Lsm303Accelerometer
from firmware_sim.chips.magnet import MagnetFault, OverMagnet
from firmware_sim.chips.mpu6050 import Mpu6050
from firmware_sim.chips.mt6701 import Mt6701, Mt6701Ssi
from firmware_sim.chips.pcf8574 import Backpack
from firmware_sim.chips.qmc5883l import Qmc5883l
from firmware_sim.faults import Fallible, SimFault
from firmware_sim.panel import PanelSpec, SimPanel
from firmware_sim.parts.pot import PotFault, PotSpec, SimPot
from firmware_sim.sporadic import Sporadic

AXES = ("azimuth", "elevation")
"""Names of the axes, in the order of `antenna` and `shafts`."""
ENCODERS_I2C: dict[str, type[As5600 | As5048b | Mt6701]] = {"as5600": As5600, "as5048b": As5048b, "mt6701": Mt6701}
ENCODERS_SPI: dict[str, type[As5045 | As5048a | Mt6701Ssi]] = {
    "as5045": As5045,
    "as5048a": As5048a,
    "mt6701-ssi": Mt6701Ssi,
}
ENCODERS = ENCODERS_I2C.keys() | ENCODERS_SPI.keys()
SHAKEN_G = 0.5
"""Fault `elevation-shaken`: the shaking of the sensor's board, rms."""
EACH_READING = 10
"""Faults of single readings and answers strike each so many times, unless another number is asked for."""
EACH_TRANSFER = 20
"""Faults of single transfers on the I2C bus do so: a reading takes some of them."""
EACH_BURST = 60
"""Faults of several readings in a row begin each so many readings."""
LAPSE = 8
"""Fault `-gaps` of a chip on the I2C bus: so many transfers in a row are not answered."""
DRIFT_DEG = 0.02
"""Fault `pot-drifts`: how far a pot's error grows with each reading."""
HARD_IRON_DEG = 40.0
"""Fault `steel-near`: the largest error of the compass."""
LEVEL_UT, DOWN_UT = 20.0, 44.0
"""The earth's field in the middle of Europe."""
COMPASS_LATE_S, COMPASS_NOISE_UT = 0.1, 0.35
"""What a compass chip feels is so old, and so noisy beside a motor: 1°, twice of what its data sheet says."""
IRON_UT, MAGNET_UT = 25.0, 600.0
"""Faults `azimuth-iron-near` and `azimuth-magnet-near`: what they add along the board's x."""


@dataclass(frozen=True, slots=True)
class LcdSpec:
    """A display on six lines (`pins`: GPIO numbers of rs, e, d4 to d7), or behind an expander at the I2C `address`
    (`pins`: the expander's bits of the same names).
    """

    pins: Mapping[str, int]
    address: int | None = None
    backlight_active_high: bool = True
    bus: int = 1


class SimRotor(Fallible):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time)."""

    def __init__(self, clock: Callable[[], float], sleep: Callable[[float], None] | None = None) -> None:
        self._clock = clock
        self._lock = threading.RLock()
        self.gpio = SimGpio(clock)
        self._bus_sleep = sleep
        self._buses: dict[int, SimI2CBus] = {}
        self.spidev = SimSpidev()
        self.wipers: dict[str, Callable[[], float]] = {}
        """By axis name: reads the volts at the wiper of its pot. An axis without a pot is missing."""
        self.faults = {}
        self.lcd: Hd44780 | None = None
        self.panel: SimPanel | None = None

    def antenna(self) -> tuple[float, float]:
        """True azimuth and elevation of the boom in degrees, on the rotor's own scales."""
        raise NotImplementedError

    def shafts(self) -> tuple[float, float]:
        """Angles of the shafts in degrees, on the motor's side of the backlash. Without gears as `antenna`."""
        return self.antenna()

    def drives(self) -> tuple[int, int]:
        """Direction in which the relay coils switch azimuth and elevation: -1, 0 or 1; 0 without relays."""
        return 0, 0

    @property
    def relay_starts(self) -> int | None:
        """How often a motor relay has closed; None: there are no relays."""
        return None

    @property
    def shorted_s(self) -> float:
        """How long both directions of a motor had current at once. Must stay 0."""
        return 0.0

    @property
    def brake_harm(self) -> tuple[float, int]:
        """How long a motor was fed against its brake, and how often a brake fell on a turning shaft. Must stay 0."""
        return 0.0, 0

    def rests(self) -> tuple[float, float]:
        """Where the shafts come to rest, in degrees, if all current ends now."""
        return self.shafts()

    def kept(self) -> dict[str, float]:
        """What the parts keep while they have power, beside the angles of the shafts: a number by name."""
        return {}

    def put_back(self, kept: Mapping[str, float]) -> None:
        """Give the parts what they kept. Empty: the power was off, and each part has lost it."""

    def wire_lcd(self, spec: LcdSpec) -> None:
        """Connect a display of two rows of sixteen characters."""
        if spec.address is not None:
            self.lcd = Hd44780(self.i2c(spec.bus).wire_time(self._clock))
            backpack = Backpack(self.lcd, spec.pins, spec.backlight_active_high)
            self.wire_i2c("lcd", (spec.bus, spec.address), backpack.expander)
            return
        lcd = self.lcd = Hd44780(self._clock)
        levels = {pin: self.gpio.level(pin) for pin in spec.pins.values()}

        def pins_changed(_now_s: float, changes: Mapping[int, bool]) -> None:
            if levels.keys() & changes.keys():
                levels.update((pin, level) for pin, level in changes.items() if pin in levels)
                lcd.pins(**{name: levels[pin] for name, pin in spec.pins.items()})

        self.gpio.on_edges.append(pins_changed)

    def wire_pots(self, pots: Mapping[str, PotSpec], supply_v: float) -> None:
        """Put pots on the shafts of a rotor whose kind has none. `pots` is by axis name."""
        for name, spec in pots.items():
            self._wire_pot(name, SimPot(spec, supply_v))

    def _wire_pot(self, name: str, pot: SimPot) -> None:
        shaft_deg = self._shaft(name)

        def wiper_v() -> float:
            with self._lock:
                return pot.volts(shaft_deg())

        self.wipers[name] = wiper_v
        self.faults[f"{name}-pot-open"] = self._fault_of(pot, "fault", PotFault.OPEN, PotFault.NONE)
        self.faults |= self._pot_sampling(name, pot)

    def _pot_sampling(self, name: str, pot: SimPot) -> dict[str, SimFault]:
        """Faults of single readings of a pot, and of its wear. They can be combined."""
        return {
            f"{name}-pot-crackles": self._sporadic_fault(pot.crackles, EACH_READING),
            f"{name}-pot-spikes": self._sporadic_fault(pot.spikes, EACH_READING),
            f"{name}-pot-bursts": self._sporadic_fault(pot.bursts, EACH_BURST),
            f"{name}-pot-drifts": self._fault_of(pot, "drift_deg", DRIFT_DEG, 0.0),
        }

    def i2c(self, number: int) -> SimI2CBus:
        """The Pi's I2C bus of this number."""
        return self._buses.setdefault(number, SimI2CBus(self._bus_sleep))

    @property
    def bus(self) -> SimI2CBus:
        """The bus that most have alone."""
        return self.i2c(1)

    def open_buses(self) -> None:
        """The next run of the program opens the adapters again."""
        for bus in self._buses.values():
            bus.open()

    def _hang_buses(self) -> None:
        for bus in self._buses.values():
            bus.hang()

    def _release_buses(self) -> None:
        for bus in self._buses.values():
            bus.release()

    def wire_i2c(self, name: str, place: tuple[int, int], chip: I2CChip) -> None:
        """Attach a chip at that bus and address. Fault `NAME-gone`: it does not answer; `NAME-noisy`, `NAME-gaps`: now
        and then."""
        number, address = place
        bus = self.i2c(number)
        bus.attach(address, chip)
        gone = bus.gone
        self.faults[f"{name}-gone"] = SimFault(lambda: gone.add(address), lambda: gone.discard(address))
        noise, gaps = Sporadic(chance=random.Random(address)), Sporadic(LAPSE)
        bus.lapses[address] = noise, gaps
        self.faults[f"{name}-noisy"] = self._sporadic_fault(noise, EACH_TRANSFER)
        self.faults[f"{name}-gaps"] = self._sporadic_fault(gaps, LAPSE * EACH_READING)

    def wire_encoder(self, name: str, kind: str, place: tuple[int, int]) -> None:
        """Put a magnet on the shaft of axis `name`, over a chip at that I2C bus and address, or SPI bus and select."""
        shaft_deg = self._shaft(name)

        def turn() -> float:
            return shaft_deg() / 360.0

        over: OverMagnet
        if (on_spi := ENCODERS_SPI.get(kind)) is not None:
            over = chip = on_spi(turn)
            self.spidev.chips[place] = chip
            self.faults[f"{name}-{kind}-gone"] = self._fault_of(chip, "gone", True, False)
            self.faults[f"{name}-{kind}-noisy"] = self._sporadic_fault(chip.sparks, EACH_TRANSFER)
        else:
            over = on_i2c = ENCODERS_I2C[kind](turn)
            self.wire_i2c(f"{name}-{kind}", place, on_i2c)
        for fault in (MagnetFault.MISSING, MagnetFault.WEAK, MagnetFault.STRONG):
            self.faults[f"{name}-{fault.value}"] = self._fault_of(over, "fault", fault, MagnetFault.NONE)

    def wire_tilt(
        self, part: str, place: tuple[int, int], board_g: Callable[[float, float], tuple[float, float, float]]
    ) -> None:
        """Put the accelerometer `part` on the boom. `board_g` turns gravity along and across the boom into gravity
        along the board's x, y and z.
        """

        def feels_g() -> tuple[float, float, float]:
            elevation = math.radians(self.antenna()[1])
            return board_g(math.sin(elevation), math.cos(elevation))

        makes: dict[str, type[Mpu6050 | Adxl345 | Lsm303Accelerometer]]
        makes = {"mpu6050": Mpu6050, "adxl345": Adxl345, "lsm303-accel": Lsm303Accelerometer}
        chip = makes[part](self._clock, feels_g)
        self.faults["elevation-shaken"] = self._fault_of(chip, "shaken_g", SHAKEN_G, 0.0)
        self.wire_i2c(part, place, chip)

    def wire_compass(
        self, part: str, place: tuple[int, int], board_ut: Callable[[float, float, float], tuple[float, float, float]]
    ) -> Qmc5883l | Hmc5883l:
        """Put the compass chip `part` on the mast, below the elevation. Azimuth 0 on the rotor's own scale is magnetic
        north. `board_ut` turns the field ahead, up and to the left into the field along the board's x, y and z.
        """
        seen: deque[tuple[float, float]] = deque()

        def feels_ut() -> tuple[float, float, float]:
            now_s = self._clock()
            seen.append((now_s, self.antenna()[0]))
            while len(seen) > 1 and seen[1][0] <= now_s - COMPASS_LATE_S:
                seen.popleft()
            azimuth = math.radians(seen[0][1])
            return board_ut(LEVEL_UT * math.cos(azimuth), -DOWN_UT, LEVEL_UT * math.sin(azimuth))

        if part == "qmc5883l":
            chip: Qmc5883l | Hmc5883l = Qmc5883l(self._clock, feels_ut, noise_ut=COMPASS_NOISE_UT)
        else:
            chip = Hmc5883l(self._clock, feels_ut, lsm303=part == "lsm303-mag", noise_ut=COMPASS_NOISE_UT)
        for name, ut in (("iron", IRON_UT), ("magnet", MAGNET_UT)):
            self.faults[f"azimuth-{name}-near"] = self._fault_of(chip, "iron_ut", (ut, 0.0, 0.0), chip.iron_ut)
        self.wire_i2c(part, place, chip)
        return chip

    def wire_bno055(self, place: tuple[int, int], magnetic_deg: Callable[[float], float]) -> Bno055:
        """Put a BNO055 on the boom. `magnetic_deg` turns the boom's azimuth into the chip's magnetic heading."""

        def heading_deg() -> float:
            return magnetic_deg(self.antenna()[0]) % 360.0

        chip = Bno055(self._clock, heading_deg, pitch_deg=lambda: self.antenna()[1])
        self.faults["steel-near"] = self._fault_of(chip, "hard_iron_deg", HARD_IRON_DEG, 0.0)
        self.wire_i2c("compass", place, chip)
        return chip

    def wire_panel(self, spec: PanelSpec) -> SimPanel:
        """Connect a front panel to the same lines and the same bus; its faults are `panel-...`."""
        panel = self.panel = SimPanel(spec, self.gpio, self.i2c, self._clock)
        self.faults |= {f"panel-{name}": fault for name, fault in panel.faults.items() if name != "bus-hung"}
        return panel

    def wire_limit(self, key: str, pin: int, name: str, at_deg: float, *, high: bool) -> None:
        """Connect a limit switch to ground: it opens when the shaft of axis `name` reaches `at_deg`."""
        wire = SimpleNamespace(broken=False)
        shaft_deg = self._shaft(name)

        def catch_up(_now_s: float) -> None:
            reached = shaft_deg() >= at_deg if high else shaft_deg() <= at_deg
            self.gpio.drive_input(pin, None if reached or wire.broken else False)

        self.gpio.drive_input(pin, False)
        self.gpio.on_look.append(catch_up)
        self.faults[f"{key.replace('_', '-')}-switch-open"] = self._fault_of(wire, "broken", True, False)

    def _shaft(self, name: str) -> Callable[[], float]:
        """A function that reads the shaft of axis `name`, in degrees. Raises ValueError for an unknown axis."""
        if name not in AXES:
            raise ValueError(f"no axis called {name!r}; there are: {', '.join(AXES)}")
        place = AXES.index(name)
        return lambda: self.shafts()[place]
