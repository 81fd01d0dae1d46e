"""How a flight of the box's own ends: what a refused order, a fault and `resume` leave of it, on both axes.

A pass goes from 100° to 220° of azimuth and from 10° to 70° of elevation in four minutes.
"""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import ANYTHING, Reading
from rotator.control.axis.settings import PositionedSettings
from rotator.control.commands import Steer
from rotator.control.controller import Controller
from rotator.control.settings import Settings
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan, Fly
from rotator.exchange.orders import Aim, Jog, LetGo, Order, Release, Stop
from rotator.exchange.sources import TRACKER, Source
from rotator.exchange.status import Status
from rotator.views.sky_plot import off_deg
from tests.control.conftest import LOW_RAW

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
TRACK, CONSOLE, OTHER = Source(TRACKER), Source("console"), Source("rotctld", 1)
LASTS_S = 240.0
SETTLED_S = 3.0
COASTS_DEG = 2.0


class Steered:
    """A desk with two drives that go to an angle by themselves, at 20°/s."""

    def __init__(self) -> None:
        self.angle_deg = {AZ: 100.0, EL: 10.0}
        self.instead: dict[Axis, float | None] = {}
        """Readings in place of the sensor's; None: no answer."""
        self.now_s = 1000.0
        limits = {AZ: Range(0.0, 450.0), EL: Range(0.0, 180.0)}
        azimuth, elevation = (
            PositionedSettings(
                axis, each, 1.0, 20.0, ANYTHING, Calibration(((0.0, 0.0), (450.0, 450.0))), accel_dps2=20.0
            )
            for axis, each in limits.items()
        )
        self.controller = Controller(Settings(azimuth, elevation, Mount(limits[AZ], limits[EL])))
        self.run(1.0)

    @property
    def status(self) -> Status:
        return self.controller.status(self.now_s)

    def step(self, *orders: Order, by: Source = OTHER) -> None:
        self.now_s += 0.05
        readings = {axis: Reading(self.now_s, self.instead.get(axis, self.angle_deg[axis])) for axis in Axis}
        for axis, command in self.controller.step(self.now_s, readings, [(by, order) for order in orders]).items():
            if isinstance(command, Steer):
                gone_deg = command.angle_deg - self.angle_deg[axis]
                self.angle_deg[axis] += max(-1.0, min(1.0, gone_deg))
        self.controller.note_driven(self.now_s, dict.fromkeys(Axis, Direction.OFF))

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.05)):
            self.step()


@pytest.fixture(params=["relays", "steered"])
def either(request: pytest.FixtureRequest, new_desk: Any) -> Any:
    """Two axes at 100° and 10°, with motors on relays or drives that go to an angle by themselves."""
    desk = new_desk() if request.param == "relays" else Steered()
    desk.step()
    return desk


def fly(desk: Any) -> None:
    begin_s = desk.now_s
    moments_s = [begin_s + PLAN_STEP_S * count for count in range(round(LASTS_S / PLAN_STEP_S) + 1)]
    path = tuple((at_s, 100.0 + (at_s - begin_s) / 2, 10.0 + (at_s - begin_s) / 4) for at_s in moments_s)
    azimuth, elevation = (AxisPlan(begin_s, tuple(row[place] for row in path), ()) for place in (1, 2))
    desk.step(Fly("ISS", path, azimuth, elevation), by=TRACK)
    desk.run(20.0)
    assert desk.status.flown is not None
    assert desk.angle_deg[AZ] == pytest.approx(110.0, abs=5.0)


def turned_deg(desk: Any, seconds: float) -> tuple[float, float]:
    """How far each axis has turned, in so many seconds from the end of the coasting on."""
    desk.run(SETTLED_S)
    azimuth_deg, elevation_deg = desk.angle_deg[AZ], desk.angle_deg[EL]
    desk.run(seconds)
    return abs(desk.angle_deg[AZ] - azimuth_deg), abs(desk.angle_deg[EL] - elevation_deg)


@pytest.mark.long
@pytest.mark.parametrize("axis", Axis)
def test_after_a_fault_and_resume_neither_axis_flies_on(either: Any, axis: Axis) -> None:
    fly(either)
    either.instead[axis] = None
    either.run(2.0)
    assert either.status.axis(axis).fault is not None
    del either.instead[axis]
    either.run(2.0)
    either.step(Release(), by=CONSOLE)
    assert either.status.flown is None
    assert max(turned_deg(either, 100.0)) < COASTS_DEG


@pytest.mark.long
@pytest.mark.parametrize("ended_by", [Stop(), Release(), Jog(AZ, Direction.PLUS, 0.1), Aim(110.0, 20.0)], ids=str)
@pytest.mark.parametrize("runs_deg", [0.0, -20.0])
def test_what_was_ordered_stays_shown_through_a_fault_until_a_person_or_an_order_ends_it(
    either: Any, runs_deg: float, ended_by: Order
) -> None:
    """A stalled motor stands, and one with a welded relay runs on: neither looks as if it were on target."""
    raw = either.raw(AZ) if hasattr(either, "raw") else either.angle_deg[AZ]
    raw_per_deg = (either.raw(AZ) - LOW_RAW) / 100.0 if hasattr(either, "raw") else 1.0
    either.instead[AZ] = raw
    either.step(Aim(170.0, 10.0))
    either.run(10.0)
    for _ in range(100):
        either.instead[AZ] += runs_deg / 100 * raw_per_deg
        either.step()
    status = either.status
    assert status.azimuth.fault is not None
    assert (status.wanted_azimuth_deg, status.wanted_elevation_deg) == (170.0, 10.0)
    assert (status.azimuth.target_deg, status.azimuth.ordered_deg) == (None, 170.0)
    assert status.azimuth.off_deg == pytest.approx(70.0 - runs_deg, abs=2.0)
    assert off_deg(status) == pytest.approx(70.0 - runs_deg, rel=0.1)
    either.step(ended_by, by=CONSOLE)
    either.run(0.1)
    now = either.status.azimuth
    # A release ends no fault whose cause is still there, and so not what was ordered.
    lasts = isinstance(ended_by, Release) and now.fault_present
    assert lasts is (isinstance(ended_by, Release) and now.fault is not None)
    assert now.ordered_deg == (110.0 if isinstance(ended_by, Aim) else 170.0 if lasts else None)
    assert either.status.wanted_azimuth_deg == now.ordered_deg
    if lasts:
        assert off_deg(either.status) == pytest.approx(70.0 - runs_deg, rel=0.1)


