"""A welded relay is never met by the opposite one: found so with real drivers on simulated chips, judged by the motor.

Each test is a way in which it once was. What counts is the time for which both directions of a motor had current.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.exchange.motor import Trust, Trusts
from rotator.exchange.orders import Aim, Jog, RelaysChecked, Stop
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop
from rotator.store.relays import after
from tests.rotors.rig import KINDS, LINK, PERSON, Box, Kind

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
KIND: dict[str, Kind] = {kind.profile: kind for kind in KINDS}
MASTER: dict[str, Any] = {"relays": {"master": 26}}
WITH_AND_WITHOUT_MASTER = pytest.mark.parametrize("tables", [{}, MASTER], ids=["alone", "master"])
NewBox = Callable[..., Box]


@pytest.fixture
def new_box() -> Iterator[NewBox]:
    boxes: list[Box] = []

    def make(profile: str, start_deg: float, **tables: Any) -> Box:
        boxes.append(Box(KIND[profile], (start_deg, 30.0), **tables))
        boxes[-1].run(2.0)
        return boxes[-1]

    yield make
    for box in boxes:
        box.close()


def motor(speed_dps: float, lag_s: float = 0.15) -> dict[str, Any]:
    """The real azimuth motor; the file believes in 6°/s."""
    return {"sim": {"azimuth": {"speed_dps": speed_dps, "lag_s": lag_s}}}


def weld(box: Box, way: Direction) -> None:
    box.world.inject(f"azimuth-relay-welded-{'cw' if way > 0 else 'ccw'}")


def order_back(box: Box, way: Direction, by: Source = LINK) -> None:
    """Acknowledged and ordered against the welded relay, again and again."""
    for _ in range(4):
        box.order(Stop(), Jog(AZ, Direction(-way), 2.0), by=by)
        box.run(5.0)
    assert box.world.shorted_s == 0.0


def restart(box: Box, *, proper: bool, away_s: float = 2.0) -> None:
    """The program ends, its relays drop; the world goes on, and the program starts anew."""
    box.rotor.off()
    kept: dict[Axis, Trusts] = {axis: after(box.axis(axis).trusts, proper=proper) for axis in Axis}
    box.left_alone(away_s)
    box.rotor.restore()
    box.loop = ControlLoop(build_controller(box.config, trusts=kept), box.rotor, box.clock, box.period_s)
    box.run(0.1)


@WITH_AND_WITHOUT_MASTER
@pytest.mark.parametrize("speed_dps", [6.0, 4.5, 2.0])
def test_whatever_speed_the_file_believes_in(new_box: NewBox, speed_dps: float, tables: dict[str, Any]) -> None:
    box = new_box("g5500", 200.0, **motor(speed_dps), **tables)
    box.order(Jog(AZ, PLUS))
    box.run(5.0)
    weld(box, PLUS)
    order_back(box, PLUS)
    assert [fault.name for fault in box.status.faults] == ["relay welded"]


@pytest.mark.parametrize("seconds", [0.05, 0.1, 0.12])
@pytest.mark.parametrize("speed_dps", [6.0, 2.0])
def test_after_a_tap(new_box: NewBox, speed_dps: float, seconds: float) -> None:
    box = new_box("g5500", 200.0, **motor(speed_dps))
    box.order(Jog(AZ, PLUS, seconds))
    box.until(lambda: bool(box.axis(AZ).drive))
    weld(box, PLUS)
    box.until(lambda: not box.axis(AZ).drive)
    order_back(box, PLUS)
    assert box.axis(AZ).trusts[0] is Trust.WELDED


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["high", "low"])
@pytest.mark.parametrize("before_deg", [1.0, 3.0, 6.0, 9.0])
def test_within_a_second_and_a_half_of_a_stop(new_box: NewBox, before_deg: float, way: Direction) -> None:
    stop_deg = 452.0 if way > 0 else -2.0
    at_deg = stop_deg - way * before_deg
    box = new_box("g5500", min(max(at_deg - way * 20.0, 0.0), 450.0))
    box.order(Jog(AZ, way))
    box.until(lambda: (box.shaft_deg(AZ) - at_deg) * way >= 0.0 or not box.axis(AZ).drive, 20.0)
    weld(box, way)
    box.order(Stop())
    box.run(5.0)
    order_back(box, way)


def test_after_a_stop_at_a_stop(new_box: NewBox) -> None:
    box = new_box("g5500", 400.0)
    box.world.inject("azimuth-stop-early")
    box.order(Aim(450.0, None))
    box.until(lambda: box.shaft_deg(AZ) >= 445.9)
    box.run(0.7)
    weld(box, PLUS)
    box.order(Stop())
    box.run(2.0)
    order_back(box, PLUS)
    assert [fault.name for fault in box.status.faults] == ["relay not seen to open"]


@WITH_AND_WITHOUT_MASTER
@pytest.mark.parametrize("proper", [False, True], ids=["killed", "stopped"])
@pytest.mark.parametrize("start_deg", [200.0, 440.0])
def test_after_a_restart(new_box: NewBox, start_deg: float, proper: bool, tables: dict[str, Any]) -> None:
    box = new_box("g5500", start_deg, **tables)
    box.order(Jog(AZ, PLUS))
    box.run(1.6)
    weld(box, PLUS)
    restart(box, proper=proper)
    order_back(box, PLUS)
    restart(box, proper=proper)
    order_back(box, PLUS)


def test_with_a_master_the_motors_get_their_supply_alone_before_the_first_relay(new_box: NewBox) -> None:
    box = new_box("g5500", 200.0, **MASTER)
    weld(box, PLUS)
    box.run(5.0)
    assert box.shaft_deg(AZ) == 200.0
    box.order(Jog(AZ, MINUS, 2.0))
    box.until(lambda: box.axis(AZ).fault is not None, 3.0)
    box.run(1.0)
    assert box.world.drives() == (0, 0)
    assert box.world.shorted_s == 0.0
    assert box.world.relay_starts == 0
    assert box.shaft_deg(AZ) < 215.0, "the master is open again"


@pytest.mark.parametrize("at_deg", [1.5, 3.0, 6.0, 9.0, 354.0, 357.5, 359.0])
def test_a_counting_rotor_near_its_stop(new_box: NewBox, at_deg: float) -> None:
    way = MINUS if at_deg < 180.0 else PLUS
    box = new_box("u100", at_deg - way * 25.0)
    box.order(Aim(at_deg, None))
    box.until(lambda: bool(box.axis(AZ).drive))
    weld(box, way)
    box.run(12.0)
    order_back(box, way)


def test_an_axis_that_is_not_calibrated(new_box: NewBox) -> None:
    box = new_box("g5500", 200.0)
    box.loop = ControlLoop(build_controller(box.config, commissioning=AZ), box.rotor, box.clock, box.period_s)
    box.run(1.0)
    box.order(Jog(AZ, PLUS, 2.0), by=PERSON)
    box.run(1.0)
    weld(box, PLUS)
    order_back(box, PLUS, PERSON)
    assert [fault.name for fault in box.status.faults] == ["relay welded"]


# --- the way back


def test_a_relay_that_was_found_closed_stays_suspected_until_a_run_of_its_own_has_ended(new_box: NewBox) -> None:
    box = new_box("g5500", 200.0)
    box.order(Jog(AZ, PLUS))
    box.run(3.0)
    weld(box, PLUS)
    box.order(Stop())
    box.until(lambda: box.axis(AZ).fault is not None, 3.0)
    box.world.clear("azimuth-relay-welded-cw")
    box.run(10.0)
    restart(box, proper=True)
    box.run(10.0)
    box.order(Stop(), Aim(100.0, None))
    box.run(3.0)
    assert [fault.name for fault in box.status.faults] == ["relay welded"], "that it stands shows nothing"
    box.order(Stop(), Jog(AZ, PLUS, 1.0))
    box.run(4.0)
    assert box.arrives(100.0, 30.0)
    assert box.status.faults == ()


def test_or_until_a_person_has_looked_at_it(new_box: NewBox) -> None:
    box = new_box("g5500", 400.0)
    box.world.inject("azimuth-stop-early")
    box.order(Aim(450.0, None))
    box.until(lambda: box.axis(AZ).fault is not None, 20.0)
    box.order(Stop(), Aim(100.0, None))
    box.run(3.0)
    assert [fault.name for fault in box.status.faults] == ["relay not seen to open"]
    box.order(RelaysChecked(AZ), by=PERSON)
    box.order(Stop())
    box.run(0.5)
    assert box.arrives(100.0, 30.0)
