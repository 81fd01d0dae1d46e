"""The front panel with a wire, a chip or a supply that fails, in simulated time: what it does then, and says."""

from __future__ import annotations

import logging
from dataclasses import replace

import pytest

from hw.ports import Direction
from rotator.exchange.orders import Jog, Nudge, Stop
from tests.panel.desk import AUTO, AZ, JOG, in_mode


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
