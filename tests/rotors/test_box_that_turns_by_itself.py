"""A control box whose chip does not hear it, with a pot on its rotor: the whole box, and what a person is told."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from rotator.exchange.orders import Aim, Stop
from tests.rotors.rig import AZ, EL, KINDS, Box

ORBIT = next(kind for kind in KINDS if kind.profile == "orbit360")
POTS: dict[str, Any] = {"azimuth": {"sensor": {"kind": "pot"}}, "elevation": {"sensor": {"kind": "pot"}}}


@pytest.fixture
def box() -> Iterator[Box]:
    """As it is sold to builders: with the relay in the boxes' supply."""
    box = Box(ORBIT, **POTS)
    yield box
    box.close()


def lost_in_mid_move(box: Box) -> float:
    """Its select wire breaks while azimuth turns, and a program says S. Returns where it was then."""
    box.run(2.0)
    box.order(Aim(300.0, None))
    box.run(5.0)
    box.world.inject("azimuth-select-broken")
    box.run(0.5)
    box.order(Stop())
    return box.boom_deg(AZ)


def test_with_the_relay_it_is_cut_off_after_4_degrees_and_stays_so_until_a_person_says(box: Box) -> None:
    stopped_deg = lost_in_mid_move(box)
    box.run(10.0)
    assert box.boom_deg(AZ) == pytest.approx(stopped_deg, abs=7.0)
    (fault,) = box.status.faults
    assert (fault.name, fault.axis, fault.cut, fault.act_now) == ("turning with no relay on", AZ, True, "")
    assert "The box has switched the motors' supply off" in str(fault)
    assert [notice.lcd for notice in box.axis(EL).notices] == ["BOX OFF"]
    stood_deg = box.boom_deg(AZ), box.boom_deg(EL)
    box.order(Aim(40.0, 60.0))
    box.run(10.0)
    assert (box.boom_deg(AZ), box.boom_deg(EL)) == pytest.approx(stood_deg, abs=0.1)
