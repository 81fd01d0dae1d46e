"""A front panel from its switches to its lamps: the real drivers on simulated chips, in simulated time.

At the end the threads themselves, which wait for events with timeouts far longer than anything should take.
"""

from __future__ import annotations

import errno
import logging
import os
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, cast

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.clock import SimClock
from firmware_sim.panel import PanelSpec, SimPanel
from hw.buses.gpio import GpioInputs
from hw.buses.i2c import SmbusI2C
from hw.chips.ads1115 import Ads1115
from hw.chips.pca9685 import Pca9685
from hw.ports import AngleSource, Axis, Direction
from hw.sensors.pot import PotSensor, Reference
from rotator.orders import Aim, Home, Jog, Mode, Nudge, Order, Release, SetMode, Stop
from rotator.panel.panel import LAMPS, Panel, PanelSettings
from rotator.panel.thread import PANEL_THREADS, PanelParts, PanelThread
from rotator.status import AxisStatus, Status

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
PATIENCE_S = 30.0


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
        self.sim = SimPanel(SPEC, self.gpio, self.wire, clock)
        self.status = Status(
            0.0,
            AxisStatus(0.0, 360.0, angle_deg=90.0, source=AngleSource.COUNTED),
            AxisStatus(0.0, 180.0, angle_deg=45.0),
        )
        self.bug = False
        self.posted: list[Order] = []
        self.kept: dict[Axis, float] = {}
        self.pulses: set[Axis] = set()
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
                lamps=LAMP_OUTPUTS,
                meters=METERS,
                meter_full_scale=FULL_SCALE,
            ),
            self._asked,
            self._take,
            clock,
            keep=self.kept.update,
            pulses=lambda: self.pulses,
        )

    def _asked(self) -> Status:
        if self.bug:
            raise RuntimeError("a bug")
        return self.status

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
            self.clock.sleep_until(due_s)
        return self.ordered()

    def needles(self) -> tuple[float, float]:
        return self.sim.needle("azimuth"), self.sim.needle("elevation")


def in_mode(position: int, reference: int | None = None) -> Desk:
    desk = Desk(reference)
    desk.sim.turn_mode(position)
    assert desk.waits(1.5) == [SetMode((Mode.MANUAL, Mode.PARK, Mode.AUTO, Mode.JOG)[position])]
    return desk


@pytest.mark.parametrize(("position", "name"), list(enumerate(("manual", "park", "auto", "jog"))))
def test_each_position_sets_its_mode_and_lights_its_lamp(position: int, name: str) -> None:
    assert in_mode(position).sim.lit() == {name}


def test_meters_show_where_the_axes_stand_and_do_not_flicker() -> None:
    desk = in_mode(AUTO)
    assert desk.needles() == pytest.approx((0.25, 0.25), abs=0.004)
    assert desk.sim.board.period_s() == pytest.approx(1e-3, rel=0.1)
    assert desk.sim.board.early_writes == 0


def test_a_needle_reaches_its_end_and_no_further() -> None:
    desk = in_mode(AUTO)
    desk.status = replace(desk.status, azimuth=replace(desk.status.azimuth, angle_deg=360.0))
    desk.waits(0.2)
    assert desk.sim.board.high_share(0) == pytest.approx(FULL_SCALE, abs=0.001)


@pytest.mark.parametrize(
    ("axis", "way", "nudge"),
    [
        ("azimuth", 1, (AZ, 5.0)),
        ("azimuth", -1, (AZ, -5.0)),
        ("elevation", 1, (EL, 5.0)),
        ("elevation", -1, (EL, -5.0)),
    ],
)
def test_jog_switches_nudge_in_auto(axis: str, way: int, nudge: tuple[Axis, float]) -> None:
    desk = in_mode(AUTO)
    desk.sim.throw(axis, way)
    assert desk.waits(1.0) == [Nudge(*nudge)]
    assert desk.sim.lit() == {"auto", "switch"}


def test_with_a_supply_10_percent_low_no_press_begins_and_with_the_reference_wired_every_one_is_right() -> None:
    for reference, orders in ((None, []), (3, [Nudge(AZ, 5.0)])):
        desk = in_mode(AUTO, reference)
        desk.sim.inject("supply-sags")
        assert desk.waits(1.5) == []
        desk.sim.throw("azimuth", 1)
        assert desk.waits(1.0) == orders


