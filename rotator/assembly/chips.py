"""Opens the chips that the doctor reads, real or simulated: its share of the composition root.

Knows the driver of each chip. Takes only inputs, and the SPI lines of the converter, and only while they are free.
Writes only to the chips that need an order to measure (converter, gravity sensor, compass). Moves no motor.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, closing, contextmanager
from dataclasses import dataclass
from typing import Any

from hw.buses.gpio import GpioInputs, find_chip, holders, real_gpiod
from hw.buses.i2c import SmbusI2C, open_bus
from hw.buses.pwm import KernelFiles, header_chip
from hw.buses.spi import real_spidev
from hw.chips.bno055 import Bno055
from hw.chips.ls7366r import Ls7366r
from hw.chips.pca9685 import MODE1, PRE_SCALE, SLEEP
from hw.controllers.drive import ControllerDrive
from hw.moteus.drive import MoteusDrive
from hw.moteus.faults import LIMITS, explain
from hw.moteus.orders import Mode
from hw.moteus.wire import MoteusInStep
from hw.ports import AngleSensor, Axis, HardwareError
from rotator.assembly.adc import Converter, open_adc
from rotator.assembly.buses import Buses
from rotator.assembly.kinds.controller import controller_drive
from rotator.assembly.kinds.moteus import moteus_bus, moteus_drive
from rotator.assembly.sensors import compass_chip, sensor_chip
from rotator.assembly.simulation import SimulatedStation
from rotator.config.model import Config

Bus = SmbusI2C

LEAST_PRESCALE = 3
EXTERNAL_CLOCK = 1 << 6
"""A bit of a PCA9685's MODE1 that only its supply clears (NXP PCA9685, section 7.3.1)."""


@dataclass(frozen=True, slots=True)
class OutputBoard:
    """The registers MODE1 and PRE_SCALE of a PCA9685."""

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
    """What a moteus answers to a query without an order."""

    silent: str = ""
    """Why there is no answer; empty: it answered."""
    volts: float = 0.0
    temperature_c: float = 0.0
    fault: str = ""
    """What stopped it; empty: nothing."""
    remedy: str = ""
    limit: str = ""
    """What limits it; empty: nothing."""
    angle_deg: float | None = None
    """On the rotor's own scale; None: the controller does not know where the antenna points."""


PATIENCE_S = 1.5
"""Controllers answer within milliseconds; an adapter needs longer after it has been plugged in."""
LOOK_S = 0.02
READY_MADE_S = 4.0
"""An Arduino starts anew when its port is opened."""
BOOTED_S = 2.0
"""The time since power-on of a simulated station: a compass takes nearly a second to boot."""


def ask_controllers(config: Config) -> dict[Axis, Heard]:
    """Over the adapter, in real time. Raises HardwareError where the library is missing."""
    drive = moteus_drive(config, time.monotonic, look_only=True)
    bus = moteus_bus(config.moteus, drive)
    bus.start()
    try:
        until_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < until_s and not all(drive.answer(axis) for axis in Axis):
            time.sleep(LOOK_S)
        return {axis: heard(drive, axis) for axis in Axis}
    finally:
        bus.close()


def ask_ready_made(config: Config) -> dict[Axis, float | str]:
    """What each axis's ready-made controller tells, in degrees; or why there is nothing. Orders nothing."""
    drive = controller_drive(config, time.monotonic)
    drive.start()
    try:
        until_s = time.monotonic() + READY_MADE_S
        while time.monotonic() < until_s and not drive.answered:
            drive.enforce(time.monotonic())
            time.sleep(LOOK_S)
        return {axis: _told(drive, axis) for axis in config.fitted}
    finally:
        drive.finish()


def _told(drive: ControllerDrive, axis: Axis) -> float | str:
    try:
        return drive.angle_deg(axis)
    except HardwareError as fault:
        return str(fault)


def ask_in_step(config: Config, transport: Any, clock: Callable[[], float]) -> dict[Axis, Heard]:
    """On a transport that answers at once. Raises HardwareError where the library is missing."""
    drive = moteus_drive(config, clock, look_only=True)
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
        limit=LIMITS[answer.fault].name if answer.fault in LIMITS else "",
        angle_deg=angle_deg,
    )


