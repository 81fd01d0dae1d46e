"""A TV rotator from which nothing comes back, the whole box on its simulator: where it is taken to be, and where it is.

Its motor is up to 2 % faster one way, and 2.5 % slower the other, than the file says.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rotator.assembly.settings import build_mount
from rotator.control.admission import refusal
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Aim, Confirm, Home, Park, Stop
from rotator.store.counts import CountsFile, Standing
from rotator.views import lcd, plain_lines
from tests.rotors.rig import AZ, EL, PERSON, Box, Kind, configured
from tests.rotors.rig import KINDS as EVERY

KIND: Kind = next(kind for kind in EVERY if kind.profile == "tv-rotator")


def new(tmp_path: Path, start_deg: tuple[float, float] = (90.0, 30.0), **tables: Any) -> Box:
    """A box that finds its files again: its world is kept."""
    kept = {"world": str(tmp_path / "world.json")}
    timed = {"anew_after_deg": 300.0}
    return Box(KIND, start_deg, counts=tmp_path / "counts.json", sim=kept, timed=timed, **tables)


def points_where_it_says(box: Box) -> None:
    for axis in (AZ, EL):
        each = box.axis(axis)
        assert each.angle_deg is not None
        assert each.error_deg is not None
        assert abs(each.angle_deg - box.boom_deg(axis)) <= each.error_deg, each


def rests(box: Box) -> None:
    """At its end stop a shaft stands though its relay is still closed."""
    box.run(1.0)
    box.until(lambda: not (box.axis(AZ).homing or box.axis(EL).homing))
    box.run(1.0)
    box.until_it_stands()


def home(box: Box) -> None:
    box.order(Home(AZ), Home(EL), by=PERSON)
    box.run(1.0)
    box.until(lambda: not box.axis(AZ).missing and not box.axis(EL).missing)
    rests(box)


def test_a_new_box_goes_to_its_stop_before_the_first_target(tmp_path: Path) -> None:
    box = new(tmp_path, (200.0, 100.0))
    box.run(1.0)
    assert box.axis(AZ).missing == (Missing.HOMING,)
    assert "± ?" in plain_lines.line(box.status)
    assert lcd.rows(box.status, 2.0)[1] == "+/- A:--- E:--- "
    assert box.world.shafts() == (200.0, 100.0), "no motion before an order"
    order = Aim(60.0, 20.0)
    assert refusal(order, box.status, build_mount(box.config)) is None
    box.order(order)
    box.run(1.0)
    assert box.axis(AZ).homing
    assert box.axis(AZ).target_deg == 60.0
    box.until(lambda: box.axis(AZ).missing == ())
    assert box.world.shafts()[0] == pytest.approx(0.0, abs=0.1)
    rests(box)
    assert box.boom_deg(AZ) == pytest.approx(60.0, abs=6.0)
    assert box.boom_deg(EL) == pytest.approx(20.0, abs=6.0)
    points_where_it_says(box)
    assert "≈60° ± " in plain_lines.line(box.status)
    assert lcd.rows(box.status, 2.0)[1] == "+/- A:003 E:002 "
    assert box.status.faults == ()
    box.close()


def test_after_long_travel_it_goes_to_its_stop_first_but_never_amid_a_pass(tmp_path: Path) -> None:
    box = new(tmp_path, (10.0, 0.0))
    home(box)
    for second in range(200):  # a pass of a program, an order each second
        box.order(Aim(20.0 + second, 10.0 + 0.3 * second))
        box.run(1.0)
        assert not box.axis(AZ).homing
    for place_deg in (60.0, 300.0):  # what comes soon after it
        box.order(Aim(place_deg, 10.0))
        rests(box)
    points_where_it_says(box)
    worst_deg = box.axis(AZ).error_deg
    box.run(61.0)
    assert not box.status.moving, "no motion before an order"
    box.order(Park())
    box.run(1.0)
    assert box.axis(AZ).homing
    assert box.axis(AZ).drive == -1
    rests(box)
    assert box.boom_deg(AZ) == pytest.approx(180.0, abs=7.0)
    points_where_it_says(box)
    assert (box.axis(AZ).error_deg or 99.0) < (worst_deg or 0.0) / 2
    assert box.status.faults == ()
    box.close()


def test_a_stop_amid_a_run_and_on_the_way_to_the_end_stop(tmp_path: Path) -> None:
    box = new(tmp_path)
    box.order(Aim(60.0, 20.0))
    box.run(3.0)
    box.order(Stop())
    box.until_it_stands()
    stood_deg = box.world.shafts()
    box.run(5.0)
    assert box.world.shafts() == stood_deg
    assert box.axis(AZ).missing == (Missing.HOMING,), "it never was at its stop"
    home(box)
    box.order(Aim(200.0, 90.0))
    box.run(5.0)
    box.order(Stop())
    box.until_it_stands()
    points_where_it_says(box)
    assert box.boom_deg(AZ) == pytest.approx(31.0, abs=3.0)
    box.close()


def test_a_person_says_where_it_stands(tmp_path: Path) -> None:
    box = new(tmp_path, (137.0, 40.0))
    box.run(1.0)
    box.order(Confirm(AZ, 137.0), Confirm(EL, 40.0), by=PERSON)
    box.run(1.0)
    assert box.axis(AZ).missing == ()
    assert box.axis(AZ).error_text == " ± 1°"
    box.order(Aim(170.0, 60.0))
    box.run(1.0)
    assert not box.axis(AZ).homing
    rests(box)
    points_where_it_says(box)
    box.close()


@pytest.mark.parametrize("cut", [False, True], ids=["ended at rest", "power cut while it turned"])
def test_what_the_next_run_knows(tmp_path: Path, cut: bool) -> None:
    box = new(tmp_path, (90.0, 30.0))
    box.order(Confirm(AZ, 90.0), Confirm(EL, 30.0), by=PERSON)
    box.run(1.0)
    box.order(Aim(150.0, 60.0))
    if cut:
        box.run(3.0)
    else:
        rests(box)
    before, shafts_deg = box.axis(AZ), box.world.shafts()
    kept = CountsFile(tmp_path / "counts.json", configured("tv-rotator").kind.cams((AZ, EL))).load()
    assert kept[AZ].standing is (Standing.LOST if cut else Standing.KNOWN)
    again = new(tmp_path, shafts_deg)
    again.run(1.0)
    after = again.axis(AZ)
    if cut:
        assert after.missing == (Missing.HOMING,)
    else:
        assert after.missing == ()
        assert after.angle_deg == pytest.approx(before.angle_deg, abs=0.01)
        assert after.error_deg == pytest.approx(before.error_deg, abs=0.01)
    again.close()
    box.close()