def test_knobs_send_the_antenna_in_manual() -> None:
    desk = in_mode(MANUAL)
    for tenth in range(1, 6):
        desk.sim.turn_knob("azimuth", tenth / 10)
        assert desk.waits(0.2) == []
    assert desk.needles() == pytest.approx((0.5, 0.25), abs=0.004)
    assert desk.waits(1.2) == [Aim(cast(Any, pytest.approx(180.0, abs=0.5)), None)]
    assert desk.needles() == pytest.approx((0.25, 0.25), abs=0.004)


def test_in_park_the_needles_follow_the_knobs() -> None:
    desk = in_mode(PARK)
    desk.sim.turn_knob("elevation", 0.75)
    assert desk.waits(3.0) == []
    assert desk.needles() == pytest.approx((0.0, 0.75), abs=0.004)


def test_jog_drives_while_held_and_two_at_once_stop() -> None:
    desk = in_mode(JOG)
    desk.sim.throw("elevation", -1)
    assert set(desk.waits(1.0)) == {Jog(EL, Direction.MINUS, 0.3)}
    desk.sim.throw("azimuth", 1)
    assert desk.waits(1.0) == [Stop((EL,))]
    desk.sim.throw("elevation", 0)
    assert desk.waits(1.0) == []


@pytest.mark.parametrize("fault", ["jog-wire-broken", "jog-shorted", "adc-gone"])
def test_any_fault_of_the_jog_switches_stops_it(fault: str) -> None:
    desk = in_mode(JOG)
    desk.sim.throw("azimuth", 1)
    desk.waits(0.5)
    desk.sim.inject(fault)
    assert desk.waits(3.0) == [Stop((AZ,))]


def test_readings_that_do_not_come_any_more_stop_it() -> None:
    desk = in_mode(JOG)
    desk.sim.throw("azimuth", 1)
    desk.waits(0.5)
    for _ in range(10):  # the bus hangs, and its thread with it
        desk.clock.sleep(0.05)
        desk.thread.step(desk.clock())
    jogs, last = desk.posted[:-1], desk.posted[-1]
    assert set(jogs) == {Jog(AZ, Direction.PLUS, 0.3)}
    assert len(jogs) <= 5
    assert last == Stop((AZ,))


def test_a_mode_switch_that_bounces_tells_nothing() -> None:
    desk = in_mode(AUTO)
    desk.sim.inject("mode-switch-bouncing")
    assert desk.waits(10.0) == []
    desk.sim.clear("mode-switch-bouncing")
    assert desk.waits(2.0) == []


def test_the_stop_button_and_the_way_back() -> None:
    desk = in_mode(JOG)
    desk.sim.throw("azimuth", 1)
    desk.waits(0.5)
    desk.sim.press_stop()
    assert desk.waits(2.0) == [Stop(latch=True)]
    assert desk.sim.lit() == {"jog", "stop"}
    desk.sim.pull_stop()
    assert desk.waits(2.0) == []
    desk.sim.turn_mode(AUTO)
    assert desk.waits(2.0) == [Release(), SetMode(Mode.AUTO)]
    assert desk.sim.lit() == {"auto"}


def test_a_broken_wire_to_the_stop_button_is_a_pressed_button() -> None:
    desk = in_mode(AUTO)
    desk.sim.inject("stop-wire-broken")
    assert desk.waits(1.0) == [Stop(latch=True)]


def test_switches_that_cannot_be_read_are_a_pressed_stop_button_and_logged_once(
    caplog: pytest.LogCaptureFixture,
) -> None:
    desk = in_mode(AUTO)
    desk.lines.gone = True
    assert desk.waits(5.0) == [Stop(latch=True)]
    desk.lines.gone = False
    assert desk.waits(5.0) == []
    assert [record.message for record in caplog.records] == [
        "panel: switches: GPIO: cannot read mode_msb, mode_lsb, calibrate, stop: No such device",
        "panel: switches: answers again",
    ]


def test_calibration_at_power_up() -> None:
    desk = Desk()
    desk.sim.set_calibrate(closed=True)
    desk.sim.turn_knob("azimuth", 0.95)
    desk.sim.turn_knob("elevation", 0.9)
    assert desk.waits(3.0) == [SetMode(Mode.MANUAL)]
    assert desk.kept == pytest.approx({AZ: 0.95, EL: 0.9}, abs=0.001)
    assert desk.needles() == pytest.approx((1.0, 1.0), abs=0.004)
    for position, orders in (
        (PARK, [Release(), Home(AZ)]),
        (AUTO, [Release(), Home(EL)]),
        (JOG, [Release(), SetMode(Mode.JOG)]),
    ):
        desk.sim.turn_mode(position)
        assert desk.waits(3.0) == orders