@dataclass(frozen=True, slots=True)
class Chips:
    """The ways to the chips. `clock` and `sleep` are for the conversions of the chips."""

    gpio: Callable[[], Any]
    """The gpiod package, or an object of its shape. Raises HardwareError where it is missing or the wrong one."""
    paths: list[str] | None
    """The paths of the GPIO chips; None: those in /dev."""
    open_bus: Callable[[int], SmbusI2C]
    clock: Callable[[], float]
    sleep: Callable[[float], None]
    moteus: Callable[[Config], Mapping[Axis, Heard]] = ask_controllers
    """The state of both controllers. Raises HardwareError if the package is missing."""
    spidev: Callable[[], Any] = real_spidev
    """The spidev package, or an object of its shape. Raises HardwareError where it is missing."""
    pwm: Callable[[], str] = lambda: header_chip(KernelFiles())
    """The folder of the header's PWM. Raises HardwareError where it is missing."""
    controllers: Callable[[Config], Mapping[Axis, float | str]] = ask_ready_made
    """What each axis's ready-made controller tells, in degrees; or why there is nothing."""

    def header(self, config: Config) -> str:
        """The path of the chip with the relays. Raises HardwareError."""
        return config.relays.chip or find_chip(self.gpio(), paths=self.paths)

    def holders(self, config: Config, pins: Iterable[int]) -> dict[int, str]:
        """The program that holds each of these lines; free lines are left out. Raises HardwareError."""
        return holders(self.gpio(), self.header(config), pins)

    def closed(self, config: Config, switches: Mapping[str, int]) -> dict[str, bool]:
        """Which of these switches to ground are closed; takes their lines for a moment. Raises HardwareError."""
        with closing(GpioInputs(self.gpio(), self.header(config), switches, consumer="doctor")) as inputs:
            return inputs.read()

    def bus(self, number: int) -> AbstractContextManager[SmbusI2C]:
        """Raises HardwareError where it cannot be opened."""
        return closing(self.open_bus(number))

    @contextmanager
    def converter(self, config: Config) -> Iterator[Converter]:
        """The converter of the pots, with its widest range. Raises HardwareError where its bus cannot be opened."""
        with ExitStack() as opened:
            yield open_adc(config.adc, self._buses(opened, config), widest=True)

    @contextmanager
    def sensor(self, config: Config, axis: Axis) -> Iterator[AngleSensor]:
        """The sensor chip of this axis, which has one. Raises HardwareError where its bus cannot be opened."""
        with ExitStack() as opened:
            sensor = sensor_chip(config, axis, self._buses(opened, config))
            assert sensor is not None
            yield sensor

    def counter_placed(self, config: Config, axis: Axis) -> bool:
        """Whether the axis's LS7366R has counted on from a place. Reads, and writes nothing. Raises HardwareError."""
        with ExitStack() as opened:
            (use,) = config.kind.spi_uses()
            bus = self._buses(opened, config).spi(use)
            return Ls7366r(bus, f"{axis.value}.select").look()[1].is_place

    def _buses(self, opened: ExitStack, config: Config) -> Buses:
        return Buses(
            opened,
            gpiod=self.gpio,
            paths=self.paths,
            open_bus=self.open_bus,
            spidev=self.spidev,
            clock=self.clock,
            sleep=self.sleep,
            header=config.relays.chip,
        )

    def compass(self, bus: SmbusI2C, config: Config) -> Bno055:
        return compass_chip(config.compass, bus, self.clock, self.sleep)

    def output_board(self, bus: SmbusI2C, address: int) -> OutputBoard:
        """Reads, and writes nothing. Raises HardwareError."""
        mode, prescale = (bus.write_read(address, bytes([register]), 1)[0] for register in (MODE1, PRE_SCALE))
        return OutputBoard(mode, prescale)


def real_chips() -> Chips:
    return Chips(real_gpiod, None, open_bus, time.monotonic, time.sleep)


def simulated_chips(config: Config) -> Chips:
    """The chips of a simulated station on which no program has run yet."""

    def world() -> Any:
        since_s = 0.0

        def clock() -> float:
            return time.monotonic() + since_s

        rotor = SimulatedStation(config, clock, None, (0.0, 0.0)).build()
        since_s = BOOTED_S
        return rotor

    gpio = world().gpio
    return Chips(
        lambda: gpio,
        gpio.paths(),
        lambda number: SmbusI2C(world().i2c(number), "simulated bus"),
        time.monotonic,
        time.sleep,
        lambda config: ask_in_step(config, world().transport(), time.monotonic),
        lambda: world().spidev,
        lambda: header_chip(world().pwm),
    )
