"""A front panel from its switches to its lamps: the real drivers on simulated chips, in simulated or in real time."""

from __future__ import annotations

import errno
import os
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.clock import SimClock
from firmware_sim.panel import PanelSpec, SimPanel
from hw.buses.gpio import GpioInputs
from hw.buses.i2c import SmbusI2C
from hw.chips.ads1115 import Ads1115
from hw.chips.pca9685 import Pca9685
from hw.ports import AngleSource, Axis
from hw.sensors.pot import PotSensor, Reference
from rotator.exchange.orders import Mode, Order, Release, SetMode, Stop
from rotator.exchange.status import AxisStatus, Status
from rotator.panel.lights import LightWiring
from rotator.panel.panel import LAMPS, Panel, PanelSettings
from rotator.panel.thread import PanelParts, PanelThread

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MANUAL, PARK, AUTO, JOG = range(4)
PINS: dict[str, Any] = {"mode_msb": 20, "mode_lsb": 21, "calibrate": 19, "stop": 16}
INPUTS: dict[str, Any] = {"azimuth_knob": 0, "elevation_knob": 1, "jog": 2}
LAMP_OUTPUTS = {name: output for output, name in enumerate(LAMPS, start=2)}
METERS = {AZ: 0, EL: 1}
FULL_SCALE = 0.9
SPEC = PanelSpec(
    **PINS,
    **INPUTS,
    lamps=LAMP_OUTPUTS,
    meters={axis.value: output for axis, output in METERS.items()},
    meter_full_share=FULL_SCALE,
    end_ohm=0.0,
    pull_ohm=1e12,
)


class Lines:
    """The simulated lines, as gpiod shows them when the chip's driver has gone."""

    def __init__(self, gpio: SimGpio) -> None:
        self.gone = False
        self._gpio = gpio

    def request_lines(self, path: str, **wanted: Any) -> Lines:
        self._request = self._gpio.request_lines(path, **wanted)
        return self

    def get_values(self, offsets: list[int]) -> list[Any]:
        if self.gone:
            raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))
        return self._request.get_values(offsets)


class Bench:
    def __init__(
        self, clock: Callable[[], float], sleep: Callable[[float], None], reference: int | None = None
    ) -> None:
        self.gpio = SimGpio(clock)
        self.lines = Lines(self.gpio)
        self.wire = SimI2CBus(sleep)
        self.sim = SimPanel(SPEC, self.gpio, lambda _number: self.wire, clock)
        self.status = Status(
            0.0,
            AxisStatus(0.0, 360.0, angle_deg=90.0, source=AngleSource.COUNTED),
            AxisStatus(0.0, 180.0, angle_deg=45.0),
        )
        self.bug = False
        self.posted: list[Order] = []
        self.kept: dict[Axis, float] = {}
        self.refusals = 0
        """So many of the next writes to the disk fail."""
        self.pulses: set[Axis] = set()
        self.failures: list[Exception] = []
        self.disk = threading.Event()
        """While it is cleared, a write to the disk waits."""
        self.disk.set()
        self.changed = threading.Condition()
        bus = SmbusI2C(self.wire, "bus 1")
        adc = Ads1115(bus, 0x49, sleep)
        supply: Reference | float = 3.3
        if reference is not None:
            self.sim.adc.inputs[reference] = lambda: self.sim.supply_v
            supply = Reference(adc, reference, clock)
        self.thread = PanelThread(
            Panel(PanelSettings()),
            PanelParts(
                switches=GpioInputs(self.lines, "/dev/gpiochip0", PINS, consumer="panel"),
                has_stop=True,
                sensors={name: PotSensor(adc, channel, supply) for name, channel in INPUTS.items()},
                outputs=Pca9685(bus, 0x41, sleep, frequency_hz=1000.0),
                lights=LightWiring(LAMP_OUTPUTS, METERS, FULL_SCALE),
            ),
            self._asked,
            self._take,
            clock,
            keep=self._keep,
            pulses=lambda: self.pulses,
            failed=self._fail,
        )

    def _asked(self) -> Status:
        if self.bug:
            raise RuntimeError("a bug")
        return self.status

    def _keep(self, full_scales: Mapping[Axis, float]) -> bool:
        self.disk.wait()
        with self.changed:
            self.refusals -= 1
            if self.refusals >= 0:
                return False
            self.kept.update(full_scales)
            self.changed.notify_all()
            return True

    def _fail(self, failure: Exception) -> None:
        with self.changed:
            self.failures.append(failure)
            self.changed.notify_all()

    def _take(self, order: Order) -> None:
        """As the controller does, as far as a panel sees it."""
        with self.changed:
            self.posted.append(order)
            match order:
                case Stop(latch=True):
                    self.status = replace(self.status, latched="panel")
                case Release():
                    self.status = replace(self.status, latched="")
            self.changed.notify_all()

    def ordered(self) -> list[Order]:
        """What has been ordered since this was asked the last time."""
        orders, self.posted = self.posted, []
        return orders


class Desk(Bench):
    """In simulated time, one step after the other."""

    def __init__(self, reference: int | None = None) -> None:
        self.clock = SimClock(100.0)
        super().__init__(self.clock, self.clock.sleep, reference)

    def waits(self, seconds: float) -> list[Order]:
        until_s = self.clock() + seconds
        while self.clock() < until_s:
            due_s = self.clock() + 0.05
            self.thread.cycle(self.clock())
            self.thread.save(self.clock())
            self.clock.sleep_until(due_s)
        return self.ordered()

    def needles(self) -> tuple[float, float]:
        return self.sim.needle("azimuth"), self.sim.needle("elevation")


def in_mode(position: int, reference: int | None = None) -> Desk:
    desk = Desk(reference)
    desk.sim.turn_mode(position)
    assert desk.waits(1.5) == [SetMode((Mode.MANUAL, Mode.PARK, Mode.AUTO, Mode.JOG)[position])]
    return desk