def test_lamps_of_pulses_and_data() -> None:
    desk = in_mode(AUTO)
    desk.pulses = {AZ}
    desk.thread.data_received()
    desk.waits(0.05)
    assert desk.sim.lit() == {"auto", "azimuth_pulse", "data"}
    desk.waits(0.3)
    assert desk.sim.lit() == {"auto", "azimuth_pulse"}


@pytest.mark.parametrize(
    ("fault", "what"), [("adc-gone", "knobs and jog switches"), ("outputs-gone", "lamps and meters")]
)
def test_a_chip_that_fails_is_logged_once_and_tried_again(
    fault: str, what: str, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO, "rotator.panel.thread")
    desk = in_mode(AUTO)
    desk.sim.inject(fault)
    desk.status = replace(desk.status, azimuth=replace(desk.status.azimuth, angle_deg=180.0))
    desk.waits(10.0)
    desk.sim.clear(fault)
    desk.waits(2.0)
    first, second = [record.message for record in caplog.records]
    assert first.startswith(f"panel: {what}: I2C bus 1: the device does not answer")
    assert second == f"panel: {what}: answers again"
    assert desk.needles() == pytest.approx((0.5, 0.25), abs=0.004)
    desk.sim.throw("azimuth", 1)
    assert desk.waits(1.0) == [Nudge(AZ, 5.0)]


def test_outputs_that_were_reset_are_set_up_anew() -> None:
    desk = in_mode(AUTO)
    desk.sim.inject("outputs-dip")
    assert desk.sim.lit() == set()
    desk.waits(3.0)
    assert desk.sim.lit() == {"auto"}
    assert desk.needles() == pytest.approx((0.25, 0.25), abs=0.004)


def test_what_has_not_changed_is_not_written_again() -> None:
    desk = in_mode(AUTO)
    writes: list[None] = []
    desk.sim.board.before_change.append(lambda: writes.append(None))
    desk.waits(10.0)
    assert len(writes) <= 2 * 11  # only the addresses of what `check` reads, once a second


def test_at_the_end_it_is_dark() -> None:
    desk = in_mode(AUTO)
    desk.thread.stop()
    assert desk.sim.lit() == set()
    assert desk.needles() == (0.0, 0.0)


def test_a_stop_button_alone_is_a_panel() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    sim = SimPanel(PanelSpec(stop=16), gpio, SimI2CBus(), clock)
    posted: list[Order] = []
    status = Status(0.0, AxisStatus(0.0, 360.0), AxisStatus(0.0, 180.0))
    inputs = GpioInputs(gpio, "/dev/gpiochip0", {"stop": 16}, consumer="panel")
    parts = PanelParts(switches=inputs, has_stop=True)
    thread = PanelThread(Panel(PanelSettings(mode_switch=False)), parts, lambda: status, posted.append, clock)
    thread.cycle(0.0)
    assert posted == []
    sim.press_stop()
    thread.cycle(0.05)
    assert posted == [Stop(latch=True)]


# --- the threads


@pytest.fixture
def running() -> Iterator[Bench]:
    bench = Bench(time.monotonic, lambda _seconds: None)
    bench.thread.start()
    yield bench
    bench.sim.clear("bus-hung")
    bench.thread.stop()
    assert not set(PANEL_THREADS) & {thread.name for thread in threading.enumerate()}


def test_a_bus_that_hangs_does_not_take_the_stop_button_with_it(running: Bench) -> None:
    running.sim.inject("bus-hung")
    running.sim.press_stop()
    with running.changed:
        assert running.changed.wait_for(lambda: Stop(latch=True) in running.posted, PATIENCE_S)


def test_running_it_reads_and_posts(running: Bench) -> None:
    with running.changed:
        assert running.changed.wait_for(lambda: SetMode(Mode.MANUAL) in running.posted, PATIENCE_S)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_when_the_thread_fails_it_is_as_if_the_button_were_pressed() -> None:
    bench = Bench(time.monotonic, lambda _seconds: None)
    bench.bug = True
    bench.thread.start()
    with bench.changed:
        assert bench.changed.wait_for(lambda: Stop(latch=True) in bench.posted, PATIENCE_S)
    bench.thread.stop()
