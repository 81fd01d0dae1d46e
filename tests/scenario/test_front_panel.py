"""A U-100 controller with its front panel, as its builder uses it: hands on the switches, eyes on lamps and meters.

The whole box but its links' sockets, on simulated chips, in simulated time. Positions of the mode switch are as he
numbers them: 0 MANUAL, 1 PARK, 2 AUTO, 3 JOG.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import product
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.panel import SimPanel
from hw.ports import Axis
from rotator.assembly.panel import panel_thread
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop
from tests.search import some

MANUAL, PARK, AUTO, JOG = range(4)
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
BOX = """
[rotor]
type = "relay-pulse"
[azimuth]
max_deg = 360
[relays]
one_at_a_time = true
[panel]
mode_msb = 10
mode_lsb = 9
calibrate = 11
stop = 19
azimuth_knob = 0
elevation_knob = 1
jog = 2
reference = 3
azimuth_meter = 0
elevation_meter = 1
lamp_manual = 2
lamp_park = 3
lamp_auto = 4
lamp_jog = 5
lamp_motor = 6
lamp_stop = 7
[pulses.elevation]
home_deg = -2.0
closes_at_deg = 0.5
[limits]
azimuth_high = 8
elevation_low = 7
"""
STEP_S = 0.05


class Shack:
    def __init__(self, start_deg: tuple[float, float] = (90.0, 30.0), *, calibrate: bool = False) -> None:
        config = parse(BOX, "box")
        self.clock = SimClock()
        self.station = Station(config, self.clock, self.clock.sleep, start_deg, add_alarm=self.clock.add_alarm)
        assert self.station.world is not None
        assert self.station.panel is not None
        self.world: Any = self.station.world
        assert self.world.panel is not None
        self.hands: SimPanel = self.world.panel
        self.hands.set_calibrate(closed=calibrate)
        self.loop = ControlLoop(build_controller(config, panel=True), self.station.rotor, self.clock, STEP_S)
        self.panel = panel_thread(
            config,
            self.station.panel,
            lambda: self.loop.status,
            lambda order: self.loop.post(Source("panel"), order),
            self.clock,
            pulses=self.station.rotor.closed_contacts,
        )
        self._pc = Gs232Session(Client(self.loop, build_mount(config), Source("gs232", 1), clock=self.clock), Dialect.B)
        if not calibrate:
            self.turn_mode(AUTO)  # longer than the lamp test

    def pc(self, line: str) -> None:
        self._pc.receive(line.encode() + b"\r")

    def wait(self, seconds: float, until: Callable[[], bool] = lambda: False) -> bool:
        """Let time pass, no longer than until that is so."""
        for _ in range(round(seconds / STEP_S)):
            if until():
                return True
            self.clock.sleep(STEP_S)
            self.loop.cycle()
            self.panel.cycle(self.clock())
        return until()

    def turn_mode(self, position: int) -> None:
        """Turn the switch and wait until the box believes it."""
        self.hands.turn_mode(position)
        self.wait(1.5)

    def press(self, axis: str, way: int) -> None:
        """Throw a jog switch for a moment."""
        self.hands.throw(axis, way)
        self.wait(0.3)
        self.hands.throw(axis, 0)
        self.wait(0.3)

    def comes_to(self, azimuth_deg: float, elevation_deg: float) -> bool:
        self.wait(120.0, lambda: self.loop.status.moving)
        self.wait(120.0, lambda: not self.loop.status.moving)
        return self.shafts == pytest.approx((azimuth_deg, elevation_deg), abs=2.0)

    @property
    def shafts(self) -> tuple[float, float]:
        shafts: tuple[float, float] = self.world.shafts()
        return shafts

    @property
    def stands(self) -> bool:
        return not self.loop.status.moving


@pytest.fixture
def shack() -> Shack:
    return Shack()


def test_a_press_in_auto_is_added_to_the_order_until_the_mode_changes(shack: Shack) -> None:
    shack.pc("W120 045")
    assert shack.comes_to(120.0, 45.0)
    for _ in range(2):
        shack.press("azimuth", +1)
    assert shack.comes_to(130.0, 45.0)
    assert shack.loop.status.wanted_azimuth_deg is not None
    shack.turn_mode(PARK)
    shack.turn_mode(AUTO)
    shack.pc("W120 045")
    assert shack.comes_to(120.0, 45.0)


def test_manual_goes_where_the_knobs_were_left_and_not_where_the_pc_wants(shack: Shack) -> None:
    shack.turn_mode(MANUAL)
    shack.pc("W300 010")
    shack.wait(3.0)
    assert shack.stands
    shack.hands.turn_knob("azimuth", 0.5)
    shack.wait(0.5)
    assert shack.hands.needle("azimuth") == pytest.approx(0.5, abs=0.02), "the meter shows the knob"
    assert shack.stands, "it may still be turned on"
    assert shack.comes_to(180.0, 30.0)
    assert shack.hands.needle("elevation") == pytest.approx(30.0 / 180.0, abs=0.02), "and then where the rotor is"


def test_park_obeys_nobody(shack: Shack) -> None:
    shack.pc("W200 045")
    shack.wait(3.0)
    shack.turn_mode(PARK)
    assert shack.loop.status.mode is Mode.PARK
    stood = shack.shafts
    shack.pc("W300 010")
    shack.hands.turn_knob("azimuth", 0.9)
    shack.press("azimuth", -1)
    shack.wait(5.0)
    assert shack.shafts == pytest.approx(stood, abs=0.5)


def test_jog_drives_while_a_switch_is_held(shack: Shack) -> None:
    shack.turn_mode(JOG)
    shack.hands.throw("elevation", +1)
    shack.wait(3.0)
    assert shack.world.drives() == (0, 1)
    assert "motor" in shack.hands.lit()
    shack.hands.throw("elevation", 0)
    shack.wait(1.5)
    assert shack.stands
    assert shack.shafts[1] == pytest.approx(30.0 + 6.0 * 3.0, abs=3.0)


@pytest.mark.long
def test_the_stop_button_stops_and_only_a_person_at_the_panel_ends_it(shack: Shack) -> None:
    shack.pc("W300 045")
    shack.wait(3.0)
    assert shack.world.drives() != (0, 0)
    shack.hands.press_stop()
    shack.wait(0.15)
    assert shack.world.drives() == (0, 0)
    shack.hands.pull_stop()
    shack.pc("W300 045")
    shack.wait(3.0)
    assert shack.stands, "latched"
    assert "stop" in shack.hands.lit()
    shack.turn_mode(PARK)
    shack.turn_mode(AUTO)
    shack.pc("W300 045")
    assert shack.comes_to(300.0, 45.0)


@pytest.mark.search
@pytest.mark.parametrize(
    ("turned", "axis", "wire"),
    some(list(product([0.05, 0.5, 0.98], ["azimuth", "elevation"], ["wire", "supply", "ground"]))),
)
def test_a_broken_wire_of_a_knob_moves_nothing_in_manual_and_is_told(axis: str, wire: str, turned: float) -> None:
    shack = Shack()
    shack.hands.turn_knob("azimuth", turned)
    shack.hands.turn_knob("elevation", turned)
    shack.turn_mode(MANUAL)
    shack.wait(3.0)
    stood = shack.shafts
    shack.world.inject(f"panel-{axis}-knob-{wire}-broken")
    shack.wait(10.0)
    assert shack.shafts == stood
    status = shack.loop.status.axis(Axis(axis))
    assert [notice.lcd for notice in status.notices] == ["KNOB OPEN"]
    assert f"the panel's {axis} knob reads" in str(status.notices[0])
    shack.world.clear(f"panel-{axis}-knob-{wire}-broken")
    shack.wait(5.0)
    assert shack.shafts == stood, "mended, it must be turned before it counts"
    assert shack.loop.status.axis(Axis(axis)).notices == ()


@pytest.mark.long
def test_a_knob_with_a_loose_wire_never_sends_the_antenna_to_an_end() -> None:
    """It makes and breaks contact at random, while the other knob is turned."""
    chance = random.Random(1)
    shack = Shack()
    shack.hands.turn_knob("azimuth", 0.25)
    shack.turn_mode(MANUAL)
    for _ in range(120):
        (shack.world.inject if chance.random() < 0.5 else shack.world.clear)("panel-azimuth-knob-wire-broken")
        shack.hands.turn_knob("elevation", chance.uniform(0.1, 0.3))
        shack.wait(chance.choice([0.05, 0.1, 0.3, 1.5]))
        assert shack.shafts[0] == pytest.approx(90.0, abs=2.0)


def test_a_dead_panel_bus_ends_a_jog(shack: Shack) -> None:
    shack.turn_mode(JOG)
    shack.hands.throw("azimuth", +1)
    shack.wait(1.0)
    assert shack.world.drives() == (1, 0)
    shack.world.inject("panel-adc-gone")
    shack.wait(1.0)
    assert shack.world.drives() == (0, 0)


def test_a_limit_switch_lets_the_axis_go_back_only() -> None:
    shack = Shack((350.0, 30.0))
    shack.turn_mode(JOG)
    shack.world.inject("azimuth-high-switch-open")
    shack.hands.throw("azimuth", +1)
    shack.wait(1.0)
    assert shack.world.drives() == (0, 0)
    assert shack.loop.status.azimuth.fault is not None
    assert shack.loop.status.azimuth.fault.name == "limit switch reached"
    shack.hands.throw("azimuth", 0)
    shack.pc("S")
    shack.wait(0.5)
    shack.hands.throw("azimuth", -1)
    shack.wait(2.0)
    assert shack.world.drives() == (-1, 0)


@pytest.mark.long
def test_the_calibrate_switch_leads_through_homing() -> None:
    # Switched on with the calibrate switch closed and both knobs at their ends; each step of the mode switch goes on.
    shack = Shack((40.0, 25.0), calibrate=True)
    for axis in ("azimuth", "elevation"):
        shack.hands.turn_knob(axis, 0.97)
    shack.wait(2.0)
    shack.turn_mode(PARK)
    assert shack.wait(60.0, lambda: shack.loop.status.azimuth.homing)
    assert shack.wait(180.0, lambda: not shack.loop.status.azimuth.homing and shack.stands)
    shack.turn_mode(AUTO)
    assert shack.wait(60.0, lambda: shack.loop.status.elevation.homing)
    assert shack.wait(180.0, lambda: not shack.loop.status.elevation.homing and shack.stands)
    assert shack.shafts == pytest.approx((0.0, -2.0), abs=0.5), "the elevation at its limit switch"
    shack.turn_mode(JOG)
    shack.turn_mode(AUTO)
    shack.pc("W120 045")
    assert shack.comes_to(120.0, 45.0)
