"""One control box on a chip that only writes down its steps: which step an order, a correction and a hold send."""

from __future__ import annotations

import pytest

from hw.chips.mcp41010 import Mcp41010
from hw.drives.control_box import BoxSpec, ControlBox
from hw.ports import HardwareError

FINE = ((0.0, 0.0), (64.0, 256.0))
"""A quarter of a degree a step."""


class Frames:
    """An SPI bus that keeps the step of each frame, and may fail."""

    def __init__(self) -> None:
        self.steps: list[int] = []
        self.broken = False

    def send(self, _chip: str, frame: bytes) -> None:
        if self.broken:
            raise HardwareError("SPI: cannot switch select")
        self.steps.append(frame[1])

    def exchange(self, _chip: str, _frame: bytes) -> bytes:
        raise AssertionError("this chip has no output")


class Bench:
    def __init__(self) -> None:
        self.bus = Frames()
        spec = BoxSpec(FINE, 20.0, start_known=True, speed_dps=4.0, dead_band_deg=2.0, coast_deg=0.5)
        self.box = ControlBox("azimuth box", Mcp41010(self.bus, "azimuth"), spec, 50.0)
        self.now_s = 50.0

    def order(self, angle_deg: float, seconds: float) -> float:
        """Where the wiper is, in degrees, after an order and these seconds."""
        self.box.order(angle_deg)
        self.now_s += seconds
        self.box.advance(self.now_s, powered=True)
        return self.bus.steps[-1] / 4


def test_the_wiper_leads_by_the_dead_band_less_the_coast_in_the_direction_of_the_move() -> None:
    bench = Bench()
    assert bench.order(40.0, 20.0) == 41.5
    assert bench.box.angle_deg == 40.0
    assert bench.order(30.0, 20.0) == 28.5
    assert bench.box.angle_deg == 30.0


def test_a_hold_sends_the_angle_where_it_is_once() -> None:
    bench = Bench()
    bench.box.hold()
    assert bench.bus.steps == [], "a box that was never ordered has no step to hold"
    bench.order(40.0, 2.0)
    for _ in range(3):
        bench.box.hold()
        bench.now_s += 1.0
        bench.box.advance(bench.now_s, powered=True)
    assert [step / 4 for step in bench.bus.steps] == [41.5, 28.0]
    assert bench.box.angle_deg == 28.0


def test_the_first_measurement_after_an_order_corrects_a_hold_and_no_later_one_does() -> None:
    """Else a pot that disagrees with the box's own would turn it on and on."""
    bench = Bench()
    bench.order(40.0, 2.0)
    bench.box.hold()
    for angle_deg in (31.0, 34.0, 37.0):
        bench.box.found(angle_deg, bench.now_s)
        bench.box.hold()
        assert bench.bus.steps[-1] / 4 == 31.0
    bench.box.order(40.0)
    bench.box.hold()
    bench.box.found(33.0, bench.now_s)
    bench.box.hold()
    assert bench.bus.steps[-1] / 4 == 33.0


def test_a_step_that_failed_is_sent_again_and_the_top_is_the_chip_s_last_step() -> None:
    bench = Bench()
    bench.bus.broken = True
    with pytest.raises(HardwareError, match="cannot switch select"):
        bench.box.order(64.0)
    bench.box.repeat()
    bench.bus.broken = False
    bench.box.order(64.0)
    bench.box.order(64.0)
    assert bench.bus.steps == [255]
    bench.box.repeat()
    assert bench.bus.steps == [255, 255]


def test_it_is_astray_by_as_much_as_it_turned_away_from_its_nearest_place() -> None:
    bench = Bench()
    assert bench.box.astray_deg(33.0) == 0.0, "without a step it cannot be astray"
    bench.order(40.0, 0.0)
    assert [bench.box.astray_deg(angle_deg) for angle_deg in (20.0, 25.0, 24.0, 22.0)] == [0.0, 0.0, 1.0, 3.0]
    bench.box.unfed()
    assert bench.box.astray_deg(22.0) == 0.0
