"""The hardware half of the composition root: from a configuration to drivers, on real chips or simulated ones.

Knows which driver sits on which bus and which lines, and the order in which they are let go. Decides nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack

from hw.ads1115 import Ads1115
from hw.gpio import PI_HEADER_LABEL, GpioOutputs, find_chip, real_gpiod
from hw.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS, BackpackPort, GpioPort, Hd44780
from hw.heartbeat import Heartbeat
from hw.i2c import SmbusI2C, open_bus
from hw.lines_off import RelayLines
from hw.ports import AngleSensor, Axis, CharacterDisplay
from hw.pot import PotSensor, Reference
from hw.relays import RelayBank
from hw.sentinel import Sentinel
from rotator.config.model import Config
from rotator.simulation import simulated_world


def relay_lines(config: Config, chip: str) -> RelayLines:
    """Every line that must be off for the motors to stand still."""
    return RelayLines(chip, config.relays.outputs, config.relays.active == "low")


class Station:
    """The hardware, real or simulated, behind its drivers. Raises HardwareError where it is missing."""

    bank: RelayBank
    sensors: dict[Axis, AngleSensor]
    display: CharacterDisplay | None
    heartbeat: Heartbeat | None
    sentinel: Sentinel | None
    """None in a simulation: there is nothing that could go on turning."""
    lines: RelayLines

    def __init__(
        self,
        config: Config,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        start_deg: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._config = config
        self._clock = clock
        self._sleep = sleep
        self._buses: dict[int, SmbusI2C] = {}
        self.world = None
        if config.rotor.hardware == "sim":
            self.world = simulated_world(config, clock, sleep if config.sim.bus_takes_time else None, start_deg)
        self._gpio = self.world.gpio if self.world else real_gpiod()
        chip = config.relays.chip or find_chip(
            self._gpio, PI_HEADER_LABEL, self.world.gpio.paths() if self.world else None
        )
        # What has been opened is let go of again, in the opposite order, should something further on be missing.
        with ExitStack() as opened:
            self._open_relays(opened, chip)
            self._open_pots(opened)
            self.display = self._open_display(opened, chip)
            self._opened = opened.pop_all()

    def beat(self) -> None:
        """The step went well: the motors may keep their supply. Raises HardwareError."""
        if self.heartbeat:
            self.heartbeat.beat()

    def close(self) -> None:
        try:
            self.bank.off()
            if self.sentinel:
                self.sentinel.dismiss()
        finally:
            self._opened.close()

    def _open_relays(self, opened: ExitStack, chip: str) -> None:
        relays = self._config.relays
        self.lines = relay_lines(self._config, chip)
        outputs = GpioOutputs(
            self._gpio, chip, self.lines.offsets, consumer="rotator-relays", active_low=self.lines.active_low
        )
        with ExitStack() as taken:
            taken.callback(outputs.close)
            self.sentinel = None if self.world else Sentinel(self.lines)
            taken.pop_all()
        # The lines go first: a sentinel that was not dismissed takes them when they are free.
        if self.sentinel:
            opened.callback(self.sentinel.close)
        opened.callback(outputs.close)
        self.bank = RelayBank(
            outputs,
            self._clock,
            dead_time_s=relays.dead_time_s,
            master=relays.master is not None,
            watch=self.sentinel,
        )
        self.heartbeat = Heartbeat(outputs) if relays.heartbeat is not None else None

    def _open_pots(self, opened: ExitStack) -> None:
        table = self._config.adc
        adc = Ads1115(
            self._bus(opened, table.bus),
            table.address,
            self._sleep,
            rate_sps=table.rate_sps,
            full_scale_v=4.096 if table.supply_v <= 4.096 else 6.144,
        )
        reference = table.reference_channel
        supply = table.supply_v if reference is None else Reference(adc, reference, self._clock)
        self.sensors = {
            Axis.AZIMUTH: PotSensor(adc, table.azimuth_channel, supply),
            Axis.ELEVATION: PotSensor(adc, table.elevation_channel, supply),
        }

    def _open_display(self, opened: ExitStack, chip: str) -> CharacterDisplay | None:
        table = self._config.lcd
        match table.kind:
            case "gpio":
                pins = table.model_dump(include={"rs", "e", "d4", "d5", "d6", "d7"})
                outputs = GpioOutputs(self._gpio, chip, pins, consumer="rotator-lcd")
                opened.callback(outputs.close)
                return Hd44780(GpioPort(outputs, self._sleep), self._sleep)
            case "pcf8574":
                board = table.backpack
                port = BackpackPort(
                    self._bus(opened, table.bus),
                    table.address,
                    BACKPACKS[board],
                    backlight_active_low=board in BACKLIGHT_ACTIVE_LOW,
                )
                return Hd44780(port, self._sleep)
            case _:
                return None

    def _bus(self, opened: ExitStack, number: int) -> SmbusI2C:
        if number not in self._buses:
            bus = SmbusI2C(self.world.bus, "simulated bus") if self.world else open_bus(number)
            opened.callback(bus.close)
            self._buses[number] = bus
        return self._buses[number]
