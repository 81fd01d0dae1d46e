"""A control box that has to hold: the fault when it turns, and what may move a healthy one."""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis
from rotator.control.axis.held_watch import HeldWatch
from rotator.control.axis.trend import Trend
from rotator.exchange.faults import Fault

CYCLE_S = 0.05
BOX_DPS = 6.0


class Box:
    """Its pot scatters by so many degrees, rms."""

    def __init__(self, noise_deg: float = 0.1, *, master: bool = True) -> None:
        self.watch = HeldWatch(Axis.AZIMUTH, BOX_DPS, master=master)
        self.readings = Trend()
        self.noise_deg = noise_deg
        self.chance = random.Random(7)
        self.now_s = self.angle_deg = 100.0

    def turns(self, speed_dps: float, seconds: float, *, holds: bool = True) -> Fault | None:
        """The first fault of that while."""
        for _ in range(round(seconds / CYCLE_S)):
            self.now_s += CYCLE_S
            self.angle_deg += speed_dps * CYCLE_S
            reads_deg = self.angle_deg + self.chance.gauss(0.0, self.noise_deg)
            self.readings.see(self.now_s, reads_deg, 3 * BOX_DPS)
            fault = self.watch.see(self.now_s, self.readings, reads_deg, holds=holds)
            if fault is not None:
                return fault
        return None


@pytest.mark.parametrize("noise_deg", [0.02, 0.1, 0.5])
@pytest.mark.parametrize(("speed_dps", "way"), [(6.0, "clockwise"), (-6.0, "counter-clockwise"), (2.5, "clockwise")])
def test_one_that_turns_by_itself_is_a_fault(speed_dps: float, way: str, noise_deg: float) -> None:
    box = Box(noise_deg)
    assert box.turns(0.0, 30.0) is None
    fault = box.turns(speed_dps, 2.0 + 4.0 / abs(speed_dps))
    assert fault is not None
    assert (fault.name, fault.axis) == ("turning with no relay on", Axis.AZIMUTH)
    assert f"it turns {way} at " in fault.measured
    assert abs(box.angle_deg - 100.0) < 9.0


def test_and_so_is_one_that_goes_on_after_its_stop() -> None:
    box = Box()
    assert box.turns(6.0, 20.0, holds=False) is None
    stopped_deg = box.angle_deg
    assert box.turns(6.0, 3.0) is not None
    assert box.angle_deg - stopped_deg < 14.0


@pytest.mark.parametrize(
    ("master", "act_now", "who"), [(True, "", "The box has"), (False, "CUT MOTOR POWER!", "by hand NOW")]
)
def test_the_supply_goes_by_the_box_or_by_a_hand(master: bool, act_now: str, who: str) -> None:
    fault = Box(master=master).turns(6.0, 5.0)
    assert fault is not None
    assert (fault.cut, fault.act_now) == (True, act_now)
    assert who in fault.advice
    assert ("fit a relay" in str(fault)) is not master


@pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.5, 1.5])
def test_readings_that_scatter_turn_nothing(noise_deg: float) -> None:
    assert Box(noise_deg).turns(0.0, 300.0) is None


def test_neither_does_what_a_healthy_one_does_after_its_stop() -> None:
    """It coasts; its own pot disagrees with this one by 5°, so it turns on as far; and its reading drifts with the
    Sun."""
    box = Box()
    for way in (1.0, -1.0) * 5:
        assert box.turns(6.0 * way, 10.0, holds=False) is None
        assert box.turns(6.0 * way, 5.0 / 6.0) is None
        assert box.turns(0.02 * way, 120.0) is None


def test_an_axis_whose_pot_has_failed_meanwhile_has_no_such_fault() -> None:
    box = Box()
    assert box.turns(6.0, 1.9) is None
    assert box.watch.see(box.now_s + 0.2, box.readings, None, holds=True) is None
    assert box.turns(6.0, 0.5) is not None, "it answers again"
