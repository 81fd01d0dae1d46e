"""Two control boxes on chips and a supply that only write down their orders: leases, refreshes, cuts.

Where the antenna goes is tried on a simulated rotor (`test_digipot`, `test_digipot_stops`).
"""

from __future__ import annotations

import math

import pytest

from firmware_sim.clock import SimClock
from hw.chips.mcp41010 import Mcp41010
from hw.drives.box_supply import ENABLE
from hw.drives.control_box import BoxSpec
from hw.drives.digipot import DigipotDrive
from hw.ports import Axis, HardwareError

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
DEGREES = ((0.0, 0.0), (256.0, 256.0))
"""A step is a degree."""


class Wires:
    """The SPI bus, and the line of the supply. Writes down each frame and each switching; both may fail."""

    def __init__(self) -> None:
        self.said: list[str] = []
        self.broken = ""

    def send(self, chip: str, frame: bytes) -> None:
        if self.broken == chip:
            raise HardwareError(f"SPI: cannot switch {chip}")
        self.said.append(f"{chip} {frame[1]}")

    def exchange(self, _chip: str, _frame: bytes) -> bytes:
        raise AssertionError("these chips have no output")

    def set(self, levels: dict[str, bool]) -> None:
        self.said.append("supply on" if levels[ENABLE] else "supply off")

    def close(self) -> None:
        """There is nothing to release."""


class Bench:
    def __init__(self, *, known: bool = True, relay: bool = True) -> None:
        self.clock, self.wires = SimClock(100.0), Wires()
        specs = (
            BoxSpec(DEGREES, start, start_known=known, speed_dps=5.0, dead_band_deg=2.0, coast_deg=1.0)
            for start in (40.0, 30.0)
        )
        azimuth, elevation = specs
        self.drive = DigipotDrive(
            (Mcp41010(self.wires, "azimuth"), azimuth),
            (Mcp41010(self.wires, "elevation"), elevation),
            self.clock,
            enable=self.wires if relay else None,
        )

    def aim(self, axis: Axis, angle_deg: float, seconds: float = 0.25) -> None:
        self.drive.aim(axis, angle_deg, 0.0, self.clock() + seconds)

    def said(self) -> list[str]:
        said, self.wires.said = self.wires.said, []
        return said


def test_the_supply_comes_when_both_chips_have_their_step() -> None:
    bench = Bench()
    assert bench.drive.due_s() is None
    bench.aim(AZ, 60.0)
    assert bench.said() == ["azimuth 61", "azimuth 61", "elevation 30", "supply on"]
    bench.aim(EL, 50.0)
    assert bench.said() == ["elevation 51"]


@pytest.mark.parametrize(("asked_s", "lasts_s"), [(0.25, 0.25), (0.5, 0.5), (0.6, 0.5), (math.inf, 0.5)])
def test_a_command_lasts_for_half_a_second_at_most(asked_s: float, lasts_s: float) -> None:
    bench = Bench()
    bench.aim(AZ, 60.0, asked_s)
    assert bench.drive.due_s() == pytest.approx(100.0 + lasts_s)
    bench.said()
    bench.clock.sleep(lasts_s - 0.01)
    bench.drive.enforce(bench.clock())
    assert bench.said() == []
    bench.clock.sleep(0.01)
    bench.drive.enforce(100.0 + lasts_s)
    (held,) = bench.said()
    assert held == f"azimuth {round(40.0 + 5.0 * lasts_s)}", "where the model is now"
    assert bench.drive.due_s() == pytest.approx(101.0), "the next refresh"


def test_once_a_second_both_chips_get_their_step_again_at_any_moment_of_the_call() -> None:
    bench = Bench()
    bench.aim(AZ, 60.0)
    bench.drive.hold(AZ)
    bench.said()
    for due_s, called_s in ((101.0, 101.0), (102.0, 102.3), (103.3, 103.3)):
        assert bench.drive.due_s() == pytest.approx(due_s)
        bench.drive.enforce(due_s - 0.01)
        assert bench.said() == []
        bench.drive.enforce(called_s)
        assert bench.said() == ["azimuth 40", "elevation 30"]


