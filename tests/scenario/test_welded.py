"""A welded relay is never met by the opposite one: found so with real drivers on simulated chips, judged by the motor.

Each test is a way in which it once was. What counts is the time for which both directions of a motor had current.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.exchange.motor import Trusts
from rotator.exchange.orders import Aim, Jog, RelaysChecked, Stop
from rotator.runtime.loop import ControlLoop
from rotator.store.relays import after
from tests.rotors.rig import KINDS, PERSON, Box, Kind

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
KIND: dict[str, Kind] = {kind.profile: kind for kind in KINDS}
MASTER: dict[str, Any] = {"relays": {"master": 26}}
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


def restart(box: Box, *, proper: bool, away_s: float = 2.0) -> None:
    """The program ends, its relays drop; the world goes on, and the program starts anew."""
    box.rotor.off()
    kept: dict[Axis, Trusts] = {axis: after(box.axis(axis).trusts, proper=proper) for axis in Axis}
    box.left_alone(away_s)
    box.rotor.restore()
    box.loop = ControlLoop(build_controller(box.config, trusts=kept), box.rotor, box.clock, box.period_s)
    box.run(0.1)


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
