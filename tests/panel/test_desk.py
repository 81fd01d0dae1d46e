"""The front panel in simulated time: from a switch to an order, from the box to a lamp and a needle, and what fails."""

from __future__ import annotations

import logging
from dataclasses import replace

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.clock import SimClock
from firmware_sim.panel import PanelSpec, SimPanel
from hw.buses.gpio import GpioInputs
from hw.ports import Direction
from rotator.exchange.orders import Home, Jog, Mode, Nudge, Order, Release, SetMode, Stop
from rotator.exchange.status import AxisStatus, Status
from rotator.panel.panel import Panel, PanelSettings
from rotator.panel.thread import PanelParts, PanelThread
from tests.panel.desk import AUTO, AZ, EL, FULL_SCALE, JOG, PARK, Desk, in_mode


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


@pytest.mark.parametrize(("refusals", "seconds"), [(1, 12.0), (3, 32.0)])
def test_full_scales_that_the_disk_refuses_are_tried_again_until_they_are_kept(refusals: int, seconds: float) -> None:
    desk = Desk()
    desk.refusals = refusals
    desk.sim.set_calibrate(closed=True)
    for axis in ("azimuth", "elevation"):
        desk.sim.turn_knob(axis, 0.95)
    desk.waits(seconds)
    assert desk.kept == pytest.approx({AZ: 0.95, EL: 0.95}, abs=0.001)
    assert desk.refusals == -1, "and then no more"


def test_full_scales_that_the_disk_refuses_are_tried_once_more_at_the_end() -> None:
    desk = Desk()
    desk.refusals = 1
    desk.sim.set_calibrate(closed=True)
    for axis in ("azimuth", "elevation"):
        desk.sim.turn_knob(axis, 0.95)
    desk.waits(3.0)
    assert desk.kept == {}
    desk.thread.stop()
    assert desk.kept == pytest.approx({AZ: 0.95, EL: 0.95}, abs=0.001)


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


def test_what_has_not_changed_is_not_written_again() -> None:
    desk = in_mode(AUTO)
    writes: list[None] = []
    desk.sim.board.before_change.append(lambda: writes.append(None))
    desk.waits(10.0)
    assert len(writes) <= 2 * 11  # only the addresses of what `check` reads, once a second


def test_at_the_end_it_is_dark_also_where_the_chip_has_just_failed_to_answer() -> None:
    desk = in_mode(AUTO)
    desk.sim.inject("outputs-gone")
    desk.waits(1.1)
    desk.sim.clear("outputs-gone")
    assert desk.sim.lit() == {"auto"}
    desk.thread.stop()
    assert desk.sim.lit() == set()
    assert desk.needles() == (0.0, 0.0)


def test_a_stop_button_alone_is_a_panel() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    sim = SimPanel(PanelSpec(stop=16), gpio, lambda _number: SimI2CBus(), clock)
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


def test_with_a_supply_10_percent_low_no_press_begins_and_with_the_reference_wired_every_one_is_right() -> None:
    for reference, orders in ((None, []), (3, [Nudge(AZ, 5.0)])):
        desk = in_mode(AUTO, reference)
        desk.sim.inject("supply-sags")
        assert desk.waits(1.5) == []
        desk.sim.throw("azimuth", 1)
        assert desk.waits(1.0) == orders


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