@pytest.mark.parametrize("how", ["hold", "expiry", "off", "an aim that has run out"])
def test_a_box_that_may_stand_anywhere_is_stopped_by_its_supply(how: str) -> None:
    bench = Bench(known=False)
    bench.aim(AZ, 60.0)
    bench.said()
    match how:
        case "hold":
            bench.drive.hold(AZ)
        case "off":
            bench.drive.off()
        case "expiry":
            bench.drive.enforce(100.25)
        case _:
            bench.aim(AZ, 60.0, 0.0)
    assert bench.said()[0] == "supply off"
    assert bench.drive.due_s() is None


def test_the_other_box_ignores_its_orders_after_such_a_stop_until_its_own() -> None:
    bench = Bench(known=False)
    bench.aim(AZ, 60.0)
    bench.aim(EL, 50.0)
    bench.drive.hold(AZ)
    bench.said()
    bench.aim(EL, 50.0)
    assert bench.said() == []
    bench.drive.hold(EL)
    bench.said()
    bench.aim(EL, 50.0)
    assert bench.said()[-1] == "supply on"


def test_known_boxes_keep_their_supply_and_the_second_is_held_though_the_first_does_not_answer() -> None:
    bench = Bench()
    bench.aim(AZ, 60.0)
    bench.aim(EL, 50.0)
    bench.clock.sleep(1.0)
    bench.said()
    bench.wires.broken = "azimuth"
    with pytest.raises(HardwareError, match="cannot switch azimuth"):
        bench.drive.off()
    assert bench.said() == ["elevation 35"]
    for refresh_s in (101.0, 102.0):
        with pytest.raises(HardwareError, match="cannot switch azimuth"):
            bench.drive.enforce(refresh_s)
        assert bench.said() == ["elevation 35"], "its step is refreshed all the same"


def test_a_box_that_turns_away_gets_its_step_again_and_then_loses_its_supply() -> None:
    bench = Bench()
    bench.aim(AZ, 60.0)
    bench.said()
    for angle_deg, said in ((40.0, []), (37.6, []), (37.4, ["azimuth 61"]), (36.1, ["azimuth 61"])):
        bench.drive.found(AZ, angle_deg)
        assert bench.said() == said
    assert bench.drive.astray_deg(AZ) == 0.0
    bench.drive.found(AZ, 35.9)
    assert bench.said() == ["azimuth 61", "supply off"]
    assert bench.drive.astray_deg(AZ) == pytest.approx(4.1)
    assert bench.drive.astray_deg(EL) == 0.0
    assert bench.drive.barred
    bench.aim(EL, 50.0)
    bench.drive.found(AZ, 20.0)
    assert bench.said() == []
    bench.drive.restore()
    assert not bench.drive.barred
    assert bench.drive.astray_deg(AZ) == 0.0
    bench.aim(EL, 50.0)
    assert bench.said()[-1] == "supply on"


def test_the_supply_waits_for_each_sensor_where_a_relay_is_wired() -> None:
    bench = Bench(known=False)
    bench.drive.measured(AZ)
    bench.drive.measured(EL)
    bench.clock.sleep(3.0)
    bench.drive.found(AZ, 70.0)
    assert bench.drive.unseen_s() == 3.0
    bench.aim(AZ, 60.0)
    assert bench.said() == []
    bench.drive.found(EL, 20.0)
    assert bench.drive.unseen_s() == 0.0
    bench.aim(AZ, 60.0)
    assert bench.said() == ["azimuth 59", "azimuth 59", "elevation 20", "supply on"]
    assert bench.drive.position_known(AZ)


def test_where_no_relay_is_wired_there_is_nothing_to_cut() -> None:
    bench = Bench(known=False, relay=False)
    bench.aim(AZ, 60.0)
    assert not bench.drive.cut()
    assert not bench.drive.barred
    bench.drive.hold(AZ)
    bench.drive.off()
    assert bench.said() == ["azimuth 61", "azimuth 61", "azimuth 40"], "a hold is all that there is"
    with pytest.raises(HardwareError, match="no relay is wired to their supply"):
        bench.drive.release()
