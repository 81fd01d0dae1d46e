"""Every kind of rotor keeps out of its forbidden sectors, with the real drivers on simulated chips."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from benchmarks.drills.boxes import KINDS
from benchmarks.drills.draw import BESIDE, draw
from benchmarks.drills.play import play
from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Stop
from tests.rotors.rig import Box, Kind

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
CHIMNEY = {"name": "the chimney", "azimuth_deg": [120.0, 150.0], "elevation_deg": [0.0, 45.0]}


@pytest.fixture
def beside(kind: Kind, new_box: Callable[..., Box]) -> Box:
    """Each kind of rotor at azimuth 90, below the top of a chimney."""
    box = new_box(kind, mount={"forbidden": [CHIMNEY]})
    box.run(1.0)
    box.order(Aim(90.0, 30.0, place=True))
    box.run(60.0)
    return box


def run(box: Box, seconds: float) -> None:
    """The boom is judged twenty times a second."""
    for _ in range(round(seconds * 20)):
        box.run(0.05)
        azimuth_deg, elevation_deg = box.boom_deg(AZ), box.boom_deg(EL)
        assert not (120 < azimuth_deg < 150 and elevation_deg < 45), f"{azimuth_deg:.2f} {elevation_deg:.2f}"


def test_it_goes_over_the_chimney(beside: Box) -> None:
    beside.order(Aim(170.0, 30.0, place=True))
    run(beside, 100.0)
    assert beside.boom_deg(AZ) == pytest.approx(170, abs=5)
    assert beside.boom_deg(EL) == pytest.approx(30, abs=5)


def test_a_jog_ends_before_it(beside: Box) -> None:
    beside.order(Jog(AZ, Direction.PLUS))
    run(beside, 60.0)
    assert not beside.status.moving
    assert 92 < beside.boom_deg(AZ) < 120


def test_orders_that_change_in_mid_move_do_not_cut_its_corner(beside: Box) -> None:
    for target in ((170.0, 30.0), (90.0, 60.0), (160.0, 10.0), (135.0, 80.0), (135.0, 10.0), (60.0, 10.0)):
        beside.order(Aim(*target, place=True))
        run(beside, 7.0)
    beside.order(Stop())
    run(beside, 3.0)


@pytest.mark.parametrize("seed", [f"1{BESIDE}", f"2{BESIDE}"])
@pytest.mark.parametrize("drilled", KINDS)
def test_a_random_drill_beside_random_sectors(drilled: str, seed: str) -> None:
    drill = draw(seed, drilled)
    assert drill.tables["mount"]["forbidden"]
    assert play(drill).violations == []
