"""Every named fault, injected into the simulated station while the real drivers and the control loop run it.

How soon the relays are off, what is said, how it is acknowledged; and that nothing is said where nothing is wrong.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path

import pytest

from benchmarks.faults import DRILLS, MASTER, Drill, Mast, row, strike, worst
from hw.ports import Axis, Direction
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Aim, Jog, Order, Release, Stop
from tests.scenario.false_alarms import NOISY
from tests.search import some
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "safety.md").read_text(encoding="utf-8")
TOLD = PAGE.split("--|--|--|--\n")[1].split("\n\n<!-- faults: end -->")[0].splitlines()
"""The rows of its table of faults."""
NOISY_TOO = [drill for drill in DRILLS if drill.sim not in ("motor-slow", "wind-turns", "")]
EACH_AXIS = pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
ACKNOWLEDGED = pytest.mark.parametrize("order", [Stop(), Release()], ids=["S", "release"])


def called(drill: Drill) -> str:
    return f"{drill.fault}-{drill.scene}-{drill.sim}".replace(" ", "-")


@pytest.fixture
def mast() -> Iterator[Mast]:
    mast = Mast()
    yield mast
    mast.close()


# --- within its limit


@pytest.mark.search
@pytest.mark.parametrize("number", some(range(len(DRILLS))), ids=lambda number: called(DRILLS[number]))
def test_the_relays_are_off_in_time_and_the_page_says_when(number: int) -> None:
    """Of both axes, at three moments of a cycle. If this fails for the page, paste what `python -m benchmarks.faults`
    prints."""
    worst_s = worst(DRILLS[number])
    assert worst_s <= DRILLS[number].limit_s
    assert TOLD[number] == row(number, worst_s)


@pytest.mark.long
@EACH_AXIS
@pytest.mark.parametrize("drill", NOISY_TOO, ids=called)
def test_with_four_times_the_noise_as_well(drill: Drill, axis: Axis) -> None:
    """A motor that has never turned, and may turn at half a degree a second, takes a little longer."""
    first = drill.scene == "starting" and drill.sim == "motor-stalled"
    assert strike(drill, axis, 0.0, NOISY) <= drill.limit_s + (0.5 if first else 0.0)


def test_the_page_has_no_other_rows() -> None:
    assert len(TOLD) == len(DRILLS)


@every_row("name", sorted({drill.fault for drill in DRILLS}))
def test_every_fault_has_its_heading(name: str) -> None:
    headings = (ROOT / "docs" / "troubleshooting.md").read_text(encoding="utf-8").splitlines()
    assert f"### {name}" in headings


# --- acknowledged


@ACKNOWLEDGED
def test_it_stops_that_axis_until_acknowledged(mast: Mast, order: Order) -> None:
    mast.run(1.0)
    mast.order(Aim(400.0, 170.0))
    mast.run(4.0)
    mast.world.inject("azimuth-motor-stalled")
    mast.run(3.0)
    assert mast.world.drives() == (0, 1), "the other axis goes on"
    mast.world.clear("azimuth-motor-stalled")
    mast.order(Aim(300.0, 170.0))
    mast.run(2.0)
    assert mast.world.drives() == (0, 1)
    mast.order(order)
    mast.order(Aim(300.0, 170.0))
    mast.run(5.0)
    assert mast.world.drives() == (1, 1)
    assert mast.status.faults == ()


@ACKNOWLEDGED
def test_the_same_cause_comes_straight_back(mast: Mast, order: Order) -> None:
    mast.world.inject("azimuth-pot-loose")
    mast.run(1.0)
    for _ in range(5):
        mast.order(order)
        mast.order(Aim(300.0, 20.0))
        mast.run(0.3)
        assert [fault.name for fault in mast.status.faults] == ["pot jumps"]
    # By chance a loose wire is quiet for 0.3 s; but nothing runs between an order and the first look at it.
    assert mast.world.relay_starts <= 1


def test_a_faulty_run_teaches_nothing(mast: Mast) -> None:
    mast.run(1.0)
    mast.order(Jog(AZ, PLUS))
    mast.run(6.0)
    before = mast.status.azimuth.learnt
    mast.world.inject("azimuth-pot-reversed")
    mast.run(6.0)
    assert mast.status.azimuth.fault is not None
    assert mast.status.azimuth.learnt == before


# --- a welded relay


def weld(text: str) -> Mast:
    """It ran clockwise, was told to turn back, and its relay has stuck."""
    mast = Mast(text)
    mast.run(1.0)
    mast.order(Jog(AZ, PLUS))
    mast.run(5.0)
    mast.world.inject("azimuth-relay-welded-cw")
    mast.order(Aim(10.0, 15.0))
    mast.run(3.0)
    return mast


@pytest.mark.long
@pytest.mark.parametrize("text", ["", MASTER], ids=["alone", "master"])
def test_it_is_never_met_by_the_opposite_relay(text: str) -> None:
    mast = weld(text)
    assert [fault.name for fault in mast.status.faults] == ["relay welded"]
    for _ in range(5):
        mast.order(Stop())
        mast.order(Aim(10.0, 15.0))
        mast.run(3.0)
    assert mast.world.azimuth.motor.shorted_s == 0.0
    assert [fault.name for fault in mast.status.faults] == ["relay welded"]
    mast.close()


def test_the_master_stays_open_until_acknowledged_and_nothing_runs() -> None:
    mast = weld(MASTER)
    stands_deg = mast.world.antenna()[0]
    mast.order(Aim(200.0, 60.0))
    mast.run(10.0)
    assert not mast.world.azimuth.motor.supply
    assert mast.world.antenna()[0] == pytest.approx(stands_deg, abs=0.01)
    fault = mast.status.elevation.fault
    assert fault is not None, "the supply that it needs would turn azimuth too"
    assert fault.kind is FaultKind.RELAY_WELDED, "without supply it is not driven: that it stands is no fault"
    mast.close()


def test_a_relay_that_lets_go_again_is_trusted_after_one_run() -> None:
    mast = weld(MASTER)
    mast.world.clear("azimuth-relay-welded-cw")
    mast.order(Stop())
    mast.order(Jog(AZ, PLUS, 1.0))
    mast.run(4.0)
    mast.order(Aim(10.0, 15.0))
    mast.run(20.0)
    assert mast.status.faults == ()
    assert mast.world.antenna()[0] == pytest.approx(10.0, abs=4.0)
    mast.close()


@EACH_AXIS
def test_a_weld_that_a_standing_sensor_hides_is_without_supply_after_two_seconds(axis: Axis) -> None:
    """Its relay welds in a run that was too short for a fault; the readings, which stand, show neither."""
    mast = Mast(MASTER)
    mast.run(1.0)
    mast.world.inject(f"{axis.value}-pot-stuck")
    mast.order(Jog(axis, PLUS))
    mast.run(1.2)  # for half a second it is looked at first
    mast.world.inject(f"{axis.value}-relay-welded-{'cw' if axis is AZ else 'up'}")
    mast.run(0.55 if axis is AZ else 0.8)  # elevation is looked at for longer
    mast.order(Stop())
    mast.run(2.0)
    stands_deg = mast.world.antenna()
    mast.run(8.0)
    assert mast.world.antenna() == pytest.approx(stands_deg, abs=0.5)
    assert mast.status.faults == ()
    mast.order(Jog(EL if axis is AZ else AZ, PLUS, 2.0))
    mast.run(6.0)
    assert not mast.world.azimuth.motor.supply
    mast.close()


# --- what is said


def test_a_fault_and_a_notice_are_said_once(mast: Mast, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, "rotator")
    mast.run(1.0)
    mast.world.inject("azimuth-wind-turns")
    mast.run(20.0)
    assert [record.message for record in caplog.records] == [
        "azimuth: turning with no relay on: wind, or a hand at the control box's switch"
    ]
    caplog.clear()
    mast.world.inject("azimuth-hand-turns")
    mast.run(20.0)
    said = [record.message for record in caplog.records]
    assert len(said) == 1
    assert said[0].startswith("FAULT CUT MOTOR POWER! azimuth: turning with no relay on: ")


def test_without_end_resistors_it_says_that_it_is_blind(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, "rotator")
    mast = Mast("[elevation]\nlowest_reading = 0.0\n")
    mast.run(5.0)
    assert mast.status.azimuth.notices == ()
    assert len(mast.status.elevation.notices) == 1
    assert (
        len([record for record in caplog.records if "a broken pot wire would look like an angle" in record.message])
        == 1
    )
    mast.close()


@pytest.mark.long
def test_a_hot_motor_rests_and_goes_on() -> None:
    mast = Mast("[azimuth]\nlongest_run_s = 20\nrest_s = 60\n")
    mast.run(1.0)
    mast.order(Aim(400.0, 15.0))
    mast.run(25.0)
    assert mast.world.drives() == (0, 0)
    assert [str(notice) for notice in mast.status.azimuth.notices] == ["motor hot: it has run for 20 s and has to rest"]
    assert mast.status.azimuth.target_deg == 400.0
    mast.run(200.0)
    assert mast.world.antenna()[0] == pytest.approx(400.0, abs=4.0)
    assert mast.status.faults == ()
    mast.close()
