"""The chips that are looked at, real or simulated: the doctor's share of the composition root.

Knows which driver reads what. Takes no line but inputs that are free. Writes to no chip but those that must be told to
measure (converter, gravity sensor, compass), and sends no motor anywhere.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from hw.buses.gpio import GpioInputs, find_chip, holders, real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus
from hw.buses.spi import real_spidev
from hw.chips.ads1115 import Ads1115
from hw.chips.as5600 import As5600
from hw.chips.bno055 import Bno055
from hw.chips.mpu6050 import Mounting, Mpu6050
from hw.chips.pca9685 import MODE1, PRE_SCALE, SLEEP
from hw.moteus.bus import MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.faults import LIMITS, explain
from hw.moteus.library import CanChannel, SerialPort
from hw.moteus.orders import Mode, MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import AngleSensor, Axis, HardwareError
from hw.sensors.pot import Reference
from rotator.assembly.simulation import simulated_rotor
from rotator.config.model import Config

Bus = SmbusI2C

WIDEST_RANGE_V = 6.144
"""Not the box's own: a pot that hangs on too high a supply is to be seen as it is."""
LEAST_PRESCALE = 3
EXTERNAL_CLOCK = 1 << 6
"""A bit of a PCA9685's MODE1 that only its supply clears (NXP PCA9685, section 7.3.1)."""


@dataclass(frozen=True, slots=True)
class OutputBoard:
    """What a PCA9685 says of itself, in MODE1 and PRE_SCALE."""

    mode: int
    prescale: int

    @property
    def plausible(self) -> bool:
        return self.prescale >= LEAST_PRESCALE

    @property
    def asleep(self) -> bool:
        return bool(self.mode & SLEEP)

    @property
    def waits_for_a_clock(self) -> bool:
        return bool(self.mode & EXTERNAL_CLOCK)


@dataclass(frozen=True, slots=True)
class Heard:
    """What a moteus says of itself when it is asked and told nothing."""

    silent: str = ""
    """Why nothing came; empty: it answered."""
    volts: float = 0.0
    temperature_c: float = 0.0
    fault: str = ""
    """What stopped it; empty: nothing."""
    remedy: str = ""
    limit: str = ""
    """What holds it back; empty: nothing."""
    angle_deg: float | None = None
    """On the rotor's own scale; None: it does not know where the antenna points."""


PATIENCE_S = 1.5
"""Controllers answer within milliseconds; an adapter that has just been plugged in takes its time."""
LOOK_S = 0.02
BOOTED_S = 2.0
"""So long ago a simulated station was switched on: a compass takes nearly a second."""


def moteus_drive(config: Config, clock: Callable[[], float]) -> MoteusDrive:
    def spec(axis: Axis) -> MoteusSpec:
        table = getattr(config.moteus, axis.value)
        return MoteusSpec(table.id, table.rev_per_turn, table.zero_rev, geared=table.geared)

    return MoteusDrive(spec(Axis.AZIMUTH), spec(Axis.ELEVATION), clock)


def ask_controllers(config: Config) -> dict[Axis, Heard]:
    """Over the adapter, in real time. Raises HardwareError where the library is missing."""
    drive, table = moteus_drive(config, time.monotonic), config.moteus
    bus = MoteusBus(drive, CanChannel(table.can) if table.can else SerialPort(table.port))
    bus.start()
    try:
        until_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < until_s and not all(drive.answer(axis) for axis in Axis):
            time.sleep(LOOK_S)
        return {axis: heard(drive, axis) for axis in Axis}
    finally:
        bus.close()


def ask_in_step(config: Config, transport: Any, clock: Callable[[], float]) -> dict[Axis, Heard]:
    """On a transport that answers at once. Raises HardwareError where the library is missing."""
    drive = moteus_drive(config, clock)
    MoteusInStep(drive, transport).serve(clock())
    return {axis: heard(drive, axis) for axis in Axis}


def heard(drive: MoteusDrive, axis: Axis) -> Heard:
    answer, why, angle_deg = drive.answer(axis), "", None
    try:
        angle_deg = drive.angle_deg(axis)
    except HardwareError as fault:
        why = str(fault)
    if answer is None:
        return Heard(silent=why)
    stopped = explain(answer.fault) if answer.mode == Mode.FAULT else None
    return Heard(
        volts=answer.volts,
        temperature_c=answer.temperature_c,
        fault=f"{stopped.name} ({answer.fault})" if stopped else "",
        remedy=stopped.remedy if stopped else "",
        limit=LIMITS.get(answer.fault, ""),
        angle_deg=angle_deg,
    )


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
    moteus: Callable[[Config], Mapping[Axis, Heard]] = ask_controllers
    """Asks both controllers how they are. Raises HardwareError where the package is missing."""
    spidev: Callable[[], Any] = real_spidev
    """The spidev package, or anything of its shape. Raises HardwareError where it is missing."""

    def header(self, config: Config) -> str:
        """The path of the chip with the relays. Raises HardwareError."""
        return config.relays.chip or find_chip(self.gpio(), paths=self.paths)

    def holders(self, config: Config, pins: Iterable[int]) -> dict[int, str]:
        """Who holds which of these lines; those that are free are left out. Raises HardwareError."""
        return holders(self.gpio(), self.header(config), pins)

    def closed(self, config: Config, switches: Mapping[str, int]) -> dict[str, bool]:
        """Which of these switches to ground are closed; takes their lines for a moment. Raises HardwareError."""
        inputs = GpioInputs(self.gpio(), self.header(config), switches, consumer="doctor")
        try:
            return inputs.read()
        finally:
            inputs.close()

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

    def sensor(self, bus: SmbusI2C, address: int, config: Config, axis: Axis) -> AngleSensor:
        """The axis's own sensor chip."""
        table = config.axis(axis).sensor
        if table.kind == "as5600":
            return As5600(bus, address, zero_turn=table.zero_turn)
        mounting = Mounting(table.forward, table.up)
        return Mpu6050(bus, self.clock, self.sleep, address=address, mounting=mounting, averaged=table.averaged)

    def compass(self, bus: SmbusI2C, config: Config) -> Bno055:
        table = config.compass
        return Bno055(bus, self.clock, self.sleep, address=table.address, mounting=table.mounting)

    def output_board(self, bus: SmbusI2C, address: int) -> OutputBoard:
        """Reads, and writes nothing. Raises HardwareError."""
        mode, prescale = (bus.write_read(address, bytes([register]), 1)[0] for register in (MODE1, PRE_SCALE))
        return OutputBoard(mode, prescale)


def real_chips() -> Chips:
    return Chips(real_gpiod, None, open_bus, time.monotonic, time.sleep)


def simulated_chips(config: Config) -> Chips:
    """Those of a station that was never switched on."""

    def world() -> Any:
        since_s = 0.0

        def clock() -> float:
            return time.monotonic() + since_s

        rotor = simulated_rotor(config, clock, None, (0.0, 0.0))
        since_s = BOOTED_S
        return rotor

    gpio = world().gpio
    return Chips(
        lambda: gpio,
        gpio.paths(),
        lambda _number: SmbusI2C(world().bus, "simulated bus"),
        time.monotonic,
        time.sleep,
        lambda config: ask_in_step(config, world().transport(), time.monotonic),
        lambda: None,
    )