def test_after_a_fault_and_resume_a_stream_stands_where_it_pointed_last(desk: Any) -> None:
    for second in range(10):
        desk.step(Aim(110.0 + 2.0 * second, 20.0 + second))
        desk.run(0.95)
    desk.instead[AZ] = None
    desk.run(1.0)
    del desk.instead[AZ]
    desk.run(1.0)
    desk.step(Release(), by=CONSOLE)
    assert turned_deg(desk, 60.0)[0] == pytest.approx(0.0, abs=0.1)
    assert desk.angle_deg[EL] <= 29.0 + 4.0


def test_an_order_out_of_reach_leaves_the_flight_as_it_was(new_desk: Any) -> None:
    desk = new_desk(azimuth=(0.0, 230.0))
    desk.step()
    fly(desk)
    desk.step(Aim(300.0, 20.0), by=TRACK)
    assert desk.controller.troubles, "the log has it"
    assert desk.status.flown is not None
    assert (desk.status.wanted_azimuth_deg, desk.status.wanted_elevation_deg) != (300.0, 20.0)
    desk.run(20.0)
    assert desk.angle_deg[AZ] == pytest.approx(121.5, abs=5.0), "it goes on, and says so"


@pytest.mark.long
@pytest.mark.parametrize("azimuth_alone", [True, False])
def test_an_order_for_one_axis_ends_the_flight_of_the_other(either: Any, azimuth_alone: bool) -> None:
    fly(either)
    either.step(Aim(110.0, None) if azimuth_alone else Aim(None, 15.0), by=OTHER)
    assert either.status.flown is None
    either.run(10.0)
    assert max(turned_deg(either, 60.0)) < 0.1


@pytest.mark.long
@pytest.mark.parametrize("order", [Stop(), Stop(latch=True), LetGo(), Jog(AZ, Direction.PLUS, 1.0)], ids=str)
def test_what_ends_a_flight_ends_it_on_both_axes(either: Any, order: Any) -> None:
    fly(either)
    either.step(order, by=OTHER if order == Stop() else CONSOLE)
    assert either.status.flown is None
    either.run(10.0)
    assert max(turned_deg(either, 60.0)) < 0.1


@pytest.mark.parametrize("order", [Jog(EL, Direction.PLUS, 0.2), Aim(None, 15.0), Stop((EL,))], ids=str)
def test_an_order_for_one_axis_stops_the_other_on_its_way_to_where_the_pass_begins(desk: Any, order: Order) -> None:
    begin_s = desk.now_s + 60.0
    path = tuple((begin_s + PLAN_STEP_S * count, 250.0, 10.0) for count in range(10))
    azimuth, elevation = (AxisPlan(begin_s, (angle_deg,) * 10, ()) for angle_deg in (250.0, 10.0))
    desk.step(Fly("ISS", path, azimuth, elevation), by=TRACK)
    desk.run(5.0)
    assert desk.driven[AZ] is Direction.PLUS
    desk.step(order, by=OTHER)
    assert desk.status.flown is None
    assert turned_deg(desk, 20.0)[0] == pytest.approx(0.0, abs=0.1)


def test_resume_without_a_stop_or_a_fault_lets_the_flight_go_on(either: Any) -> None:
    fly(either)
    either.step(Release(), by=CONSOLE)
    either.run(20.0)
    assert either.status.flown is not None
    assert either.angle_deg[AZ] == pytest.approx(120.0, abs=5.0)


# --- beside a forbidden sector

CHIMNEY = Sector("chimney", Range(100.0, 140.0), Range(30.0, 60.0), 2.0)


def below_the_chimney(new_desk: Any) -> Any:
    """Azimuth has stood below it and has lost its pot for a second. Then another program raises elevation."""
    desk = new_desk(at=(120.0, 0.0), sectors=(CHIMNEY,))
    desk.step()
    desk.step(Aim(120.0, 0.0))
    desk.run(2.0)
    desk.instead[AZ] = None
    desk.run(1.0)
    assert desk.status.azimuth.fault is not None
    del desk.instead[AZ]
    desk.run(1.0)
    desk.step(Aim(None, 80.0), by=OTHER)
    desk.run(10.0)
    assert desk.angle_deg[AZ] == 120.0
    return desk


def test_resume_moves_no_axis_out_of_the_way_of_the_other(new_desk: Any) -> None:
    desk = below_the_chimney(new_desk)
    desk.step(Release(), by=CONSOLE)
    desk.run(60.0)
    assert desk.status.azimuth.fault is None
    assert desk.angle_deg[AZ] == 120.0
    assert desk.angle_deg[EL] < 30.0


def test_the_next_order_moves_it_out_of_the_way(new_desk: Any) -> None:
    desk = below_the_chimney(new_desk)
    desk.step(Release(), by=CONSOLE)
    desk.step(Aim(None, 80.0), by=OTHER)
    desk.run(120.0)
    assert desk.angle_deg[EL] == pytest.approx(80.0, abs=5.0)
